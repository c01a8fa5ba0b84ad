"""The cheapest path through a graph that is built on demand.

Ties are decided by the number of names, the number of moves, and then the names.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from heapq import heappop, heappush
from itertools import count
from math import inf
from typing import Any, Generic, NamedTuple, TypeVar

from smsl_studio.errors import PlanningError
from smsl_studio.stop import heed

Node = TypeVar("Node", bound=Hashable)


class Move(NamedTuple):
    """One move of a search: its target, its cost, and the object that it stands for.

    ``number`` is the number of edges of the routed SB in it, and ``names`` returns their names.
    ``key`` decides between moves that are equal otherwise. ``what`` is returned with the result.
    """

    to: Any
    cost: float
    number: int
    names: Callable[[], tuple[str, ...]]
    key: tuple[str, ...]
    what: Any


Rank = tuple[float, int, int]
MOST = 50_000


def patience(states: int) -> int:
    """Return how many joint configurations are searched before a search is given up.

    It is enough for every state of a flat SB. A tree of many sub-SBs has more joint configurations
    than anyone would wait for.
    """
    return MOST + 4 * states


def nothing(node: object) -> float:
    """Return 0, the estimate of the remaining cost if nothing is known."""
    return 0.0


def cheapest(
    start: Node,
    is_goal: Callable[[Node], bool],
    moves: Callable[[Node], Iterable[Move]],
    most: int = MOST,
    ahead: Callable[[Node], float] = nothing,
) -> list[Move] | None:
    """Return the cheapest sequence of moves to a goal, None if there is none (see
    ``PlanSearch``).
    """
    return PlanSearch(start, is_goal, moves, most, ahead).found()


class PlanSearch(Generic[Node]):
    """The search for the cheapest sequence of moves to a goal (A*).

    Ties are decided by the number of names, the number of moves, and then the names, move by move.
    Costs must not be negative. ``ahead`` is a lower bound of the remaining cost, ``inf`` if there
    is no way. Along a move it must not fall by more than the move's cost.
    """

    def __init__(
        self,
        start: Node,
        is_goal: Callable[[Node], bool],
        moves: Callable[[Node], Iterable[Move]],
        most: int = MOST,
        ahead: Callable[[Node], float] = nothing,
    ) -> None:
        self._start, self._is_goal, self._moves = start, is_goal, moves
        self._most, self._ahead = most, ahead
        self._best: dict[Node, Rank] = {start: (0.0, 0, 0)}
        self._origins: dict[Node, list[tuple[Node, Move]]] = {start: []}
        self._order = count()
        self._heap: list[tuple[Rank, int, Rank, Node]] = []
        left = ahead(start)
        if left < inf:
            self._heap.append(((left, 0, 0), next(self._order), (0.0, 0, 0), start))
        self._goals: list[Node] = []
        self._reached: Rank | None = None
        self._looked_at = 0

    def found(self) -> list[Move] | None:
        """Return the moves, None if no path leads to a goal. PlanningError after ``most`` nodes.

        It heeds the listener (see ``stop``) at every node. If it is called off and asked again, it
        goes on.
        """
        heap, best, origins, order = self._heap, self._best, self._origins, self._order
        moves, ahead = self._moves, self._ahead
        while heap:
            heed()
            hoped, _, rank, node = heap[0]
            if rank != best[node]:
                heappop(heap)
                continue
            if self._reached is not None and hoped > self._reached:
                break
            if self._is_goal(node):
                heappop(heap)
                self._goals.append(node)
                self._reached = hoped
                continue
            if self._looked_at >= self._most:
                raise PlanningError(
                    f"no plan was found among the first {self._most:,} joint configurations",
                    advice="Name a nearer goal, or split the blueprint into fewer sub-SBs.",
                )
            # The node stays on the heap until all its moves are known, because their search may be
            # called off.
            onward = list(moves(node))
            heappop(heap)
            self._looked_at += 1
            for move in onward:
                # Costs are rounded, so that sums which differ only in their last bits are equal.
                further = (round(rank[0] + move.cost, 9), rank[1] + move.number, rank[2] + 1)
                known = best.get(move.to)
                if known is None or further < known:
                    left = ahead(move.to)
                    if left == inf:
                        continue
                    best[move.to] = further
                    origins[move.to] = [(node, move)]
                    hope = (round(further[0] + left, 9), further[1], further[2])
                    heappush(heap, (hope, next(order), further, move.to))
                elif further == known:
                    origins[move.to].append((node, move))
        return _first_by_name(self._start, self._goals, origins) if self._goals else None


def _first_by_name(
    start: Node, goals: list[Node], origins: dict[Node, list[tuple[Node, Move]]]
) -> list[Move]:
    onward: dict[Node, list[Move]] = {}
    seen = set(goals)
    waiting = list(goals)
    while waiting:
        for origin, move in origins[waiting.pop()]:
            onward.setdefault(origin, []).append(move)
            if origin not in seen:
                seen.add(origin)
                waiting.append(origin)
    route: list[Move] = []
    node = start
    while node in onward:
        ways = onward[node]
        move = min(ways, key=lambda move: (move.names(), move.key)) if len(ways) > 1 else ways[0]
        route.append(move)
        node = move.to
    return route
