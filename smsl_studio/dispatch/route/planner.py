"""Plans routes over joint configurations, which are computed only where the search goes (clauses 11
and 12).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.allowance import Allowance
from smsl_studio.blueprint.configuration import Configuration, Hierarchy
from smsl_studio.blueprint.edges import Edge, EdgeKind
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.hazards import GuardHazard, first_met, met_on_the_way
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.search import Move, PlanSearch, patience
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.bounds import CostBounds
from smsl_studio.dispatch.route.decomposition import Decompositions
from smsl_studio.dispatch.route.effort import fact_count, refuse_too_long
from smsl_studio.dispatch.route.straight import StraightSearch
from smsl_studio.dispatch.route.ways import Ways
from smsl_studio.errors import PlanningError
from smsl_studio.stop import heed

Key = tuple[str, ...]


WITHOUT_FAILURE = "a state without failure"


@dataclass(frozen=True)
class Leg:
    """The route to one goal: joint steps, the configuration before each, and the whole cost.

    ``goal`` None means the nearest configuration in which no SB is in a failure state.
    """

    goal: Address | None
    steps: tuple[JointStep, ...]
    before: tuple[Mapping[str, str], ...]
    cost: float

    @property
    def aim(self) -> str:
        """The goal in words."""
        return WITHOUT_FAILURE if self.goal is None else str(self.goal)

    @property
    def operations(self) -> tuple[Address, ...]:
        """All edges, in the order in which they start."""
        return tuple(edge.address for step in self.steps for edge in step.edges)


class Planner:
    """Plans for one blueprint under one set of terms. It is kept while the terms stay.

    ``ways`` may be shared by planners with other exclusions and costs. If only one SB moves, its
    goal tree has the route. Otherwise joint configurations are searched.
    """

    def __init__(
        self, hierarchy: Hierarchy, terms: Terms | None = None, ways: Ways | None = None
    ) -> None:
        self.hierarchy = hierarchy
        self.stepper = Stepper(hierarchy, terms)
        self._ways = ways or Ways(hierarchy)
        self._known = Decompositions(self.stepper)
        self._at = {name: index for index, name in enumerate(hierarchy.order)}
        self._required = {
            fact[0]
            for branch in hierarchy.blueprint
            for note in branch.notes.operations.values()
            for key in note.requires
            if (fact := split_fact(key)) is not None
        }
        self._guarded = {
            branch.name
            for branch in hierarchy.blueprint
            if any(note.requires for note in branch.notes.operations.values())
        }
        self._question: tuple[Key, tuple[Address, ...]] | None = None
        self._searches: dict[object, PlanSearch[Key] | StraightSearch] = {}
        self._gave_up: PlanningError | None = None

    def legs(self, start: Configuration, goals: Sequence[Address]) -> tuple[Leg, ...] | None:
        """Return the route to all goals, one leg for each that does not hold yet. None if there is
        none.

        The goals are pursued in order, and each leg keeps the goals before it. If this is not
        possible, one search looks for all goals together. If an SB is in a failure state, the first
        leg leads to the nearest configuration without failure, if a route leads on from there. No
        route leads into a failure state, or passes a configuration that meets a hazard.

        It heeds the listener (see ``stop``). If it is called off and asked again, it goes on.
        PlanningError if too many configurations were searched, or if the route has too many steps.
        The same question raises it again.
        """
        question = (self.stepper.key(start), tuple(goals))
        if question != self._question:
            self._question, self._searches, self._gave_up = question, {}, None
            self.stepper.allowance = Allowance(self.hierarchy)
        if self._gave_up is not None:
            raise PlanningError(self._gave_up.sentence, advice=self._gave_up.advice)
        try:
            found = self._way(start, goals)
            steps = (step for leg in found or () for step in leg.steps)
            refuse_too_long(sum(max(len(step.actions), 1) for step in steps), self._facts)
        except PlanningError as error:
            self._searches, self._gave_up = {}, error.with_traceback(None)
            raise
        self._question, self._searches = None, {}
        return found

    def _way(self, start: Configuration, goals: Sequence[Address]) -> tuple[Leg, ...] | None:
        hazards = self.stepper.terms.hazards
        if hazards and first_met(hazards, start) is not None:
            return None
        if holds(start, goals):
            return ()
        if not self.failing(start, goals):
            return self._to_goals(start, goals)
        first = self._leg(start, None, (), [goal.branch for goal in goals])
        if first is None:
            return None
        onward = self._to_goals(_after(start, first), goals)
        if onward is not None:
            return (first, *onward)
        last = self._leg(start, goals[-1], goals, [goal.branch for goal in goals], clean=True)
        return None if last is None else (last,)

    def failing(self, configuration: Configuration, goals: Sequence[Address]) -> tuple[str, ...]:
        """Return the SBs in a failure state, among those that move for the goals."""
        movers = self._movers([goal.branch for goal in goals])
        return tuple(name for name in movers if configuration[name] in self._failing(name))

    @cached_property
    def _facts(self) -> int:
        return fact_count(self.hierarchy.blueprint)

    def _to_goals(self, start: Configuration, goals: Sequence[Address]) -> tuple[Leg, ...] | None:
        legs: list[Leg] = []
        here = dict(start)
        for index, goal in enumerate(goals):
            wanted = goals[: index + 1]
            if holds(here, wanted):
                continue
            leg = self._leg(here, goal, wanted, [goal.branch])
            if leg is None:
                if len(goals) == 1:
                    return None
                last = self._leg(start, goals[-1], goals, [g.branch for g in goals])
                return None if last is None else (last,)
            legs.append(leg)
            here = _after(here, leg)
        return tuple(legs)

    def _movers(self, branches: Collection[str]) -> list[str]:
        """Return every SB of the trees that these SBs belong to, bases first."""
        roots = {root for branch in branches for root in self.hierarchy.roots_of(branch)}
        moving = {name for root in roots for name in self.hierarchy.tree(root)}
        return [name for name in self.hierarchy.order if name in moving]

    def _failing(self, name: str) -> Mapping[str, str]:
        return failing_states(self.hierarchy.blueprint[name])

    def _leg(
        self,
        start: Configuration,
        goal: Address | None,
        wanted: Sequence[Address],
        branches: Collection[str],
        clean: bool = False,
    ) -> Leg | None:
        """Return the cheapest leg to a configuration in which all ``wanted`` hold. With ``clean``,
        or without a goal, it ends without a failure state.
        """
        movers = self._movers(branches)
        if len(movers) == 1 and self._ways.alone(self.stepper, movers[0]):
            return self._lone_leg(start, goal, wanted, movers[0], clean)
        asked = (self.stepper.key(start), goal, tuple(wanted), tuple(movers), clean)
        if asked not in self._searches:
            self._searches[asked] = self._search(start, goal, wanted, movers, clean)
        found = self._searches[asked].found()
        if found is None:
            return None
        steps: list[JointStep] = []
        before: list[Mapping[str, str]] = []
        here = dict(start)
        for move in found:
            step = self.stepper.written(here, move.what)
            assert isinstance(step, JointStep)
            steps.append(step)
            before.append(dict(here))
            here.update(step.after)
        return Leg(goal, tuple(steps), tuple(before), round(sum(s.cost for s in steps), 9))

    def _search(
        self,
        start: Configuration,
        goal: Address | None,
        wanted: Sequence[Address],
        movers: Sequence[str],
        clean: bool,
    ) -> PlanSearch[Key] | StraightSearch:
        """Return the search for such a leg over joint configurations."""
        ill = [name for name in movers if clean or goal is None if self._failing(name)]
        quiet = self._quiet(movers, {*ill, *(one.branch for one in wanted)})
        places = [(self._at[one.branch], one.state) for one in wanted]
        shunned = [(self._at[name], self._failing(name)) for name in ill]

        def is_goal(node: Key) -> bool:
            """Return whether a configuration has all states of the goal and no failure state."""
            return all(node[at] == state for at, state in places) and not any(
                node[at] in states for at, states in shunned
            )

        routed = goal.branch if goal is not None else movers[0]
        key = self.stepper.key(start)

        def moves(node: Key) -> Iterator[Move]:
            """Return the moves out of a configuration."""
            return self._moves(node, movers, quiet, routed)

        def walk() -> PlanSearch[Key]:
            """Return the search over joint configurations."""
            most = patience(self.hierarchy.blueprint.state_count)
            ahead = self._known.bound(start, wanted, movers)
            ahead = ahead or CostBounds(self.stepper, start, wanted, movers, quiet)
            return PlanSearch(key, is_goal, moves, most, ahead)

        def walk_instead() -> PlanSearch[Key]:
            """Return the same after another search, whose work does not count."""
            self.stepper.allowance = Allowance(self.hierarchy)
            return walk()

        ranks = None if goal is None or ill else self._known.ranks(start, wanted, movers)
        return walk() if ranks is None else StraightSearch(key, ranks, moves, walk_instead)

    def _lone_leg(
        self,
        start: Configuration,
        goal: Address | None,
        wanted: Sequence[Address],
        branch: str,
        clean: bool,
    ) -> Leg | None:
        """Return the same for one SB that moves alone, from its goal tree."""
        if any(start[one.branch] != one.state for one in wanted if one.branch != branch):
            return None
        states = {one.state for one in wanted if one.branch == branch}
        goals = states if wanted else set(self.hierarchy.blueprint[branch].table)
        if goal is None or clean:
            goals -= self._failing(branch).keys()
        if len(states) > 1 or not goals:
            return None
        steps = self._ways.way(self.stepper, start, branch, goals)
        if steps is None:
            return None
        places = [start[branch], *(step.asked.target for step in steps[:-1])][: len(steps)]
        before = tuple({**start, branch: state} for state in places)
        return Leg(goal, steps, before, round(sum(step.cost for step in steps), 9))

    def _quiet(self, movers: Sequence[str], seen: Collection[str]) -> frozenset[str]:
        """Return the quiet sub-SBs: they have no sub-SBs, no goal (``seen``), no ``requires`` and
        no hazard depends on them, and their own operations require nothing.

        Only their operations that leave ACTIVATING need to be asked for. A base's rise does
        everything else on the sub-SB's own route, and never at a higher cost. An operation that
        requires a fact may be open only before that rise, so its SB is not quiet.
        """
        asked = self._required.union(seen, self._guarded, self.stepper.in_hazards)
        return frozenset(
            name
            for name in movers
            if self.hierarchy.bases[name] and not self.hierarchy.subs[name] and name not in asked
        )

    def _moves(
        self, node: Key, movers: Sequence[str], quiet: frozenset[str], routed: str
    ) -> Iterator[Move]:
        here: dict[str, str] = {}
        seen = 0
        for name in movers:
            at = self._at[name]
            edges = self.stepper.edges.out(name, node[at])
            seen += len(edges)
            for edge in edges:
                if edge.source == edge.target or (name in quiet and edge.crossing >= 0):
                    continue
                here = here or dict(zip(self.hierarchy.order, node, strict=True))
                key = (f"{at:06}", edge.name)
                if edge.kind is EdgeKind.PURE and not edge.crossing:
                    if self.stepper.allows(here, edge) and not self._endangers(here, edge):
                        to = (*node[:at], edge.target, *node[at + 1 :])
                        count = int(name == routed)
                        yield Move(to, edge.cost, count, partial(_one, edge, routed), key, edge)
                    continue
                heed()
                script = self.stepper.glance(here, edge)
                if script is not None:
                    to = self.stepper.key(script.configuration)
                    names = partial(self._names, here, edge, routed)
                    count = script.counts.get(routed, 0)
                    yield Move(to, round(script.cost, 9), count, names, key, edge)
        # This comes last, so that a node is counted once even if the search was called off and goes
        # on.
        self.stepper.allowance.spend(seen)

    def _endangers(self, here: Mapping[str, str], edge: Edge) -> bool:
        """Return whether an edge that moves its own SB alone leads into a hazard."""
        stepper = self.stepper
        if edge.branch not in stepper.in_hazards:
            return False
        return first_met(stepper.terms.hazards, {**here, edge.branch: edge.target}) is not None

    def _names(self, here: Mapping[str, str], edge: Edge, routed: str) -> tuple[str, ...]:
        step = self.stepper.written(here, edge)
        return step.names(routed) if isinstance(step, JointStep) else ()


def _one(edge: Edge, routed: str) -> tuple[str, ...]:
    return (edge.name,) if edge.branch == routed else ()


def _after(configuration: Configuration, leg: Leg) -> dict[str, str]:
    after = dict(configuration)
    for step in leg.steps:
        after.update(step.after)
    return after


def hazards_on(
    hazards: Sequence[GuardHazard], start: Configuration, legs: Sequence[Leg] | None
) -> tuple[GuardHazard, ...]:
    """Return the hazards that a route meets, its start included, in the order of the file."""
    if legs is None:
        return ()
    met = {one.name for one in hazards if one.meets(start)}
    for leg in legs:
        for before, step in zip(leg.before, leg.steps, strict=True):
            met.update(one.name for one in met_on_the_way(hazards, before, step))
    return tuple(one for one in hazards if one.name in met)


def holds(configuration: Configuration, goals: Sequence[Address]) -> bool:
    """Return whether every goal holds."""
    for goal in goals:  # noqa: SIM110 -- asked at every tick, where a generator is dear
        if configuration[goal.branch] != goal.state:
            return False
    return True
