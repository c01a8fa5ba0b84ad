"""Shows for each hazard and property of a blueprint whether it holds.

A small space is explored once for all claims about what can happen, and once for those that go only
where a route may go. Of a large one only the cone of a question is explored.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from fnmatch import translate
from functools import cached_property
from re import compile as compiled
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Meaning
from smsl_studio.errors import PlanningError, RunRefused
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.inspection.proof import kinds
from smsl_studio.inspection.proof.arrays import ArraySpace
from smsl_studio.inspection.proof.claim_cones import ROUTED, WATCHED, ClaimCones
from smsl_studio.inspection.proof.claims import Claim, claims_of
from smsl_studio.inspection.proof.cone import Cone
from smsl_studio.inspection.proof.engines import ENGINES, Engines
from smsl_studio.inspection.proof.exploration import Exploration, Tell, nobody
from smsl_studio.inspection.proof.failed_starts import failed_starts
from smsl_studio.inspection.proof.kinds import Answer
from smsl_studio.inspection.proof.lone import LoneExploration, is_lone
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.symbolic import SymbolicSpace
from smsl_studio.inspection.proof.verdict import (
    EXPLICIT,
    FAILS,
    HAZARD,
    HOLDS,
    UNKNOWN,
    PropertyVerdict,
)
from smsl_studio.inspection.proof.verdict import Counterexample as Run
from smsl_studio.stop import UNBOUNDED, BoundMet, EffortBounds, bounded

LIMIT = 1_000_000
"""The largest number of configurations that are stored."""

NEAR = 10_000
"""A product of the state counts of a cone up to which a run is looked for one by one."""

SMALL = 2_000
"""A product of state counts up to which everything is looked at for all questions together."""


class Scope(NamedTuple):
    """The limits of a proof.

    ``limit`` is the largest number of configurations that are stored. With ``failures`` a run may
    also begin in each configuration in which one SB has failed. If the product of all state counts
    is at most ``small``, no SB is left out.

    ``engines`` names those that may hold all configurations together. Without them configurations
    are only explored one by one. If the product of the state counts of the cone is at most
    ``near``, the shortest run is searched one by one. ``bounds`` limit time and memory. ``tell``
    hears how many configurations were found so far, where they are explored one by one.
    """

    limit: int = LIMIT
    failures: bool = False
    small: int = SMALL
    engines: Collection[str] = ENGINES
    near: int = NEAR
    bounds: EffortBounds = UNBOUNDED
    tell: Tell = nobody


class PlannedRoute(NamedTuple):
    """The cheapest route to some goals: what is asked, all edges that are carried out, the
    configurations on the way (the start first), and the cost."""

    asked: tuple[Address, ...]
    edges: tuple[Address, ...]
    configurations: tuple[dict[str, str], ...]
    cost: float


Planned = Callable[[Sequence[Address]], PlannedRoute | None]
"""Plans the cheapest route from the start to goals. PlanningError if it meets its bound."""


def prove(
    blueprint: Blueprint, planned: Planned, scope: Scope | None = None
) -> tuple[PropertyVerdict, ...]:
    """Return a verdict for each hazard and property, in the order of the file."""
    scope = scope or Scope()
    bounds = scope.bounds.begun()
    claims = list(claims_of(blueprint))
    if not claims:
        return ()
    with bounded(bounds):
        return _Prover(blueprint, claims, planned, scope).verdicts()


class _Found(NamedTuple):
    """An answer, the bound that was met, and the number of configurations."""

    answer: Answer
    bound: str | None = None
    configurations: int | None = None
    engine: str = EXPLICIT


class _Prover:
    """Answers all claims of one blueprint."""

    def __init__(
        self, blueprint: Blueprint, claims: list[Claim], planned: Planned, scope: Scope
    ) -> None:
        self._blueprint, self._claims = blueprint, claims
        self._planned, self._scope = planned, scope
        self._explored: dict[tuple[bool, Cone], Exploration] = {}
        self._lone: dict[Cone, bool] = {}
        self._looked_at: int | None = None

    def verdicts(self) -> tuple[PropertyVerdict, ...]:
        """Return all verdicts."""
        return tuple(self._verdict(one) for one in self._claims)

    def _verdict(self, one: Claim) -> PropertyVerdict:
        if one.meanings is None:
            bound = "it cannot be read"
            return PropertyVerdict(one.name, one.kind, one.severity, UNKNOWN, None, bound)
        self._looked_at = None
        try:
            if one.kind in ("at_most", "cost"):
                found = self._of_route(one)
            else:
                found = self._of_configurations(one, one.meanings)
        except (RunRefused, PlanningError) as error:
            found = _Found(Answer(UNKNOWN), error.sentence)
        except BoundMet as error:
            found = _Found(Answer(UNKNOWN), str(error), self._looked_at)
        # A bound that does not matter for the answer is told too: fewer were counted.
        (verdict, run), limit, count, engine = found
        return PropertyVerdict(one.name, one.kind, one.severity, verdict, count, limit, run, engine)

    def _of_configurations(self, one: Claim, meanings: tuple[Meaning, ...]) -> _Found:
        at_once = self._at_once(one, meanings)
        if at_once is not None and at_once.answer.verdict != UNKNOWN:
            return at_once
        found = self._one_by_one(one, meanings)
        if at_once is not None and found.answer.verdict == UNKNOWN:
            return at_once  # more was looked at in arrays
        return found

    def _one_by_one(self, one: Claim, meanings: tuple[Meaning, ...]) -> _Found:
        """Answer a claim by exploring configurations one by one."""
        near, *rest = self._cones.to_look_at(one)
        first = self._explored_answer(one, meanings, near)
        if first.answer.verdict == HOLDS or not rest:
            return first
        found = self._explored_answer(one, meanings, *rest)
        # A fault that was found is certain, even if the search for a shorter run to it met a limit.
        return found._replace(answer=first.answer) if found.answer.verdict == UNKNOWN else found

    def _explored_answer(self, one: Claim, meanings: tuple[Meaning, ...], cone: Cone) -> _Found:
        """Answer a claim by exploring the configurations of a cone, one by one."""
        found = self._exploration(one, cone)
        if one.kind in WATCHED:
            answer = kinds.never(found, meanings[0], self._watched_numbers[id(one), cone])
        elif one.kind == "reachable":
            answer = kinds.reachable(found, meanings[0])
        elif one.kind == "before":
            answer = kinds.before(found, meanings[0], meanings[1])
        elif one.kind == "after":
            answer = kinds.after(found, meanings[0], meanings[1], found.space.at_goal)
        else:
            within = one.written.within if one.written else None
            answer = kinds.way_back(found, meanings[0], meanings[1], within)
        count = len(found) if found.space.is_whole or found.bound else None
        if count is None and one.kind not in ROUTED and "_engines" in self.__dict__:
            space = self._engines.engine(self._hierarchy.order, False)
            count = space.count if isinstance(space, SymbolicSpace) else None
        return _Found(answer, found.bound or None, count)

    def _at_once(self, one: Claim, meanings: tuple[Meaning, ...]) -> _Found | None:
        """Answer a claim with an engine, or return None if no engine can answer it."""
        scope = self._scope
        if not scope.engines or self._cones.is_small:
            return None
        cone = self._cones.cone(one)
        if self._is_lone(cone):
            return None
        routed = self._goes_around(one)
        shown = self._cones.product(cone) > scope.near
        how = routed, one.kind not in ROUTED
        space = whole = self._engines.engine(self._hierarchy.order, *how)
        if not isinstance(space, SymbolicSpace) and shown:
            space = self._engines.engine(cone.kept | cone.quiet, *how)
        answer: Answer | None
        try:
            if isinstance(space, SymbolicSpace):
                answer = _from_set(space, one, meanings, shown)
            elif space is not None and shown:
                answer = _from_arrays(space, one, meanings)
            else:
                return None
        except (TooLarge, RecursionError):
            return None
        if answer is None or (answer.verdict == FAILS and answer.run is None):
            # The shortest run lies in the cone, which is small enough to be looked at one by one.
            return None
        count = space.count if space is whole or answer.verdict == UNKNOWN else None
        return _Found(answer, space.bound or None, count, space.engine)

    def _is_lone(self, cone: Cone) -> bool:
        """Whether the cone is one SB whose own graph is enough to answer the question."""
        found = self._lone.get(cone)
        if found is None:
            found = (
                is_lone(self._hierarchy, cone) and self._cones.product(cone) <= self._scope.limit
            )
            self._lone[cone] = found
        return found

    def _goes_around(self, one: Claim) -> bool:
        """Whether a claim counts only the steps of routes, and these are not all steps."""
        return one.kind in ROUTED and not self._routes_are_free

    @cached_property
    def _routes_are_free(self) -> bool:
        """Whether a route may go wherever a step can lead."""
        return not self._hazards and not any(map(failing_states, self._blueprint))

    @cached_property
    def _engines(self) -> Engines:
        return Engines(self._blueprint, self._hazards, self._scope.engines, self._scope.failures)

    # what is looked at

    def _exploration(self, one: Claim, cone: Cone) -> Exploration:
        """Return what can be reached in a cone, by the steps that count for the claim."""
        routed = self._goes_around(one)
        found = self._explored.get((routed, cone))
        if found is None:
            hazards = self._cones.near_hazards(cone) if routed else ()
            space = Space(self._blueprint, routed, hazards, cone)
            mates = self._watched.get(cone, ())
            tests = [space.test(one.meanings[0]) for one in mates if one.meanings]
            limit, watched = self._scope.limit, () if routed else tests
            explored = LoneExploration if self._is_lone(cone) else Exploration
            tell = self._scope.tell
            found = explored(space, limit, watched, tell=tell)
            if self._scope.failures and not found.bound:
                starts = (space.start(), *failed_starts(space, found.keys))
                found = explored(space, limit, watched, starts, tell)
            self._explored[routed, cone] = found
        self._looked_at = len(found)
        return found

    @cached_property
    def _watched(self) -> dict[Cone, list[Claim]]:
        """The claims of the kinds ``WATCHED``, by the cones in which they are answered."""
        found: dict[Cone, list[Claim]] = {}
        for one in self._claims:
            if one.kind in WATCHED and one.meanings:
                for cone in self._cones.to_look_at(one):
                    found.setdefault(cone, []).append(one)
        return found

    @cached_property
    def _watched_numbers(self) -> dict[tuple[int, Cone], int]:
        """The place of each watched claim in the list of its cone.

        The key has the ``id`` of the claim, because a search in a list of thousands would be slow.
        """
        return {
            (id(one), cone): number
            for cone, mates in self._watched.items()
            for number, one in enumerate(mates)
        }

    @cached_property
    def _cones(self) -> ClaimCones:
        return ClaimCones(self._hierarchy, self._hazards, self._scope.failures, self._scope.small)

    @cached_property
    def _hierarchy(self) -> Hierarchy:
        return Hierarchy(self._blueprint)

    @cached_property
    def _hazards(self) -> tuple[Meaning, ...]:
        hazards = (one for one in self._claims if one.kind == HAZARD)
        return tuple(one.meanings[0] for one in hazards if one.meanings)

    # routes

    def _of_route(self, one: Claim) -> _Found:
        assert one.written is not None
        blueprint = self._blueprint
        if one.kind == "cost":
            goals = [blueprint.resolve(one.written.goal)]
        else:
            goals = [Address(name, blueprint[name].activating) for name in blueprint.roots]
        route = self._planned(goals)
        if route is None:
            begun = start_configuration(self._hierarchy, {})
            start = {name: begun[name] for name in blueprint.branches}
            return _Found(Answer(FAILS, Run(start, (), start)))
        if one.kind == "cost":
            good = route.cost <= one.written.limit
        else:
            fits = _pattern(one.written.operation)
            good = sum(map(fits, route.edges)) <= one.written.times
        if good:
            return _Found(Answer(HOLDS))
        start, *_, end = (route.configurations[0], *route.configurations)
        return _Found(Answer(FAILS, Run(start, route.asked, end)))


def _from_set(
    space: SymbolicSpace, one: Claim, meanings: tuple[Meaning, ...], shown: bool
) -> Answer:
    if one.kind in WATCHED:
        return space.never(meanings[0], shown)
    if one.kind == "reachable":
        return space.reachable(meanings[0])
    if one.kind == "before":
        return space.before(meanings[0], meanings[1], shown)
    if one.kind == "after":
        return space.after(meanings[0], meanings[1], shown)
    within = one.written.within if one.written else None
    return space.way_back(meanings[0], meanings[1], within, shown)


def _from_arrays(space: ArraySpace, one: Claim, meanings: tuple[Meaning, ...]) -> Answer | None:
    """Answer a claim from arrays. None for kinds that need steps backward."""
    if one.kind in WATCHED:
        return space.never(meanings[0])
    if one.kind == "reachable":
        return space.reachable(meanings[0])
    return space.before(meanings[0], meanings[1]) if one.kind == "before" else None


def _pattern(text: str) -> Callable[[Address], bool]:
    """Return whether an operation fits a pattern, by its name or as ``SB/operation``."""
    # Square brackets have no meaning in a pattern.
    fits = compiled(translate(text.replace("[", "[[]"))).match
    return lambda one: bool(fits(one.operation) or fits(f"{one.branch}/{one.operation}"))
