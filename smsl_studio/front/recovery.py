"""Tells for each failure state how a procedure recovers from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import PlanningError, RunRefused
from smsl_studio.inspection.proof.prove import LIMIT
from smsl_studio.inspection.proof.recovery import WayOut, ways_out
from smsl_studio.stop import BoundMet, EffortBounds, bounded


@dataclass(frozen=True)
class FailureRecovery:
    """How a procedure recovers from one failure state.

    ``path`` are the fewest operations to where nothing has failed, None if there is no way.
    ``cost`` is that of the cheapest route to the goals, None if there is none. ``bound`` says in
    words what limit was met.
    """

    state: Address
    path: tuple[Address, ...] | None
    cost: float | None
    bound: str = ""
    start: Mapping[str, str] | None = None
    """Where the way begins, None if no run can start in the state."""

    @property
    def is_complete(self) -> bool:
        """Whether there is a way out, and a route to the goals."""
        return self.path is not None and self.cost is not None

    @property
    def goal_words(self) -> str:
        """The cost of the goals in words, that there is no route, or that this is unknown."""
        if self.cost is not None:
            return f"cost {self.cost:g}"
        return "unknown" if self.bound else "no route"

    def as_json(self) -> dict[str, Any]:
        """Return it as ``check`` writes it."""
        return {
            "state": str(self.state),
            "failure_free": None if self.path is None else len(self.path),
            "goal": self.cost,
            "path": [str(one) for one in self.path or ()],
        }


def recoverability(
    blueprint: Blueprint,
    limit: int = LIMIT,
    seconds: float | None = None,
    megabytes: int | None = None,
) -> tuple[FailureRecovery, ...]:
    """Return for each state with a failure value how a procedure recovers from it.

    The other SBs stand as at a start in that state. ``limit`` is the largest number of
    configurations that are stored. ``seconds`` (wall time) and ``megabytes`` (MB, memory of this
    process) limit the work. If a limit is met, ``FailureRecovery.bound`` names it.

    >>> found = recoverability(read("hanoi-failures.json"))
    >>> str(found[0].state), len(found[0].path), found[0].cost
    ('SB1/State_haa', 1, 8.0)
    """
    with bounded(EffortBounds(seconds, megabytes).begun()):
        try:
            ways = ways_out(blueprint, limit)
            hierarchy = Hierarchy(blueprint)
        except RunRefused:
            return ()  # inspection tells of it (R08)
        return tuple(_recoveries(blueprint, hierarchy, ways))


def _recoveries(
    blueprint: Blueprint, hierarchy: Hierarchy, ways: Sequence[WayOut]
) -> Iterator[FailureRecovery]:
    planner = Planner(hierarchy, Terms(hazards=guard_hazards(blueprint)))
    goals = [Address(name, blueprint[name].activating) for name in hierarchy.roots]
    for way in ways:
        cost, bound = None, way.bound if way.path is None else ""
        if way.start is not None:
            try:
                legs = planner.legs(way.start, goals)
                cost = None if legs is None else round(sum(leg.cost for leg in legs), 9)
            except PlanningError as error:
                bound = bound or error.sentence
            except BoundMet as error:
                bound = bound or str(error)
        yield FailureRecovery(way.state, way.path, cost, bound, way.start)
