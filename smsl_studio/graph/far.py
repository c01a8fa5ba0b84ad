"""The weight from every state to the nearest goal, by Dijkstra's search backwards from the goals.

Small graphs use a heap, large ones scipy. Weights are whole numbers of 1 or more, or ``inf`` for a
closed edge. Sums are exact.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from heapq import heappop, heappush
from math import inf
from typing import Any

from smsl_studio.graph.build import BranchGraph

LARGE = 20_000
"""From this number of states on, scipy is quicker, although loading it takes 0.4 s."""
EXACT = 2**53
"""A float holds every whole number up to this one exactly. scipy computes in floats."""

Weight = float
"""A whole number, or ``inf``."""


class Spread:
    """Searches backwards from the goals over all edges. ``weights`` may change between searches.

    Change them only by ``set_weight``, because scipy has its own copy of them.
    """

    def __init__(self, graph: BranchGraph, weights: list[Weight], large: int = LARGE) -> None:
        self.weights = weights
        self._graph = graph
        self._matrix = _Matrix(graph, weights) if len(graph) >= large else None
        share = 8 if self._matrix is None else 64
        self.patience = max(256, len(graph) // share)
        """A search that visits more states than this takes longer than a search of all states."""

    def set_weight(self, edge: int, weight: Weight) -> None:
        """Change the weight of an edge to a whole number of 1 or more, or to ``inf`` to close
        it.
        """
        self.weights[edge] = weight
        if self._matrix is not None:
            self._matrix.set_weight(edge, weight)

    def far(self, goals: Collection[int]) -> Sequence[Weight]:
        """Return the least weight from each state to a goal, ``inf`` if no path leads to one."""
        if self._matrix is not None and self._matrix.most < EXACT:
            return self._matrix.far(goals)
        return self._by_heap(goals)

    def _by_heap(self, goals: Collection[int]) -> Sequence[Weight]:
        edges_in, sources = self._graph.edges_in, self._graph.sources
        weights = self.weights
        far: list[Weight] = [inf] * len(self._graph)
        heap: list[tuple[Weight, int]] = []
        for goal in goals:
            far[goal] = 0
            heap.append((0, goal))
        while heap:
            weight, state = heappop(heap)
            if weight > far[state]:
                continue
            for edge in edges_in[state]:
                further, source = weight + weights[edge], sources[edge]
                if further < far[source]:
                    far[source] = further
                    heappush(heap, (further, source))
        return far


class _Matrix:
    """The reversed graph as a matrix of scipy. It is built once, and later only its weights
    change.
    """

    def __init__(self, graph: BranchGraph, weights: Sequence[Weight]) -> None:
        import numpy as np
        from scipy.sparse import csr_array

        targets = np.asarray(graph.targets, dtype=np.int64)
        order = np.argsort(targets, kind="stable")
        self._place = np.empty_like(order)
        self._place[order] = np.arange(len(order))
        self._data = np.asarray(weights, dtype=np.float64)[order]
        starts = np.zeros(len(graph) + 1, dtype=np.int32)
        np.cumsum(np.bincount(targets, minlength=len(graph)), out=starts[1:])
        rows = np.asarray(graph.sources, dtype=np.int32)[order]
        shape = (len(graph), len(graph))
        self._array: Any = csr_array((self._data, rows, starts), shape=shape, copy=False)
        finite = self._data[np.isfinite(self._data)]
        self._length = len(graph)
        self._heaviest = float(finite.max()) if finite.size else 0.0

    @property
    def most(self) -> float:
        """An upper bound of the weight of any path."""
        return self._heaviest * self._length

    def set_weight(self, edge: int, weight: Weight) -> None:
        """Change the weight of an edge, at its place in the matrix."""
        self._array.data[self._place[edge]] = weight
        if weight < inf:
            self._heaviest = max(self._heaviest, weight)

    def far(self, goals: Collection[int]) -> Sequence[Weight]:
        """Return the least weight from each state to a goal, ``inf`` if no path leads to one."""
        from scipy.sparse.csgraph import dijkstra

        found: list[Weight] = dijkstra(self._array, indices=sorted(goals), min_only=True).tolist()
        return found
