"""Tells for each failure state how a procedure recovers from it."""

from __future__ import annotations

from collections.abc import Mapping
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
from smsl_studio.inspection.proof.recovery import ways_out


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

    def as_json(self) -> dict[str, Any]:
        """Return it as ``check`` writes it."""
        return {
            "state": str(self.state),
            "failure_free": None if self.path is None else len(self.path),
            "goal": self.cost,
            "path": [str(one) for one in self.path or ()],
        }


def recoverability(blueprint: Blueprint, limit: int = LIMIT) -> tuple[FailureRecovery, ...]:
    """Return for each state with a failure value how a procedure recovers from it.

    The other SBs stand as at a start in that state. ``limit`` is the largest number of
    configurations that are stored.

    >>> found = recoverability(read("hanoi-failures.json"))
    >>> str(found[0].state), len(found[0].path), found[0].cost
    ('SB1/State_haa', 1, 8.0)
    """
    try:
        ways = ways_out(blueprint, limit)
        hierarchy = Hierarchy(blueprint)
    except RunRefused:
        return ()  # inspection tells of it (R08)
    planner = Planner(hierarchy, Terms(hazards=guard_hazards(blueprint)))
    goals = [Address(name, blueprint[name].activating) for name in hierarchy.roots]
    found = []
    for way in ways:
        cost, bound = None, way.bound if way.path is None else ""
        if way.start is not None:
            try:
                legs = planner.legs(way.start, goals)
                cost = None if legs is None else round(sum(leg.cost for leg in legs), 9)
            except PlanningError as error:
                bound = bound or error.sentence
        found.append(FailureRecovery(way.state, way.path, cost, bound, way.start))
    return tuple(found)
