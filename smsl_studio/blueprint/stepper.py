"""From an edge to its joint step, or to the reasons why there is none.

It is pure: it maps a configuration to a value. Dispatch and inspection share it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property, partial

from smsl_studio.blueprint.allowance import Allowance, Part, refuse_too_many_carried
from smsl_studio.blueprint.along import Along, Held, Unavailable, allow
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import (
    Configuration,
    Hierarchy,
    disagreements,
    standing,
)
from smsl_studio.blueprint.downhill import Downhill
from smsl_studio.blueprint.edges import Edge, EdgeKind, Edges
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.hazards import met_on_the_way, named
from smsl_studio.blueprint.joint import Carried, JointStep, StepDraft
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.search import Move, PlanSearch, patience
from smsl_studio.blueprint.sub_route import Region, SubRoute
from smsl_studio.blueprint.terms import Terms
from smsl_studio.errors import PlanningError
from smsl_studio.stop import heed

MOST_REASONS = 8
Key = tuple[str, ...]


class Stepper:
    """Makes joint steps and keeps the results. A new one is needed only if the terms change."""

    def __init__(self, hierarchy: Hierarchy, terms: Terms | None = None) -> None:
        self.hierarchy = hierarchy
        self.terms = terms or Terms()
        self.edges = Edges(hierarchy, self.terms.exact, self.terms.costs, self.terms.extra)
        # This must not refer back to the stepper. Such a circle would keep its memory too long.
        self._along = Along(self.edges, partial(allow, self.edges, self.terms))
        self._steps: dict[tuple[tuple[str, ...], Edge], JointStep | Unavailable] = {}
        self.allowance = Allowance(hierarchy)
        self._routes: dict[object, SubRoute] = {}
        self._regions: dict[tuple[str, frozenset[str]], Region] = {}
        self._within: Part | None = None
        self._blocks: dict[str, list[str]] = {}
        self._hills: dict[tuple[str, str], Downhill] = {}

    def step(self, configuration: Configuration, edge: Edge) -> JointStep | Unavailable:
        """Return the joint step of an edge out of its SB's active state (clauses 5, 6 and 10).

        It has an allowance of its own, and the result is Unavailable if that is used up. It can be
        stopped (see ``stop``). If it is asked again, it goes on.
        """
        before, self.allowance = self.allowance, Allowance(self.hierarchy)
        try:
            return self.written(configuration, edge)
        except PlanningError as error:
            found = Unavailable(error.sentence)
            self._steps[self.key(configuration), edge] = found
            return found
        finally:
            self.allowance = before

    def written(self, configuration: Configuration, edge: Edge) -> JointStep | Unavailable:
        """Return the same with the current allowance. PlanningError if that is used up."""
        key = (self.key(configuration), edge)
        found = self._steps.get(key)
        if found is None:
            script = StepDraft(configuration)
            try:
                self._carry(script, edge, {})
                found = script.joint_step()
                if self.terms.hazards:
                    self._refuse_hazards(configuration, found)
            except Unavailable as no:
                found = no.with_traceback(None)  # a traceback would keep all local values
            self._steps[key] = found
        return found

    def glance(self, configuration: Configuration, edge: Edge) -> StepDraft | None:
        """Return the cost and the end of a joint step without its actions, None if it is
        unavailable.
        """
        script = StepDraft(configuration, light=True)
        try:
            self._carry(script, edge, {})
        except Unavailable:
            return None
        if self.terms.hazards and self._near_hazard(configuration, script):
            # Only the finished step has all configurations that it passes.
            return script if isinstance(self.written(configuration, edge), JointStep) else None
        return script

    def _near_hazard(self, before: Configuration, script: StepDraft) -> bool:
        """Return whether a step moves an SB that a hazard names."""
        after = script.configuration
        return any(name in script.counts or before[name] != after[name] for name in self.in_hazards)

    def _refuse_hazards(self, before: Configuration, step: JointStep) -> None:
        """Raise Unavailable if a step meets a hazard on its way or at its end."""
        met = next(met_on_the_way(self.terms.hazards, before, step), None)
        if met is not None:
            words = f"{step.asked} would meet {named([met])}"
            raise Unavailable(words, hazard=met.name)

    @cached_property
    def in_hazards(self) -> frozenset[str]:
        """The SBs that the hazards of the terms name."""
        return frozenset(name for one in self.terms.hazards for name in one.states)

    def key(self, configuration: Configuration) -> tuple[str, ...]:
        """Return a configuration as a tuple in the order of ``hierarchy.order``."""
        return tuple(configuration[name] for name in self.hierarchy.order)

    def _carry(self, script: StepDraft, edge: Edge, held: Held) -> Carried:
        """Write the edge, the movements of its sub-SBs, and the edges of bases that must go
        along.
        """
        self._allow(script.configuration, edge)
        if not script.light:
            refuse_too_many_carried(script.asked or edge, len(script.carried) + 1)
        places = self._loaded(script.configuration, edge) if edge.load else {}
        along = self._along.edges_for(script.configuration, edge, places, held)
        crossed = (
            sub for sub in places if self._along.crossing(script.configuration, sub, places[sub])
        )
        new = [script.begin(edge, self._transit(edge, crossed))]
        new += [script.begin(one, self._transit(one, ())) for one in along]
        carried, inner = new[0], {**held, **{one.edge.branch: one for one in new}}
        self._link(script, new, places, inner)
        if not edge.load:
            self._drive(script, edge, inner)
        done = script.run(edge) if edge.function else self._last_crossing(script, carried)
        script.finish(carried, done, {**places, edge.branch: edge.target})
        for other in along:
            done = script.run(other) if other.function else done
            script.finish(inner[other.branch], done, {other.branch: other.target})
        if not held and (edge.crossing or edge.kind is not EdgeKind.PURE):
            self._agree(script)
        return carried

    def allows(self, configuration: Configuration, edge: Edge) -> bool:
        """Return whether an edge alone may be used from a configuration: it is not excluded, is
        bound, and its required facts hold. For a pure edge that is no crossing this is sufficient.
        """
        try:
            self._allow(configuration, edge)
        except Unavailable:
            return False
        return True

    def closed(self, edge: Edge) -> bool:
        """Return whether an edge can be used from no configuration at all."""
        return next(self.terms.closures(edge), None) is not None

    def forget(self) -> None:
        """Delete all results. So their memory is free as soon as nobody uses the stepper."""
        for kept in (self._steps, self._routes, self._regions, self._blocks, self._hills):
            kept.clear()

    def _allow(self, configuration: Configuration, edge: Edge) -> None:
        allow(self.edges, self.terms, configuration, edge)

    def _transit(self, edge: Edge, loaded: Iterable[str]) -> tuple[FactKey, ...]:
        """Return the base digits in transit from the start of a crossing to its commit."""
        crossed = [edge.branch] if edge.crossing else []
        return tuple(fact for sub in (*crossed, *loaded) for fact in self.hierarchy.bases[sub])

    def _agree(self, script: StepDraft) -> None:
        broken = disagreements(self.hierarchy, script.configuration)
        if broken:
            names = ", ".join(f"{name}/{digit}" for name, digit in broken)
            raise Unavailable(f"{script.carried[0].edge} would leave {names} against its sub-SB")

    # links ----------------------------------------------------------------------------------------

    def _link(
        self, script: StepDraft, new: list[Carried], places: Mapping[str, str], held: Held
    ) -> None:
        """Let every crossing commit with the edges of its bases."""
        pairs = [(carried, carried.edge.branch) for carried in new if carried.edge.crossing]
        pairs += [(new[0], sub) for sub in places]
        script.links += [
            (carried, held[base])
            for carried, crossed in pairs
            for base, _ in self.hierarchy.bases[crossed]
            if base in held
        ]

    # sub-SBs ------------------------------------------------------------------------------------

    def _loaded(self, configuration: Configuration, edge: Edge) -> dict[str, str]:
        """Return the states into which a ``load`` edge puts the sub-SBs that it changes and those
        below.
        """
        failing = self.terms.failing
        may_fail = failing is None or edge.address in failing
        subs = dict(self.hierarchy.subs[edge.branch])
        found: dict[str, str] = {}
        for digit in (*edge.falls, *edge.rises):
            branch = self.hierarchy.blueprint[subs[digit]]
            state = branch.activating if digit in edge.rises else branch.initial
            found.update(standing(self.hierarchy, branch.name, state))
        for name, state in found.items():
            if state not in self.hierarchy.blueprint[name].table:
                raise Unavailable(f"{edge} loads {name} into {state}, which is no state of it")
            fails = failing_states(self.hierarchy.blueprint[name])
            if not may_fail and state in fails and configuration[name] not in fails:
                raise Unavailable(f"{edge} loads {name} into a failure: {fails[state]}")
        return found

    def _drive(self, script: StepDraft, edge: Edge, held: Held) -> None:
        """Move sub-SBs: first falls to INITIAL, then rises to ACTIVATING, in order of digits
        (clause 5).
        """
        subs = dict(self.hierarchy.subs[edge.branch])
        for digit in (*edge.falls, *edge.rises):
            branch = self.hierarchy.blueprint[subs[digit]]
            goal = branch.activating if digit in edge.rises else branch.initial
            if script.light and branch.name in self.plain:
                self._stride(script, branch, goal)
                continue
            if script.configuration[branch.name] == goal:
                continue
            if branch.name in self.plain:
                route = self._plain_route(script.configuration, branch, goal)
            else:
                way = self._sub_route(script.configuration, branch, goal, held)
                if script.light:
                    self._take(script, way, held)
                    continue
                route = way.edges
            for part in route:
                self._carry(script, part, held)

    def _take(self, script: StepDraft, way: SubRoute, held: Held) -> None:
        """Add a whole sub-route. Its changes and its cost are computed only once."""
        if way.whole is None:
            whole = StepDraft(script.configuration, light=True)
            before, self._within = self._within, way
            try:
                for part in way.edges:
                    self._carry(whole, part, held)
            finally:
                self._within = before
            way.whole = whole
        script.add(way.whole, way.region.names)

    def _plain_route(
        self, configuration: Configuration, branch: StateBranch, goal: str
    ) -> tuple[Edge, ...]:
        way = self.downhill(branch.name, goal).route(configuration[branch.name])
        if way is None:
            raise self._no_way(configuration, branch, goal, self._shut_in(branch))
        return way

    def _sub_route(
        self, configuration: Configuration, branch: StateBranch, goal: str, held: Held
    ) -> SubRoute:
        """Return the sub-SB's own edges to its goal, over the joint configurations below it (clause
        12).

        A route is kept for all configurations that are equal in its region.
        """
        region = self._region(branch.name, held)
        taken = frozenset(held[name].edge for name in region.border)
        key = (branch.name, goal, region.key(configuration), taken)
        way = self._routes.get(key)
        if way is None:
            # A search that was stopped goes on. One that gave up gives up again at once.
            way = self._routes[key] = self._search(configuration, branch, goal, held)
        self.allowance.use(way, self._within)
        if way.search is not None:
            before, self._within = self._within, way
            try:
                moves = way.search.found()
            finally:
                self._within = before
            if moves is None:
                way.closed = self._no_way(configuration, branch, goal, way.reasons).reasons
            else:
                way.edges = tuple(move.what for move in moves)
            way.search = None
        if way.closed:
            raise Unavailable(*way.closed)
        return way

    def _region(self, branch: str, held: Held) -> Region:
        key = (branch, frozenset(held))
        if key not in self._regions:
            self._regions[key] = Region(self.edges, branch, key[1])
        return self._regions[key]

    def _search(
        self, configuration: Configuration, branch: StateBranch, goal: str, held: Held
    ) -> SubRoute:
        """Return the search for a sub-route. It collects the reasons why edges cannot be used."""
        crossing = 1 if goal == branch.activating else -1
        region = self._region(branch.name, held)
        at = region.names.index(branch.name)
        way = SubRoute(region)

        def moves(node: Key) -> Iterator[Move]:
            """Yield the possible edges out of a node of the search, each with its cost."""
            here = {**configuration, **dict(zip(region.names, node, strict=True))}
            edges = self.edges.out(branch.name, node[at])
            for edge in edges:
                if edge.crossing not in (0, crossing):
                    continue
                heed()
                script = StepDraft(here, light=True)
                try:
                    self._carry(script, edge, held)
                except Unavailable as no:
                    way.reasons.update(dict.fromkeys(no.reasons))
                    continue
                to = region.key(script.configuration)
                yield Move(to, script.cost, 1, lambda: (), (edge.name,), edge)
            # This comes last, so that a node that is visited again after a stop is counted once.
            self.allowance.spend(len(edges), way)

        most = patience(self.hierarchy.blueprint.state_count)
        start = region.key(configuration)
        way.search = PlanSearch(start, lambda node: node[at] == goal, moves, most)
        return way

    def _no_way(
        self,
        configuration: Configuration,
        branch: StateBranch,
        goal: str,
        reasons: Iterable[str] = (),
    ) -> Unavailable:
        here = configuration[branch.name]
        words = f"no permitted way leads {branch.name} from {here} to {goal}"
        return Unavailable(words, *reasons)

    def _shut_in(self, branch: StateBranch) -> list[str]:
        """Return why edges of a flat sub-SB cannot be used, at most ``MOST_REASONS`` reasons."""
        if branch.name not in self._blocks:
            reasons: list[str] = []
            for state in branch.table:
                heed()
                for edge in self.edges.out(branch.name, state):
                    try:
                        self._allow({}, edge)
                    except Unavailable as no:
                        reasons += no.reasons
                if len(reasons) >= MOST_REASONS:
                    break
            self._blocks[branch.name] = reasons[:MOST_REASONS]
        return self._blocks[branch.name]

    def _stride(self, script: StepDraft, branch: StateBranch, goal: str) -> None:
        far = self.downhill(branch.name, goal).far.get(script.configuration[branch.name])
        if far is None:
            raise self._no_way(script.configuration, branch, goal, self._shut_in(branch))
        script.stride(branch.name, goal, *far)

    def downhill(self, sub: str, goal: str) -> Downhill:
        """Return the routes of a plain sub-SB to a goal, from all its states at once."""
        found = self._hills.get((sub, goal))
        if found is None:
            crossing = 1 if goal == self.hierarchy.blueprint[sub].activating else -1

            def allowed(edge: Edge) -> bool:
                """Return whether an edge may be part of a route to the goal."""
                return edge.crossing in (0, crossing) and self.allows({}, edge)

            found = self._hills[sub, goal] = Downhill(self.edges, sub, goal, allowed)
        return found

    @cached_property
    def plain(self) -> frozenset[str]:
        """The sub-SBs whose routes depend only on their own state: they have one base, no sub-SBs
        and no ``requires``.
        """
        return frozenset(
            name
            for name, bases in self.hierarchy.bases.items()
            if len(bases) == 1
            and not self.hierarchy.subs[name]
            and not any(
                note.requires for note in self.hierarchy.blueprint[name].notes.operations.values()
            )
        )

    def _last_crossing(self, script: StepDraft, carried: Carried) -> int:
        found = (one.done for one, base in script.links if base is carried and one is not carried)
        return 0 if script.light else max(found)
