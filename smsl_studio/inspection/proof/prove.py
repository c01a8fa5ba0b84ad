"""Shows for each hazard and property of a blueprint whether it holds.

The space is explored once for all claims about what can happen, and once for those that go only
where a route may go.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fnmatch import translate
from functools import cached_property
from re import compile as compiled
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.meaning import Meaning
from smsl_studio.errors import PlanningError, RunRefused
from smsl_studio.inspection.proof import kinds
from smsl_studio.inspection.proof.claims import Claim, claims_of
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.kinds import Answer
from smsl_studio.inspection.proof.space import Space
from smsl_studio.inspection.proof.verdict import FAILS, HAZARD, HOLDS, UNKNOWN, PropertyVerdict
from smsl_studio.inspection.proof.verdict import Counterexample as Run

LIMIT = 1_000_000
"""The largest number of configurations that are stored."""


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
    blueprint: Blueprint, planned: Planned, limit: int = LIMIT
) -> tuple[PropertyVerdict, ...]:
    """Return a verdict for each hazard and property, in the order of the file."""
    claims = list(claims_of(blueprint))
    return _Prover(blueprint, claims, planned, limit).verdicts() if claims else ()


class _Found(NamedTuple):
    """An answer, the bound that was met, and the number of configurations."""

    answer: Answer
    bound: str | None = None
    configurations: int | None = None


class _Prover:
    """Answers all claims of one blueprint."""

    def __init__(
        self, blueprint: Blueprint, claims: list[Claim], planned: Planned, limit: int
    ) -> None:
        self._blueprint, self._claims = blueprint, claims
        self._planned, self._limit = planned, limit
        self._watched = [one for one in claims if one.kind in (HAZARD, "never") and one.meanings]

    def verdicts(self) -> tuple[PropertyVerdict, ...]:
        """Return all verdicts."""
        return tuple(self._verdict(one) for one in self._claims)

    def _verdict(self, one: Claim) -> PropertyVerdict:
        if one.meanings is None:
            bound = "it cannot be read"
            return PropertyVerdict(one.name, one.kind, one.severity, UNKNOWN, None, bound)
        try:
            if one.kind in ("at_most", "cost"):
                found = self._of_route(one)
            else:
                found = self._of_configurations(one, one.meanings)
        except (RunRefused, PlanningError) as error:
            found = _Found(Answer(UNKNOWN), error.sentence)
        # A bound that does not matter for the answer is told too: fewer were counted.
        (verdict, run), limit, count = found
        return PropertyVerdict(one.name, one.kind, one.severity, verdict, count, limit, run)

    def _of_configurations(self, one: Claim, meanings: tuple[Meaning, ...]) -> _Found:
        found = self._routed if one.kind in ("after", "way_back") else self._free
        first, *others = (found.space.test(meaning) for meaning in meanings)
        if one.kind in (HAZARD, "never"):
            answer = kinds.never(found, first, self._watched.index(one))
        elif one.kind == "reachable":
            answer = kinds.reachable(found, first)
        elif one.kind == "before":
            answer = kinds.before(found, first, others[0])
        elif one.kind == "after":
            answer = kinds.after(found, first, others[0], found.space.at_goal)
        else:
            within = one.written.within if one.written else None
            answer = kinds.way_back(found, first, others[0], within)
        return _Found(answer, found.bound or None, len(found))

    @cached_property
    def _free(self) -> Exploration:
        space = Space(self._blueprint)
        tests = [space.test(one.meanings[0]) for one in self._watched if one.meanings]
        return Exploration(space, self._limit, tests)

    @cached_property
    def _routed(self) -> Exploration:
        return Exploration(Space(self._blueprint, True, self._hazards), self._limit)

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
            space = Space(blueprint)
            start = space.configuration(space.start())
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


def _pattern(text: str) -> Callable[[Address], bool]:
    """Return whether an operation fits a pattern, by its name or as ``SB/operation``."""
    # Square brackets have no meaning in a pattern.
    fits = compiled(translate(text.replace("[", "[[]"))).match
    return lambda one: bool(fits(one.operation) or fits(f"{one.branch}/{one.operation}"))
