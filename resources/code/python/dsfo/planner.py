"""Plans routes over joint configurations, which are made only where the search goes (clauses 11 and
12).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from .elements import Configuration, Edge, address
from .errors import PlanningError
from .estimate import Estimate
from .goals import Goal, holds
from .hierarchy import Hierarchy
from .joint import JointStep
from .search import Move, Node, cheapest
from .stepper import Stepper, Terms, patience

WITHOUT_FAILURE = "a state without failure"


@dataclass(frozen=True)
class Leg:
    """The route to one goal: joint steps, and the configuration before each.

    ``goal`` None means the nearest configuration in which no SB is in a failure state.
    """

    goal: Goal | None
    steps: tuple[JointStep, ...]
    before: tuple[Mapping[str, str], ...]

    @property
    def aim(self) -> str:
        """The goal in words."""
        return WITHOUT_FAILURE if self.goal is None else address(*self.goal)

    @property
    def cost(self) -> float:
        """The cost of all its steps."""
        return round(sum(step.cost for step in self.steps), 9)

    @property
    def operations(self) -> tuple[str, ...]:
        """The addresses of all edges, in the order in which they start."""
        return tuple(edge.address for step in self.steps for edge in step.edges)

    @property
    def end(self) -> dict[str, str]:
        """The states of the SBs that it moves, at its end."""
        return {name: state for step in self.steps for name, state in step.after.items()}


class Planner:
    """Plans for one blueprint under one set of terms."""

    def __init__(self, hierarchy: Hierarchy, terms: Terms) -> None:
        self.hierarchy, self.blueprint = hierarchy, hierarchy.blueprint
        self.stepper = Stepper(hierarchy, terms)
        edges = self.stepper.edges
        requiring = {name: edges.requiring(name) for name in hierarchy.order}
        self._required = set[str]().union(*requiring.values())
        self._asking = {
            branch.name
            for branch in self.blueprint
            if any(terms.requires for terms in branch.operations.values())
        }

    def legs(self, start: Configuration, goals: Sequence[Goal]) -> tuple[Leg, ...] | None:
        """Return the route to all goals, one leg for each that does not hold yet, or None.

        The goals are pursued in order, and each leg keeps those before it. If that leads nowhere,
        one search looks for all of them. Out of a failure state the first leg leads to the nearest
        configuration without failure. PlanningError if the search takes too much.
        """
        self.stepper.renew()
        found = self._way(start, goals)
        self._refuse_too_long(found or ())
        return found

    def _refuse_too_long(self, legs: Sequence[Leg]) -> None:
        count = sum(max(len(step.actions), 1) for leg in legs for step in leg.steps)
        facts = sum(len(branch.flags) for branch in self.blueprint)
        most = min(5_000, 300_000 // max(facts, 1))
        if count > most:
            raise PlanningError(
                f"the route has {count:,} steps; with {facts:,} facts to sense {most:,} are the "
                "most",
                "Name a nearer goal, and go on from there.",
            )

    def _way(self, start: Configuration, goals: Sequence[Goal]) -> tuple[Leg, ...] | None:
        if any(self.blueprint.meets(one, start) for one in self.stepper.terms.hazards):
            return None
        if holds(start, goals):
            return ()
        branches = [branch for branch, _ in goals]
        if not self._in_failure(start, branches):
            return self._to_goals(start, goals)
        first = self._leg(start, None, (), branches)
        if first is None:
            return None
        onward = self._to_goals({**start, **first.end}, goals)
        if onward is not None:
            return (first, *onward)
        last = self._leg(start, goals[-1], goals, branches, clean=True)
        return None if last is None else (last,)

    def _in_failure(self, configuration: Configuration, branches: Collection[str]) -> bool:
        movers = self._movers(branches)
        return any(configuration[name] in self.blueprint[name].failing for name in movers)

    def _to_goals(self, start: Configuration, goals: Sequence[Goal]) -> tuple[Leg, ...] | None:
        legs: list[Leg] = []
        here = dict(start)
        for index, goal in enumerate(goals):
            wanted = goals[: index + 1]
            if holds(here, wanted):
                continue
            leg = self._leg(here, goal, wanted, [goal[0]])
            if leg is None:
                return self._all_at_once(start, goals) if len(goals) > 1 else None
            legs.append(leg)
            here.update(leg.end)
        return tuple(legs)

    def _all_at_once(self, start: Configuration, goals: Sequence[Goal]) -> tuple[Leg, ...] | None:
        last = self._leg(start, goals[-1], goals, [branch for branch, _ in goals])
        return None if last is None else (last,)

    def _movers(self, branches: Collection[str]) -> list[str]:
        """Return every SB of the trees that these SBs belong to, bases first."""
        roots = {root for branch in branches for root in self.hierarchy.roots_of(branch)}
        moving = {name for root in roots for name in self.hierarchy.tree(root)}
        return [name for name in self.hierarchy.order if name in moving]

    def _leg(
        self,
        start: Configuration,
        goal: Goal | None,
        wanted: Sequence[Goal],
        branches: Collection[str],
        clean: bool = False,
    ) -> Leg | None:
        """Return the cheapest leg to a configuration in which all ``wanted`` hold. With ``clean``,
        or without a goal, it ends without a failure state.
        """
        movers, at = self._movers(branches), self.hierarchy.place
        ill = [n for n in movers if clean or goal is None if self.blueprint[n].failing]
        quiet = self._quiet(movers, {*ill, *(branch for branch, _ in wanted)})
        routed = goal[0] if goal is not None else movers[0]

        def is_goal(node: Node) -> bool:
            """Return whether a node has all states of the goal and no failure state."""
            return all(node[at[branch]] == state for branch, state in wanted) and not any(
                node[at[name]] in self.blueprint[name].failing for name in ill
            )

        found = cheapest(
            self.stepper.key(start),
            is_goal,
            lambda node: self._moves(node, movers, quiet, routed),
            patience(self.blueprint.state_count),
            Estimate(self.stepper, start, wanted, movers, quiet),
        )
        return None if found is None else self._written(start, goal, found)

    def _written(self, start: Configuration, goal: Goal | None, found: list[Move]) -> Leg:
        steps: list[JointStep] = []
        before: list[Mapping[str, str]] = []
        here = dict(start)
        for move in found:
            step = self.stepper.step(here, move.what)
            assert isinstance(step, JointStep), "the search has carried it out"
            steps.append(step)
            before.append(dict(here))
            here.update(step.after)
        return Leg(goal, tuple(steps), tuple(before))

    def _quiet(self, movers: Sequence[str], seen: Collection[str]) -> frozenset[str]:
        """Return the sub-SBs of which only operations that leave ACTIVATING need to be asked for.

        They have no sub-SBs, nothing asks for their facts, and they ask for nothing. So the rise of
        a base does everything else on their own route, and never at a higher cost.
        """
        asked = self._required.union(seen, self._asking, self.stepper.in_hazards)
        return frozenset(
            name
            for name in movers
            if self.hierarchy.bases[name] and not self.hierarchy.subs[name] and name not in asked
        )

    def _moves(
        self, node: Node, movers: Sequence[str], quiet: frozenset[str], routed: str
    ) -> Iterator[Move]:
        here = dict(zip(self.hierarchy.order, node, strict=True))
        seen = 0
        for name in movers:
            edges = self.stepper.edges.out(name, here[name])
            seen += len(edges)
            for edge in edges:
                if edge.leaves_its_state and not (name in quiet and edge.crossing >= 0):
                    yield from self._move(node, here, edge, routed)
        self.stepper.spend(seen)

    def _move(self, node: Node, here: Mapping[str, str], edge: Edge, routed: str) -> Iterator[Move]:
        """Yield the move of an edge if it can be carried out."""
        at = self.hierarchy.place[edge.branch]
        key = (f"{at:06}", edge.name)
        if edge.kind == "pure" and not edge.crossing:
            if self.stepper.allows(here, edge) and not self._endangers(here, edge):
                to = (*node[:at], edge.target, *node[at + 1 :])
                own = (edge.name,) if edge.branch == routed else ()
                yield Move(to, edge.cost, len(own), lambda: own, key, edge)
            return
        step = self.stepper.step(here, edge)
        if isinstance(step, JointStep):
            names = partial(step.names, routed)
            to = self.stepper.key({**here, **step.after})
            yield Move(to, step.cost, len(names()), names, key, edge)

    def _endangers(self, here: Mapping[str, str], edge: Edge) -> bool:
        if edge.branch not in self.stepper.in_hazards:
            return False
        after = {**here, edge.branch: edge.target}
        return any(self.blueprint.meets(one, after) for one in self.stepper.terms.hazards)
