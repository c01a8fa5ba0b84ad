"""The cones of the claims about one blueprint: what must be looked at to answer each."""

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
"""The kinds that look also at what a step passes on its way."""

ALONE = (*WATCHED, "reachable", "way_back")
"""The kinds that hold for some SBs whatever happens to others that do not touch these."""

ROUTED = ("after", "way_back")
"""The kinds that go only where a route may go."""


class ClaimCones:
    """The cones of claims. With ``failures`` a run may also begin where one SB has failed.

    ``hazards`` are the meanings of all hazards. ``small`` is the product of state counts up to
    which no SB is left out.
    """

    def __init__(
        self, hierarchy: Hierarchy, hazards: tuple[Meaning, ...], failures: bool, small: int
    ) -> None:
        self._hierarchy, self._hazards = hierarchy, hazards
        self._failures, self._small = failures, small
        self._cones: dict[tuple[str, ...], Cone] = {}

    def to_look_at(self, one: Claim) -> tuple[Cone, ...]:
        """Return the cones to look at until a claim holds in one, a small one first.

        What fails elsewhere changes nothing for the SBs of a claim that speaks of them alone. It
        only lets a run begin in the middle, so the shortest run to a fault may begin there.
        """
        whole = self.cone(one)
        if not self._failures or one.kind not in ALONE or self.is_small:
            return (whole,)
        if one.kind == "way_back" and self._hazards:
            return (whole,)
        near = self.cone(one, elsewhere=False)
        return (whole,) if near == whole else (near, whole)

    def cone(self, one: Claim, elsewhere: bool = True) -> Cone:
        """Return the SBs that can change the answer of a claim. With failures these are also all
        that can fail, or without ``elsewhere`` only those that touch the claim.
        """
        if self.is_small:
            return Cone(frozenset(self._hierarchy.order))
        routed = one.kind in ROUTED
        wanted = {name for meaning in one.meanings or () for name in branches_in(meaning)}
        if one.kind == "after":
            wanted.update(self._hierarchy.roots)
        if self._failures and elsewhere:
            # Whatever fails, a run may begin in each configuration in which it can fail.
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
            # A hazard hinders the steps of all its SBs.
            hazards = self.near_hazards(cone)
            more = {name for hazard in hazards for name in branches_in(hazard)}
            if more <= cone.kept:
                break
            cone = cone_of(stepper, cone.kept | more, routed)
        return cone

    def near_hazards(self, cone: Cone) -> tuple[Meaning, ...]:
        """Return the hazards that can hinder a route. One that is met at the start hinders all."""
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
        """Return the product of the state counts of what a cone keeps."""
        return prod(len(self._hierarchy.blueprint[name].table) or 1 for name in cone.kept)

    @cached_property
    def is_small(self) -> bool:
        """Whether the blueprint is so small that everything is looked at for all questions."""
        return prod(len(one.table) or 1 for one in self._hierarchy.blueprint) <= self._small
