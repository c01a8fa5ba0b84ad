"""The lightest way between two states: a search from both ends until they have met.

Weights are whole numbers of 1 or more, so that sums are exact. Of ways that weigh the same, the
first by the sequence of their operations' names is taken.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from heapq import heappop, heappush

from smsl_studio.graph.build import BranchGraph


def lightest(
    graph: BranchGraph, start: int, goal: int, weights: Sequence[int], never: int
) -> list[int] | None:
    """The edges of the lightest way, in order; None where no way leads there.

    An edge that may not be used weighs ``never``, which is more than any way weighs.
    """
    ahead = _End(graph.all_edges_out, graph.targets, start, never)
    back = _End(graph.edges_in, graph.sources, goal, never)
    best = never if start != goal else 0
    met: list[int] = [goal] if start == goal else []
    # Once the next states of both ends lie further apart than the best way is long, at least one
    # end has settled each state of every best way.
    while ahead.heap and back.heap and ahead.heap[0] + back.heap[0] <= best:
        one, other = (ahead, back) if ahead.width <= back.width else (back, ahead)
        best = one.widen(weights, other.far, best, met)
    if best == never:
        return None
    return list(_Ways(graph, weights, ahead, back, best, met).first(start, goal))


class _End:
    """The search from one end. ``far`` has the least weight found for each state, ``waiting`` the
    states whose edges are to be looked at, by weight, and ``heap`` these weights."""

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
        """How many states are looked at next."""
        return len(self.waiting[self.heap[0]])

    @property
    def settled(self) -> int:
        """The edges of all states that are nearer than this were looked at."""
        return self.heap[0] if self.heap else self.never

    def widen(self, weights: Sequence[int], other: Sequence[int], best: int, met: list[int]) -> int:
        """Look at the edges of the nearest states that wait; the weight of the best way then.

        ``other`` is how far states are from the other end; ``best`` is the weight of the best way
        so far, ``met`` the states in which both ends have met on it.
        """
        far, edges, ends, waiting, heap = self.far, self.edges, self.ends, self.waiting, self.heap
        here = heappop(heap)
        for state in waiting.pop(here):
            if far[state] != here:
                continue  # it was found to be nearer
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
    """All the best ways of one search; ``met`` are the states in which its ends have met."""

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
        """The states between the start and those in which the ends have met, on a best way."""
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
        """The edges of the first way by names. The names in a state are unique, so the smallest
        one at each state leads to the smallest sequence."""
        graph = self._graph
        while state != goal:
            edge = min(self._on(state), key=graph.operations.__getitem__)
            yield edge
            state = graph.targets[edge]

    def _on(self, state: int) -> list[int]:
        """The edges out of a state on a best way that go on with one."""
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
