"""How the facts that operations require stand in a run: pure functions, no widget."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, state_check
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.picture.guards import Guard, guarded_edges, guards_of

HOLDS, MISSES, UNKNOWN = "true", "false", "unknown"
Standing = tuple[str, str]
"""Whether all that is required holds, and in words, fact by fact."""


def standings(
    blueprint: Blueprint, branch: str, status: DispatchStatus
) -> Mapping[Address, Standing]:
    """Every operation of an SB that requires facts, with how they stand now."""
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
    """The operations that could go now, were it known what they need."""
    return frozenset(
        item.address
        for item in status.possible
        if standing.get(item.address, ("", ""))[0] == UNKNOWN
    )


class _Looked:
    """The state checks of one instant, each worked out once."""

    def __init__(self, blueprint: Blueprint, status: DispatchStatus) -> None:
        self._blueprint, self._status = blueprint, status
        self._checks: dict[str, CheckResult] = {}

    def standing(self, guards: tuple[Guard, ...]) -> Standing:
        """How these guards stand together: the worst of their truths, and the words of each."""
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
        """Of the active state: as the dispatcher asks before anything moves."""
        found = self._checks.get(branch)
        if found is None:
            here, status = self._status.configuration, self._status
            found = state_check(self._blueprint, branch, here[branch], status.scene, here)
            self._checks[branch] = found
        return found
