"""The cheapest paths from all states of a State Branch to its goals. One search serves all states.

The path of a state is the first by cost, then by the number of operations, then by the sequence of
their names. If an edge is closed or becomes more expensive, weights can only grow. The old weights
are then lower bounds for a short search (A*) from the state that is asked about. It ends when it
meets a path that the change did not touch. Only an edge that becomes cheaper needs a new search of
all states.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence, Set
from heapq import heappop, heappush
from math import gcd, inf

from smsl_studio.graph.build import BranchGraph
from smsl_studio.graph.far import LARGE, Spread, Weight

FINE = 10**9
"""Costs are counted in billionths, so that 0.1 + 0.2 equals 0.3."""
_HALT = -1


class GoalTree:
    """The cheapest paths to the nearest of ``goals``, in a graph whose weights may change.

    States and edges are numbers of ``graph``. ``costs`` has the cost (0 or more) of each edge; None
    means 1 each.
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

    # questions ----------------------------------------------------------------------------------

    def next(self, state: int) -> int | None:
        """Return the first edge of a state's path. None in a goal, or if no path leads to one."""
        found = self._known.get(state)
        if found is None:
            found = self._known[state] = self._find(state)
        return None if found == _HALT else found

    def cost(self, state: int) -> float | None:
        """Return the cost of a state's path. None if there is none."""
        weight = self._weight(state)
        return None if weight == inf else int(weight) // self._scale * self._unit / FINE

    def route(self, state: int) -> list[int] | None:
        """Return the edges of a state's path, in order. None if there is none."""
        if self._weight(state) == inf:
            return None
        edges: list[int] = []
        while (edge := self.next(state)) is not None:
            edges.append(edge)
            state = self.graph.targets[edge]
        return edges

    # changes ------------------------------------------------------------------------------------

    def close(self, edge: int) -> None:
        """Close an edge, so that no path uses it."""
        self._closed.add(edge)
        self._reweigh(edge, inf)

    def open(self, edge: int) -> None:
        """Open a closed edge again, at its cost."""
        self._closed.discard(edge)
        self._reweigh(edge, self._weight_of(edge))

    def reprice(self, costs: Mapping[int, float]) -> None:
        """Change the costs of edges."""
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
        """The edges that are closed."""
        return self._closed

    # weights ------------------------------------------------------------------------------------

    def _fresh(self) -> Spread:
        """Return a new search with all weights. The weight of an edge is its cost, in units that
        divide all costs, times a scale, plus 1 for the edge itself. So cost counts before the
        number of edges.
        """
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
        """Change a weight. The paths found so far are dropped. The weights from all states are
        dropped too if the change makes a path cheaper.
        """
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
        """Drop the paths found so far. ``cut`` has the states that no edge brings as near to a goal
        as before.
        """
        self._known: dict[int, int] = {}
        self._left: dict[int, Weight] = {}
        self._clean: dict[int, bool] = {}
        self._cut = cut if cut is not None else set()
        far = self._far
        self._floor = min((far[state] for state in self._cut), default=inf) if far else inf

    # searches -----------------------------------------------------------------------------------

    def _weight(self, state: int) -> Weight:
        """Return the weight of a state's path."""
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
        """Return the first edge by name on a path as short as the last search of all states
        says.
        """
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
        """Return whether the old path of a state meets no state of the cut."""
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
        """Return the first edge of a state whose old path is cut, from a search that starts here.

        The old weights never exceed the true ones, so the search meets each state by its best path.
        After ``patience`` states it gives up, because a search of all states is then quicker.
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
        """Keep the first edge by name, and the weight that is left, for every state on a best
        path.
        """
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
