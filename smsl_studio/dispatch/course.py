"""The course of a run: its goals, what is shut out, and the plan as long as it still holds."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.stepper import Terms
from smsl_studio.dispatch.planner import Leg, Planner
from smsl_studio.host.protocol import Bound


class Course:
    """Where a run wants to go and what it may use.

    ``shut`` are edges avoided or pruned, with the reason; ``risky`` those that failed. Routing
    uses neither; a person may still ask for a risky edge.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        goals: Sequence[Address],
        bound: Mapping[Address, Bound],
        shut: Mapping[Address, str],
    ) -> None:
        self.goals = tuple(goals)
        self.shut = dict(shut)
        self.risky: dict[Address, str] = {}
        self.version = 0
        self._hierarchy = hierarchy
        self._bound = bound
        self._exact = frozenset(address for address, one in bound.items() if one.exact)
        self._planner: Planner | None = None
        self._asked: dict[Address, Planner] = {}
        self._legs: tuple[Leg, ...] = ()
        self._at = (0, 0)
        self._ahead: tuple[Address, ...] | None = None

    def prune(self, address: Address, reason: str) -> None:
        """Shut an edge out until it is restored."""
        self.shut[address] = f"pruned: {reason}" if reason else "pruned"
        self._changed()

    def restore(self, address: Address) -> bool:
        """Let an edge be used again; whether it was shut out or risky."""
        known = self.shut.pop(address, None) is not None
        known = self.risky.pop(address, None) is not None or known
        self._changed()
        return known

    def tag_risky(self, address: Address, reason: str) -> None:
        """Route around an edge that failed until it is restored."""
        self.risky[address] = reason
        self._changed()

    @property
    def planner(self) -> Planner:
        """The planner under the terms of now."""
        if self._planner is None:
            risky = {address: f"risky: {reason}" for address, reason in self.risky.items()}
            self._planner = self._planner_of({**risky, **self.shut})
        return self._planner

    def asked(self, configuration: Mapping[str, str], edge: Edge) -> JointStep | Unavailable:
        """The joint step of an edge that a person asks for, though it be risky itself, or lead
        into a failure state."""
        address = edge.address
        if address in self.shut or not (edge.fails or address in self.risky):
            return self.planner.stepper.step(configuration, edge)
        planner = self._asked.get(address)
        if planner is None:
            others = {a: f"risky: {r}" for a, r in self.risky.items() if a != address}
            planner = self._planner_of({**others, **self.shut}, failing=(address,))
            self._asked[address] = planner
        return planner.stepper.step(configuration, edge)

    def edge(self, address: Address) -> Edge | None:
        return self.planner.stepper.edges.get(address)

    def next_step(self, configuration: Mapping[str, str]) -> tuple[JointStep | None, Leg | None]:
        """The next joint step, and the leg where it is newly planned or begun.

        The plan is kept while the run stands where the plan has it; (None, None) where nothing
        permitted leads on.
        """
        leg, step = self._at
        fresh = False
        if leg < len(self._legs) and step == len(self._legs[leg].steps):
            leg, step, fresh = leg + 1, 0, True
        if leg >= len(self._legs) or self._legs[leg].before[step] != dict(configuration):
            legs = self.planner.legs(configuration, self.goals)
            if not legs:
                self.drop_plan()
                return None, None
            self._legs, leg, step, fresh = legs, 0, 0, True
        self._at, self._ahead = (leg, step + 1), None
        current = self._legs[leg]
        return current.steps[step], current if fresh else None

    @property
    def ahead(self) -> tuple[Address, ...]:
        """The edges that the plan has still to begin, after the step that was given last."""
        if self._ahead is not None:
            return self._ahead
        leg, step = self._at
        self._ahead = tuple(
            edge.address
            for index in range(leg, len(self._legs))
            for joint in self._legs[index].steps[step if index == leg else 0 :]
            for edge in joint.edges
        )
        return self._ahead

    def drop_plan(self) -> None:
        self._legs, self._at, self._ahead = (), (0, 0), None

    def risky_way(self, configuration: Mapping[str, str]) -> tuple[Address, ...]:
        """The risky edges on the way that would exist if none were risky; empty: no way at all."""
        if not self.risky:
            return ()
        legs = self._planner_of(self.shut).legs(configuration, self.goals)
        found = (edge for leg in legs or () for edge in leg.operations)
        return tuple(dict.fromkeys(edge for edge in found if edge in self.risky))

    def _changed(self) -> None:
        self.version += 1
        self._planner = None
        self._asked = {}
        self.drop_plan()

    def _planner_of(
        self, shut: Mapping[Address, str], failing: Collection[Address] = ()
    ) -> Planner:
        terms = Terms(dict(shut), self._bound.keys(), self._exact, failing)
        return Planner(self._hierarchy, terms)
