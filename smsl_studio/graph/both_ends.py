"""The lightest path between two states, found by Dijkstra's search from both ends.

Weights are whole numbers of 1 or more, so sums are exact. If several paths have the same weight,
the one with the first sequence of operation names is taken.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from heapq import heappop, heappush

from smsl_studio.graph.build import BranchGraph


def lightest(
    graph: BranchGraph, start: int, goal: int, weights: Sequence[int], never: int
) -> list[int] | None:
    """Return the edges of the lightest path, in order, or None if no path leads to the goal.

    An edge with the weight ``never`` is not used. ``never`` is larger than the weight of any path.
    """
    ahead = _End(graph.all_edges_out, graph.targets, start, never)
    back = _End(graph.edges_in, graph.sources, goal, never)
    best = never if start != goal else 0
    met: list[int] = [goal] if start == goal else []
    # Stop when the next states of both ends are further apart than the best path is long. At least
    # one end has then settled each state of every best path.
    while ahead.heap and back.heap and ahead.heap[0] + back.heap[0] <= best:
        one, other = (ahead, back) if ahead.width <= back.width else (back, ahead)
        best = one.widen(weights, other.far, best, met)
    if best == never:
        return None
    return list(_Ways(graph, weights, ahead, back, best, met).first(start, goal))


class _End:
    """The search from one end.

    ``far`` has the least weight found for each state. ``waiting`` has the states whose edges are
    not looked at yet, by weight, and ``heap`` has these weights.
    """

    __slots__ = ("edges", "ends", "far", "heap", "never", "waiting")

    def __init__(
        self, edges: Sequence[Sequence[int]], ends: Sequence[int], begin: int, never: int
    ) -> None:
        self.edges, self.ends, self.never = edges, ends, never
        self.far = [never] * len(edges)
        self.far[begin] = 0
        self.waiting = {0: [begin]}
        self.heap = [0]

    @property
    def width(self) -> int:
        """The number of states that ``widen`` looks at next."""
        return len(self.waiting[self.heap[0]])

    @property
    def settled(self) -> int:
        """The weight below which a state is settled: all its edges have been looked at."""
        return self.heap[0] if self.heap else self.never

    def widen(self, weights: Sequence[int], other: Sequence[int], best: int, met: list[int]) -> int:
        """Look at the edges of the nearest states that wait, and return the new weight of the best
        path.

        ``other`` has the weight from each state to the other end. ``best`` is the weight of the
        best path so far. ``met`` has the states where both ends meet on such a path, and is
        updated.
        """
        far, edges, ends, waiting, heap = self.far, self.edges, self.ends, self.waiting, self.heap
        here = heappop(heap)
        for state in waiting.pop(here):
            if far[state] != here:
                continue  # a smaller weight was found for it later
            for edge in edges[state]:
                weight, end = here + weights[edge], ends[edge]
                if weight >= far[end]:
                    continue
                far[end] = weight
                if weight in waiting:
                    waiting[weight].append(end)
                else:
                    waiting[weight] = [end]
                    heappush(heap, weight)
                whole = weight + other[end]
                if whole < best:
                    best = whole
                    met.clear()
                if whole == best:
                    met.append(end)
        return best


class _Ways:
    """All the best paths of one search. ``met`` has the states in which both ends have met."""

    def __init__(
        self,
        graph: BranchGraph,
        weights: Sequence[int],
        ahead: _End,
        back: _End,
        best: int,
        met: Sequence[int],
    ) -> None:
        self._graph, self._weights = graph, weights
        self._ahead, self._back = ahead.far, back.far
        self._settled = back.settled
        far = self._back
        known = (state for state in met if far[state] < self._settled or not far[state])
        self._leads = self._leading(known, ahead.settled)

    def _leading(self, met: Iterator[int], settled: int) -> set[int]:
        """Return the states on best paths between the start and the states of ``met``."""
        graph, weights, far = self._graph, self._weights, self._ahead
        found = set(met)
        left = list(found)
        while left:
            state = left.pop()
            for edge in graph.edges_in[state]:
                source = graph.sources[edge]
                near = far[source]
                if near < settled and near + weights[edge] == far[state] and source not in found:
                    found.add(source)
                    left.append(source)
        return found

    def first(self, state: int, goal: int) -> Iterator[int]:
        """Yield the edges of the path with the first sequence of names. The names in a state are
        unique, so the smallest name in each state gives the smallest sequence.
        """
        graph = self._graph
        while state != goal:
            edge = min(self._on(state), key=graph.operations.__getitem__)
            yield edge
            state = graph.targets[edge]

    def _on(self, state: int) -> list[int]:
        """Return the edges of a state that lie on a best path."""
        graph, weights, back, ahead = self._graph, self._weights, self._back, self._ahead
        edges, targets, left = graph.all_edges_out[state], graph.targets, back[state]
        if left < self._settled:
            return [edge for edge in edges if back[targets[edge]] + weights[edge] == left]
        here, leads = ahead[state], self._leads
        return [
            edge
            for edge in edges
            if targets[edge] in leads and here + weights[edge] == ahead[targets[edge]]
        ]
