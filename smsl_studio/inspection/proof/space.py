"""The space of a question: its configurations, and the steps between them.

A step is one operation that may be asked, with everything that it takes along. A configuration is
a tuple with the active state of each SB of the question's cone, in the order of ``Space.order``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.allowance import Allowance
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Meaning, States
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.inspection.proof.cone import Cone
from smsl_studio.stop import heed

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


MOST_STORED = 10_000_000
"""The largest number of active states that are stored, counted over all SBs of all configurations
(80 MB)."""

_KEPT_STEPS = 20_000
"""The stepper keeps all steps that it was asked for. After so many it is made anew."""


class Space:
    """The steps of a blueprint. RunRefused if it has no start.

    With ``routed`` only the steps that a route may take count: none leads into a failure state, and
    none meets one of ``hazards``. Without a ``cone`` all SBs are looked at. ``start``
    is another configuration to start in.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        routed: bool = False,
        hazards: Sequence[Meaning] = (),
        cone: Cone | None = None,
        start: Mapping[str, str] | None = None,
    ) -> None:
        self.hierarchy = Hierarchy(blueprint)
        self.cone = cone or Cone(frozenset(self.hierarchy.order))
        self.order = tuple(name for name in self.hierarchy.order if name in self.cone.kept)
        self._quiet = tuple(name for name in self.hierarchy.order if name in self.cone.quiet)
        self._at = {name: index for index, name in enumerate(self.order)}
        self.blueprint = blueprint
        self.routed = routed
        self._terms = Terms() if routed else Terms(failing=None)
        self._start = start or start_configuration(self.hierarchy, {})
        coupled = {name for name, subs in self.hierarchy.subs.items() if subs}
        coupled |= {name for name, bases in self.hierarchy.bases.items() if bases}
        self._alone = frozenset(self.order) - coupled
        """SBs whose operations move nothing else."""
        self._shut = [self.test(one) for one in hazards] if routed else []
        self._stepper, self._made = Stepper(self.hierarchy, self._terms), 0

    @property
    def is_whole(self) -> bool:
        """Whether no SB of the blueprint is left out."""
        return len(self.order) == len(self.hierarchy.order)

    def _renew(self) -> None:
        self._stepper.forget()
        self._stepper, self._made = Stepper(self.hierarchy, self._terms), 0

    def storable(self, limit: int) -> tuple[int, str]:
        """Return how many configurations may be stored, and this bound in words.

        They are ``limit``, or fewer if there are so many SBs that these would fill the memory.
        """
        size = max(len(self.order), 1)
        most = max(MOST_STORED // size, 1)
        if most >= limit:
            return limit, f"{limit:,} configurations"
        return most, f"{most:,} configurations of {size:,} SBs, which would fill the memory"

    def start(self) -> Key:
        """Return the configuration in which a run starts."""
        return self.key(self._start)

    def key(self, configuration: Mapping[str, str]) -> Key:
        """Return the part of a configuration that is looked at."""
        return tuple(configuration[name] for name in self.order)

    def steps(self, key: Key) -> list[Step]:
        """Return the steps out of a configuration, by address in the order of code points.

        PlanningError if one of them is too large to be worked out.
        """
        here = self.whole(key)
        found: list[tuple[str, Step]] = []
        for name in self.order:
            alone = name in self._alone
            for edge in self._stepper.edges.out(name, here[name]):
                if alone and not edge.requires:
                    one = Step(edge.address, self._after(key, {name: edge.target}), ())
                    if not self._stepper.closed(edge) and not self._meets(one):
                        found.append((edge.text, one))
                    continue
                step = self._written(here, edge)
                if step is not None:
                    one = Step(edge.address, self._after(key, step.after), self._passed(key, step))
                    if not self._meets(one):
                        found.append((edge.text, one))
        if self._made > _KEPT_STEPS:
            self._renew()
        return [step for _, step in sorted(found, key=lambda pair: pair[0])]

    def crossings(self, configuration: Mapping[str, str]) -> Iterator[Edge]:
        """Yield the edges of quiet SBs that would enter or leave ACTIVATING."""
        for name in self._quiet:
            for edge in self._stepper.edges.out(name, configuration[name]):
                if edge.crossing:
                    yield edge

    def operations(self, configuration: Mapping[str, str]) -> list[Address]:
        """Return the operations out of the states of all SBs, in the order of code points."""
        found = [
            edge.address
            for name in self.hierarchy.order
            for edge in self._stepper.edges.out(name, configuration[name])
        ]
        return sorted(found, key=str)

    def joint_step(self, configuration: Mapping[str, str], address: Address) -> JointStep | None:
        """Return the step of an operation from a configuration of all SBs, None if there is
        none."""
        edge = self._stepper.edges.get(address)
        step = None if edge is None else self._written(configuration, edge)
        if step is None:
            return None
        key = self.key(configuration)
        one = Step(address, self._after(key, step.after), self._passed(key, step))
        return None if self._meets(one) else step

    def place(self, branch: str) -> int:
        """Return the index of an SB in a configuration."""
        return self._at[branch]

    def test(self, meaning: Meaning) -> Test:
        """Return a condition as a function of a configuration."""
        heed()
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
        ends = [(self._at[root], self.blueprint[root].activating) for root in self.hierarchy.roots]
        return lambda key: all(key[at] == state for at, state in ends)

    def whole(self, key: Key) -> dict[str, str]:
        """Return a configuration of all SBs. Quiet SBs stand as at a start, others stand still."""
        here = {**self._start, **dict(zip(self.order, key, strict=True))}
        for name in self._quiet:
            ((base, digit),) = self.hierarchy.bases[name]
            branch = self.blueprint[name]
            on = self.blueprint[base].is_on(here[base], digit)
            here[name] = branch.activating if on else branch.initial
        return here

    def in_order(self, configuration: Mapping[str, str]) -> dict[str, str]:
        """Return a configuration with its SBs in the order of the file."""
        return {name: configuration[name] for name in self.blueprint.branches}

    def _written(self, configuration: Mapping[str, str], edge: Edge) -> JointStep | None:
        self._stepper.allowance = Allowance(self.hierarchy)
        self._made += 1
        step = self._stepper.written(configuration, edge)
        return step if isinstance(step, JointStep) else None

    def _after(self, key: Key, moved: Mapping[str, str]) -> Key:
        found = list(key)
        for name, state in moved.items():
            at = self._at.get(name)
            if at is not None:
                found[at] = state
        return tuple(found)

    def _passed(self, key: Key, step: JointStep) -> tuple[Passed, ...]:
        """Return the configurations between the actions of a step. Pending states count as they
        are, and the digits of bases in transit as they are committed.
        """
        found, now = [], key
        for action, following in zip(step.actions, step.actions[1:], strict=False):
            now = self._after(now, action.moved)
            found.append(Passed(following.edge.address, now))
        return tuple(found)

    def shuts(self, key: Key) -> bool:
        """Return whether a configuration is forbidden for a route: no step may end in it or pass
        it.
        """
        return any(shut(key) for shut in self._shut)

    def _meets(self, step: Step) -> bool:
        return bool(self._shut) and any(
            map(self.shuts, (step.to, *(one.key for one in step.passed)))
        )
