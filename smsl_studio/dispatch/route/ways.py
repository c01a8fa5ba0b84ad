"""The goal trees of SBs that move alone. They are kept during a run, and changes update them.

An SB moves alone if it is a root without sub-SBs. Its edges then depend only on its own state, and
on facts of SBs that do not move.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.configuration import Configuration, Hierarchy
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.joint import JointAction, JointStep
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.dispatch.route.effort import fact_count, refuse_too_long
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.goal_tree import GoalTree
from smsl_studio.stop import heed

MOST = 8
"""The largest number of trees of one SB: for its goal, for ways out of failure, and for questions
between.
"""
Asked = tuple[frozenset[str], bool]
"""The goals, and whether blocked edges are open at a higher cost."""
NOTHING: frozenset[tuple[str, int]] = frozenset()


class Ways:
    """The routes of the roots without sub-SBs in one hierarchy.

    The terms may differ in exclusions and costs. The edges with a function must always be the same.
    """

    def __init__(self, hierarchy: Hierarchy) -> None:
        self.hierarchy = hierarchy
        self._lone: dict[str, _Lone] = {}
        self._written = hierarchy.blueprint.operation_count
        self._facts = fact_count(hierarchy.blueprint)

    def alone(self, stepper: Stepper, branch: str) -> bool:
        """Return whether an SB's routes depend on nothing but its own state, under these terms."""
        terms = stepper.terms
        opened = terms.extra is not None and branch in self._lone
        plain = terms.extra is None and terms.failing is not None and not terms.failing
        return (
            (plain or opened)
            and not self.hierarchy.bases[branch]
            and not self.hierarchy.subs[branch]
        )

    def way(
        self, stepper: Stepper, start: Configuration, branch: str, goals: Collection[str]
    ) -> tuple[JointStep, ...] | None:
        """Return the joint steps of the cheapest route to one of some states, None if there is
        none.
        """
        lone = self._lone.get(branch)
        if lone is None:
            lone = self._lone[branch] = _Lone(
                self.hierarchy.blueprint[branch], stepper, self._written
            )
        return lone.way(stepper, start, goals, self._facts)


class _Lone:
    """One SB that moves alone: its graph, the edges that are always closed, its trees and its
    steps.

    ``written`` is the number of edges in the whole blueprint.
    """

    def __init__(self, branch: StateBranch, stepper: Stepper, written: int) -> None:
        self._branch = branch
        self._graph = graph_of(branch)
        self._trees: dict[Asked, tuple[GoalTree, Mapping[int, float]]] = {}
        self._steps: dict[tuple[int, float | None], JointStep] = {}
        self._never = frozenset((*self._unbound(stepper, written), *self._into_failure()))
        self._declared = _declared(branch, self._graph)
        self._asking = tuple(self._with_requires())

    def way(
        self, stepper: Stepper, start: Configuration, goals: Collection[str], facts: int
    ) -> tuple[JointStep, ...] | None:
        """Return the joint steps to one of the goals, None if there is no route. PlanningError if
        there are too many for this number of ``facts``.
        """
        name, graph = self._branch.name, self._graph
        numbered = ((self._number(a), cost) for a, cost in stepper.terms.costs.items())
        costs = {number: cost for number, cost in numbered if number is not None}
        costs.update(self._dearer(stepper))
        tree = self._tree(stepper, start, frozenset(goals), costs)
        edges = tree.route(graph.index[start[name]])
        if edges is None:
            return None
        refuse_too_long(len(edges), facts)
        return tuple(self._step(stepper, edge, costs.get(edge)) for edge in edges)

    def _tree(
        self,
        stepper: Stepper,
        start: Configuration,
        goals: frozenset[str],
        costs: Mapping[int, float],
    ) -> GoalTree:
        """Return the tree for some goals under the present terms. ``costs`` has the costs that
        differ from the declared ones.
        """
        graph, terms = self._graph, stepper.terms
        closed = set(self._never) if terms.extra is None else set()
        closed.update(e for a in terms.shut if (e := self._number(a)) is not None)
        closed.update(e for e in self._asking if not self._granted(stepper, start, e))
        if terms.hazards:
            closed.update(self._into_hazard(stepper, start))
        key = goals, terms.extra is not None
        heed()
        tree, priced = self._trees.pop(key, (None, {}))
        if tree is None:
            numbers = [graph.index[goal] for goal in goals if goal in graph.index]
            tree = GoalTree(graph, numbers, self._declared, closed)
        for edge in tree.closed - closed:
            tree.open(edge)
        for edge in closed - tree.closed:
            tree.close(edge)
        if costs != priced:
            tree.reprice(
                {
                    edge: costs[edge] if edge in costs else self._cost(edge)
                    for edge in dict.fromkeys((*priced, *costs))
                    if costs.get(edge) != priced.get(edge)
                }
            )
        self._trees[key] = tree, costs
        if len(self._trees) > MOST:
            del self._trees[next(iter(self._trees))]
        return tree

    def _dearer(self, stepper: Stepper) -> Iterator[tuple[int, float]]:
        """Yield the blocked edges with their costs, in which the penalty is included."""
        extra = stepper.terms.extra
        if extra is None:
            return
        closed = (self._number(address) for address in extra.closed)
        for number in {*self._never, *(one for one in closed if one is not None)}:
            edge = stepper.edges.get(self._address(number))
            assert edge is not None
            yield number, edge.cost

    def _cost(self, edge: int) -> float:
        return 1.0 if self._declared is None else self._declared[edge]

    def _step(self, stepper: Stepper, number: int, cost: float | None) -> JointStep:
        """Return the joint step of an edge that moves only its own SB. ``cost`` is its cost if that
        differs from the declared one, and None otherwise.
        """
        kept = self._steps.get((number, cost))
        if kept is None:
            edge = stepper.edges.get(self._address(number))
            assert edge is not None
            kept = self._steps[number, cost] = _alone(edge)
        return kept

    def _address(self, number: int) -> Address:
        graph = self._graph
        state = graph.names[graph.sources[number]]
        return Address(self._branch.name, state, graph.operations[number])

    def _number(self, address: Address) -> int | None:
        graph = self._graph
        state = graph.index.get(address.state) if address.branch == self._branch.name else None
        if state is None:
            return None
        found = (e for e in graph.edges_out(state) if graph.operations[e] == address.operation)
        return next(found, None)

    # closed edges --------------------------------------------------------------------------------

    def _unbound(self, stepper: Stepper, written: int) -> Iterator[int]:
        """Yield the edges without a function, if the world says which edges have one."""
        bound = stepper.terms.bound
        if bound is None or len(bound) == written:
            return
        for number in range(len(self._graph.targets)):
            heed()
            if self._address(number) not in bound:
                yield number

    def _into_failure(self) -> Iterator[int]:
        failing, graph = failing_states(self._branch), self._graph
        if failing:
            bad = [name in failing for name in graph.names]
            for number, target in enumerate(graph.targets):
                heed()
                if bad[target] and not bad[graph.sources[number]]:
                    yield number

    def _into_hazard(self, stepper: Stepper, start: Configuration) -> Iterator[int]:
        """Yield the edges into states that meet a hazard while all other SBs stay."""
        name, graph = self._branch.name, self._graph
        barred = {state for one in stepper.terms.hazards for state in one.bars(name, start)}
        if barred:
            bad = [state in barred for state in graph.names]
            for number, target in enumerate(graph.targets):
                heed()
                if bad[target]:
                    yield number

    def _with_requires(self) -> Iterator[int]:
        """Yield the edges that require facts."""
        branch, graph = self._branch, self._graph
        if not any(note.requires for note in branch.notes.operations.values()):
            return
        for number, (source, name) in enumerate(zip(graph.sources, graph.operations, strict=True)):
            heed()
            if branch.operation_note(graph.names[source], name).requires:
                yield number

    def _granted(self, stepper: Stepper, start: Configuration, number: int) -> bool:
        edge = stepper.edges.get(self._address(number))
        assert edge is not None
        here = {**start, edge.branch: edge.source}
        return not any(True for _ in stepper.edges.missing(edge, here))


def _declared(branch: StateBranch, graph: BranchGraph) -> list[float] | None:
    """Return the declared cost of each edge. None if all cost 1, which is usual."""
    notes = branch.notes.operations
    if all(note.cost is None for note in notes.values()):
        return None
    commons = {name: notes.get(note_key(name)) for name in dict.fromkeys(graph.operations)}
    if len(notes) == sum(note is not None for note in commons.values()):
        costs = {n: 1.0 if o is None or o.cost is None else o.cost for n, o in commons.items()}
        return [costs[name] for name in graph.operations]
    ends = zip(graph.sources, graph.operations, strict=True)
    return [branch.cost(graph.names[source], name) for source, name in ends]


def _alone(edge: Edge) -> JointStep:
    """Return the joint step of an edge that runs its own function and moves nothing else."""
    place = {edge.branch: edge.target}
    action = JointAction(edge, (edge,), place, (edge,), (edge,), place, NOTHING, NOTHING)
    return JointStep(edge, (edge,), (action,), round(edge.cost, 9), place)
