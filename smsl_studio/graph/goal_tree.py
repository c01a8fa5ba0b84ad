"""The ways from all states of a State Branch to its goals: one search, then one look a step.

The way is the first by cost, then by the number of operations, then by the sequence of their names.
An edge that is closed or becomes dearer is repaired from the state that asks, not by a new spread:
what it was worth before can only have grown, so the old weights guide a search that ends as soon as
it meets a way that the change did not touch. Only what becomes cheaper asks for a new spread.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence, Set
from heapq import heappop, heappush
from math import gcd, inf

from smsl_studio.graph.build import BranchGraph
from smsl_studio.graph.far import LARGE, Spread, Weight

FINE = 10**9
"""Costs are counted in billionths, so that 0.1 + 0.2 and 0.3 are a tie."""
_HALT = -1


class GoalTree:
    """Ways to the nearest of ``goals`` (states by number) over the edges of a graph.

    ``costs`` has one number from 0 on for each edge (None: 1 each); edges are by number, too.
    """

    def __init__(
        self,
        graph: BranchGraph,
        goals: Collection[int],
        costs: Sequence[float] | None = None,
        closed: Iterable[int] = (),
        large: int = LARGE,
    ) -> None:
        self.graph = graph
        self.goals = frozenset(goals)
        self._closed = set(closed)
        self._costs = [round(cost * FINE) for cost in costs] if costs is not None else None
        self._large = large
        self._scale = self._unit = 1
        self._spread = self._fresh()
        self._far: Sequence[Weight] | None = None
        self._forget()

    # what is asked ------------------------------------------------------------------------------

    def next(self, state: int) -> int | None:
        """The edge to take first; None in a goal, and where no way leads to one."""
        found = self._known.get(state)
        if found is None:
            found = self._known[state] = self._find(state)
        return None if found == _HALT else found

    def cost(self, state: int) -> float | None:
        """What the way costs; None where there is none."""
        weight = self._weight(state)
        return None if weight == inf else int(weight) // self._scale * self._unit / FINE

    def route(self, state: int) -> list[int] | None:
        """The edges of the way, in order; None where there is none."""
        if self._weight(state) == inf:
            return None
        edges: list[int] = []
        while (edge := self.next(state)) is not None:
            edges.append(edge)
            state = self.graph.targets[edge]
        return edges

    # what changes -------------------------------------------------------------------------------

    def close(self, edge: int) -> None:
        """Leave an edge out of every way."""
        self._closed.add(edge)
        self._reweigh(edge, inf)

    def open(self, edge: int) -> None:
        """Let an edge that was closed be used again, at the cost it has."""
        self._closed.discard(edge)
        self._reweigh(edge, self._weight_of(edge))

    def reprice(self, costs: Mapping[int, float]) -> None:
        """Give edges other costs."""
        if self._costs is None:
            self._costs = [FINE] * len(self.graph.targets)
        for edge, cost in costs.items():
            self._costs[edge] = round(cost * FINE)
        if any(self._costs[edge] % self._unit for edge in costs):
            self._spread, self._far = self._fresh(), None
            self._forget()
            return
        for edge in costs:
            if edge not in self._closed:
                self._reweigh(edge, self._weight_of(edge))

    @property
    def closed(self) -> Set[int]:
        """The edges that no way uses."""
        return self._closed

    # weights ------------------------------------------------------------------------------------

    def _fresh(self) -> Spread:
        """Work out all weights: the cost in units that divide all costs, and 1 for the count."""
        costs = self._costs
        self._unit = FINE if costs is None else gcd(*set(costs)) or 1
        self._scale = max(1, len(self.graph))
        if costs is None:
            weights: list[Weight] = [self._scale + 1] * len(self.graph.targets)
        else:
            weights = [cost // self._unit * self._scale + 1 for cost in costs]
        for edge in self._closed:
            weights[edge] = inf
        return Spread(self.graph, weights, self._large)

    def _weight_of(self, edge: int) -> int:
        cost = FINE if self._costs is None else self._costs[edge]
        return cost // self._unit * self._scale + 1

    def _reweigh(self, edge: int, weight: Weight) -> None:
        """Note a weight and drop what was found; drop the search too where the weight gets too
        high."""
        self._spread.set_weight(edge, weight)
        far = self._far
        if far is None:
            return
        source = self.graph.sources[edge]
        if weight + far[self.graph.targets[edge]] < far[source]:
            self._far = None
            self._forget()
            return
        cut = self._cut
        if source not in self.goals and far[source] < inf and self._tight(source) == _HALT:
            cut.add(source)
        else:
            cut.discard(source)
        self._forget(cut)

    def _forget(self, cut: set[int] | None = None) -> None:
        """Drop what was found; ``cut`` are the states that no edge brings as near as it was."""
        self._known: dict[int, int] = {}
        self._left: dict[int, Weight] = {}
        self._clean: dict[int, bool] = {}
        self._cut = cut if cut is not None else set()
        far = self._far
        self._floor = min((far[state] for state in self._cut), default=inf) if far else inf

    # finding ------------------------------------------------------------------------------------

    def _weight(self, state: int) -> Weight:
        """The weight of the way from a state."""
        self.next(state)
        left = self._left.get(state)
        return self._spread_out()[state] if left is None else left

    def _spread_out(self) -> Sequence[Weight]:
        if self._far is None:
            self._far = self._spread.far(self.goals)
            self._forget()
        return self._far

    def _find(self, state: int) -> int:
        far = self._spread_out()
        if self._cut and far[state] < inf and not self._is_clean(state):
            return self._repaired(state)
        return self._tight(state)

    def _tight(self, state: int) -> int:
        """The first edge by name that brings the state as near as the spread has it."""
        far, weights, graph = self._spread_out(), self._spread.weights, self.graph
        here = far[state]
        found, name = _HALT, ""
        if here == inf:
            return found
        for edge in range(graph.starts[state], graph.starts[state + 1]):
            if far[graph.targets[edge]] + weights[edge] == here:
                other = graph.operations[edge]
                if found == _HALT or other < name:
                    found, name = edge, other
        return found

    def _is_clean(self, state: int) -> bool:
        """Whether the way that the spread has for a state meets no state that is cut."""
        far, clean = self._spread_out(), self._clean
        passed: list[int] = []
        while True:
            known = clean.get(state)
            if known is None and state in self._cut:
                known = False
            elif known is None and far[state] < self._floor:
                known = True
            if known is not None:
                clean.update(dict.fromkeys(passed, known))
                return known
            passed.append(state)
            state = self.graph.targets[self._tight(state)]

    def _repaired(self, start: int) -> int:
        """The first edge from a state whose old way is cut, found from there on.

        The old weights are guides that never promise too little, so that every state is met by its
        best way. Where too many are met, a new spread is quicker.
        """
        far, weights, graph = self._spread_out(), self._spread.weights, self.graph
        patience = self._spread.patience
        walked: dict[int, Weight] = {start: 0}
        met: dict[int, None] = {}
        ends: set[int] = set()
        best: Weight = inf
        heap: list[tuple[Weight, int]] = [(far[start], start)]
        while heap:
            whole, state = heappop(heap)
            if whole > best:
                break
            if state in met:
                continue
            met[state] = None
            if self._is_clean(state):
                best = whole
                ends.add(state)
                continue
            if len(met) > patience:
                self._far = None
                return self._find(start)
            here = walked[state]
            for edge in range(graph.starts[state], graph.starts[state + 1]):
                target = graph.targets[edge]
                further = here + weights[edge]
                if further < walked.get(target, inf) and far[target] < inf:
                    walked[target] = further
                    heappush(heap, (further + far[target], target))
        if not ends:
            self._left[start] = inf
            return _HALT
        self._keep(walked, met, ends, best)
        return self._known[start]

    def _keep(
        self, walked: dict[int, Weight], met: dict[int, None], ends: set[int], best: Weight
    ) -> None:
        """Note the first edge by name, and what is left, for every state on a best way."""
        weights, graph = self._spread.weights, self.graph
        on = set(ends)
        for state in sorted(met, key=walked.__getitem__, reverse=True):
            if state in ends:
                continue
            here = walked[state]
            edges = [
                edge
                for edge in range(graph.starts[state], graph.starts[state + 1])
                if graph.targets[edge] in on and walked[graph.targets[edge]] == here + weights[edge]
            ]
            if edges:
                on.add(state)
                self._known[state] = min(edges, key=graph.operations.__getitem__)
                self._left[state] = best - here
