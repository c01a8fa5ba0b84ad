"""Finds the cone of each claim: the SBs that must be explored to answer the claim."""

from __future__ import annotations

from functools import cached_property
from math import prod

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.properties.meaning import Meaning, branches_in, holds
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.inspection.proof.claims import Claim
from smsl_studio.inspection.proof.cone import Cone, cone_of
from smsl_studio.inspection.proof.verdict import HAZARD

WATCHED = (HAZARD, "never")
"""The kinds of claims that also count configurations through which a step only passes."""

ALONE = (*WATCHED, "reachable", "way_back")
"""The kinds of claims whose answer for some SBs does not depend on SBs that have nothing to do with
these."""

ROUTED = ("after", "way_back")
"""The kinds of claims that count only the steps that a route may take."""


class ClaimCones:
    """The cones of the claims about one blueprint.

    ``hazards`` has the meanings of all hazards. ``small`` is a limit: if the product of the state
    counts is at most this, no SB is left out. With ``failures`` a run may also begin where one SB
    has failed.
    """

    def __init__(
        self, hierarchy: Hierarchy, hazards: tuple[Meaning, ...], failures: bool, small: int
    ) -> None:
        self._hierarchy, self._hazards = hierarchy, hazards
        self._failures, self._small = failures, small
        self._cones: dict[tuple[str, ...], Cone] = {}

    def to_look_at(self, one: Claim) -> tuple[Cone, ...]:
        """Return the cones for a claim, the smaller one first.

        If the claim holds in the first one, the second one is not needed. Claims of the kinds
        ``ALONE`` do not change if another SB fails. But such a failure lets a run begin in the
        middle. So the shortest run to a fault may only be found in the second cone.
        """
        whole = self.cone(one)
        if not self._failures or one.kind not in ALONE or self.is_small:
            return (whole,)
        if one.kind == "way_back" and self._hazards:
            return (whole,)
        near = self.cone(one, elsewhere=False)
        return (whole,) if near == whole else (near, whole)

    def cone(self, one: Claim, elsewhere: bool = True) -> Cone:
        """Return the SBs that can change the answer of a claim.

        With failures, all SBs that can fail belong to it. With ``elsewhere`` False, only those of
        them that the claim depends on.
        """
        if self.is_small:
            return Cone(frozenset(self._hierarchy.order))
        routed = one.kind in ROUTED
        wanted = {name for meaning in one.meanings or () for name in branches_in(meaning)}
        if one.kind == "after":
            wanted.update(self._hierarchy.roots)
        if self._failures and elsewhere:
            # If an SB fails, a run may begin in any configuration in which this SB can fail.
            wanted.update(one.name for one in self._hierarchy.blueprint if failing_states(one))
        key = (str(routed), *sorted(wanted))
        found = self._cones.get(key)
        if found is None:
            found = self._cones[key] = self._cone_of(wanted, routed)
        return found

    def _cone_of(self, wanted: set[str], routed: bool) -> Cone:
        stepper = Stepper(self._hierarchy, Terms() if routed else Terms(failing=None))
        cone = cone_of(stepper, wanted, routed)
        while routed:
            # A hazard can forbid steps of every SB that it names.
            hazards = self.near_hazards(cone)
            more = {name for hazard in hazards for name in branches_in(hazard)}
            if more <= cone.kept:
                break
            cone = cone_of(stepper, cone.kept | more, routed)
        return cone

    def near_hazards(self, cone: Cone) -> tuple[Meaning, ...]:
        """Return the hazards that can forbid a step of a route in the cone.

        If a hazard holds at the start, it forbids every step.
        """
        return tuple(
            hazard
            for hazard in self._hazards
            if self._starts_hazardous
            or not (cone.kept | cone.quiet).isdisjoint(branches_in(hazard))
        )

    @cached_property
    def _starts_hazardous(self) -> bool:
        start = start_configuration(self._hierarchy, {})
        return self._failures or any(holds(one, start) for one in self._hazards)

    def product(self, cone: Cone) -> int:
        """Return the product of the state counts of the SBs in a cone."""
        return prod(len(self._hierarchy.blueprint[name].table) or 1 for name in cone.kept)

    @cached_property
    def is_small(self) -> bool:
        """Whether the blueprint is so small that every question explores all of it."""
        return prod(len(one.table) or 1 for one in self._hierarchy.blueprint) <= self._small
