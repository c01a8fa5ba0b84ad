"""Whether the facts that operations require hold in a run. Pure functions, no widget."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, state_check
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.picture.guards import Guard, guarded_edges, guards_of

HOLDS, MISSES, UNKNOWN = "true", "false", "unknown"
Standing = tuple[str, str]
"""Whether all required facts hold (``true``, ``false`` or ``unknown``), and the words for each
fact.
"""


def standings(
    blueprint: Blueprint, branch: str, status: DispatchStatus
) -> Mapping[Address, Standing]:
    """Return every operation of an SB that requires facts, with their standing now."""
    own = blueprint[branch]
    if not status.configuration:
        return {}
    looked = _Looked(blueprint, status)
    found: dict[Address, Standing] = {}
    for edge in guarded_edges(own):
        guards = guards_of(blueprint, own, edge.state, edge.operation)
        if guards:
            found[edge] = looked.standing(guards)
    return found


def held_back(standing: Mapping[Address, Standing], status: DispatchStatus) -> frozenset[Address]:
    """Return the possible operations whose required facts are unknown."""
    return frozenset(
        item.address
        for item in status.possible
        if standing.get(item.address, ("", ""))[0] == UNKNOWN
    )


class _Looked:
    """The state checks at one instant. Each is computed once."""

    def __init__(self, blueprint: Blueprint, status: DispatchStatus) -> None:
        self._blueprint, self._status = blueprint, status
        self._checks: dict[str, CheckResult] = {}

    def standing(self, guards: tuple[Guard, ...]) -> Standing:
        """Return the standing of several guards: false if one is false, else unknown if one is
        unknown.
        """
        each = [self._one(guard) for guard in guards]
        truths = [truth for truth, _ in each]
        worst = next((one for one in (MISSES, UNKNOWN) if one in truths), HOLDS)
        return worst, "; ".join(words for _, words in each)

    def _one(self, guard: Guard) -> Standing:
        if guard.digit < 0 or guard.branch not in self._status.configuration:
            return MISSES, f"needs {guard.words}"
        term = self._check(guard.branch).terms[guard.digit]
        if term.reading is None:
            why = f", {term.reason}" if term.reason else ""
            return UNKNOWN, f"needs {guard.words}: it is unknown{why}"
        if term.reading == guard.value:
            return HOLDS, f"needs {guard.words}: it is"
        return MISSES, f"needs {guard.words}: it is {term.reading}"

    def _check(self, branch: str) -> CheckResult:
        """Return the state check of the active state, as the dispatcher makes it before anything
        moves.
        """
        found = self._checks.get(branch)
        if found is None:
            here, status = self._status.configuration, self._status
            found = state_check(self._blueprint, branch, here[branch], status.scene, here)
            self._checks[branch] = found
        return found
