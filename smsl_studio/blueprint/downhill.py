"""The routes to one state of an SB without sub-SBs from all its states: their costs and edges."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping

from smsl_studio.blueprint.edges import Edge, Edges
from smsl_studio.stop import heed

Far = tuple[float, int]
"""The cost and the number of edges."""


class Downhill:
    """The cheapest routes from all states of an SB to ``goal``, over the ``allowed`` edges.

    It is made once, and then serves routes from hundreds of joint configurations.
    """

    def __init__(
        self, edges: Edges, branch: str, goal: str, allowed: Callable[[Edge], bool]
    ) -> None:
        self._edges, self._branch, self._goal, self._allowed = edges, branch, goal, allowed
        self.far: Mapping[str, Far] = self._spread()

    def route(self, state: str) -> tuple[Edge, ...] | None:
        """Return the edges from a state to the goal, None if there is no route. Of equally cheap
        routes it is the one with the fewest edges, then the first by names.
        """
        if state not in self.far:
            return None
        found: list[Edge] = []
        while state != self._goal:
            cost, count = self.far[state]
            edge = min(
                (
                    edge
                    for edge in self._edges.out(self._branch, state)
                    if self._allowed(edge)
                    and edge.target in self.far
                    and self._by(edge) == (cost, count)
                ),
                key=lambda edge: edge.name,
            )
            found.append(edge)
            state = edge.target
        return tuple(found)

    def _by(self, edge: Edge) -> Far:
        cost, count = self.far[edge.target]
        return round(cost + edge.cost, 9), count + 1

    def _spread(self) -> dict[str, Far]:
        into: dict[str, list[Edge]] = {}
        for state in self._edges.blueprint[self._branch].table:
            heed()
            for edge in self._edges.out(self._branch, state):
                if self._allowed(edge):
                    into.setdefault(edge.target, []).append(edge)
        far: dict[str, Far] = {self._goal: (0.0, 0)}
        heap: list[tuple[Far, str]] = [((0.0, 0), self._goal)]
        while heap:
            heed()
            (cost, count), state = heapq.heappop(heap)
            if (cost, count) != far[state]:
                continue
            for edge in into.get(state, ()):
                further = (round(cost + edge.cost, 9), count + 1)
                if edge.source not in far or further < far[edge.source]:
                    far[edge.source] = further
                    heapq.heappush(heap, (further, edge.source))
        return far
