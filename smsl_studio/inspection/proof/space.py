"""The space of a blueprint: its configurations, and the steps between them.

A step is one operation that may be asked, with everything that it takes along. A configuration is
a tuple with the active state of each SB, in the order of ``Space.order``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.allowance import Allowance
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Meaning, States
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms

Key = tuple[str, ...]
Test = Callable[[Key], bool]
"""A condition, as a function of a configuration."""


class Passed(NamedTuple):
    """A configuration that a step passes on its way, and the edge that is carried out then."""

    edge: Address
    key: Key


class Step(NamedTuple):
    """One step: the operation that is asked, where it leads, and what it passes."""

    address: Address
    to: Key
    passed: tuple[Passed, ...]


class Space:
    """The steps of a blueprint. RunRefused if its SBs go round in a circle.

    With ``routed`` only the steps that a route may take count: none leads into a failure state, and
    none meets one of ``hazards``.
    """

    def __init__(
        self, blueprint: Blueprint, routed: bool = False, hazards: Sequence[Meaning] = ()
    ) -> None:
        self.hierarchy = Hierarchy(blueprint)
        self.order = self.hierarchy.order
        self._at = {name: index for index, name in enumerate(self.order)}
        self._blueprint = blueprint
        self._stepper = Stepper(self.hierarchy, Terms() if routed else Terms(failing=None))
        self._shut = [self.test(one) for one in hazards] if routed else []

    def start(self) -> Key:
        """Return the configuration in which a run starts. RunRefused if there is none."""
        return self._stepper.key(start_configuration(self.hierarchy, {}))

    def steps(self, key: Key) -> list[Step]:
        """Return the steps out of a configuration, by address in the order of code points.

        PlanningError if one of them is too large to be worked out.
        """
        here = dict(zip(self.order, key, strict=True))
        found = []
        for name, state in here.items():
            for edge in self._stepper.edges.out(name, state):
                self._stepper.allowance = Allowance(self.hierarchy)
                step = self._stepper.written(here, edge)
                if isinstance(step, JointStep):
                    one = Step(edge.address, self._after(key, step.after), self._passed(key, step))
                    if not self._meets(one):
                        found.append(one)
        return sorted(found, key=lambda step: str(step.address))

    def test(self, meaning: Meaning) -> Test:
        """Return a condition as a function of a configuration."""
        if isinstance(meaning, States):
            at, states = self._at[meaning.branch], meaning.states
            return lambda key: key[at] in states
        parts = [self.test(part) for part in meaning.parts]
        if meaning.every:
            return lambda key: all(part(key) for part in parts)
        return lambda key: any(part(key) for part in parts)

    @property
    def at_goal(self) -> Test:
        """The condition that every root is in ACTIVATING."""
        ends = [(self._at[root], self._blueprint[root].activating) for root in self.hierarchy.roots]
        return lambda key: all(key[at] == state for at, state in ends)

    def configuration(self, key: Key) -> dict[str, str]:
        """Return a configuration with the names of its SBs, in the order of the file."""
        here = dict(zip(self.order, key, strict=True))
        return {name: here[name] for name in self._blueprint.branches}

    def _after(self, key: Key, moved: object) -> Key:
        assert isinstance(moved, dict)
        found = list(key)
        for name, state in moved.items():
            found[self._at[name]] = state
        return tuple(found)

    def _passed(self, key: Key, step: JointStep) -> tuple[Passed, ...]:
        """Return the configurations between the actions of a step. Pending states count as they
        are, and the digits of bases in transit as they are committed.
        """
        found, now = [], key
        for action, following in zip(step.actions, step.actions[1:], strict=False):
            now = self._after(now, dict(action.moved))
            found.append(Passed(following.edge.address, now))
        return tuple(found)

    def _meets(self, step: Step) -> bool:
        keys = (step.to, *(one.key for one in step.passed))
        return any(shut(key) for shut in self._shut for key in keys)
