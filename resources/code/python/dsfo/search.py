"""The cheapest way through a graph that is built on demand (A*)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from heapq import heappop, heappush
from itertools import count
from math import inf
from typing import Any, NamedTuple

from .errors import PlanningError

Node = tuple[str, ...]
"""A joint configuration: the states of SBs in one order."""


class Move(NamedTuple):
    """One move: where it leads, its cost, and the number of edges of the routed SB in it.

    ``names`` returns the names of these edges. ``key`` decides between moves that are else equal.
    """

    to: Node
    cost: float
    number: int
    names: Callable[[], tuple[str, ...]]
    key: tuple[str, ...]
    what: Any


Rank = tuple[float, int, int]


def cheapest(
    start: Node,
    is_goal: Callable[[Node], bool],
    moves: Callable[[Node], Iterable[Move]],
    most: int,
    ahead: Callable[[Node], float] = lambda node: 0.0,
) -> list[Move] | None:
    """Return the cheapest moves to a goal, None if there are none. PlanningError after ``most``
    nodes.

    Ties: cost, then number of edges of the routed SB, then number of moves, then names, move by
    move. ``ahead`` is a lower bound of the cost that is left.
    """
    best: dict[Node, Rank] = {start: (0.0, 0, 0)}
    origins: dict[Node, list[tuple[Node, Move]]] = {start: []}
    order, goals, reached, looked_at = count(), list[Node](), None, 0
    heap: list[tuple[Rank, int, Rank, Node]] = []
    if ahead(start) < inf:
        heap.append(((ahead(start), 0, 0), next(order), (0.0, 0, 0), start))
    while heap:
        hoped, _, rank, node = heappop(heap)
        if rank != best[node]:
            continue
        if reached is not None and hoped > reached:
            break
        if is_goal(node):
            goals.append(node)
            reached = hoped
            continue
        looked_at += 1
        if looked_at > most:
            raise PlanningError(
                f"no plan was found among the first {most:,} joint configurations",
                "Name a nearer goal, or split the blueprint into fewer sub-SBs.",
            )
        for move in moves(node):
            # Costs are rounded, so that sums which differ only in their last bits are equal.
            further = (round(rank[0] + move.cost, 9), rank[1] + move.number, rank[2] + 1)
            known = best.get(move.to)
            if known is None or further < known:
                left = ahead(move.to)
                if left == inf:
                    continue
                best[move.to], origins[move.to] = further, [(node, move)]
                hope = (round(further[0] + left, 9), further[1], further[2])
                heappush(heap, (hope, next(order), further, move.to))
            elif further == known:
                origins[move.to].append((node, move))
    return _first_by_name(start, goals, origins) if goals else None


def _first_by_name(
    start: Node, goals: list[Node], origins: dict[Node, list[tuple[Node, Move]]]
) -> list[Move]:
    """Return the one of the equally cheap ways that is first by its names, move by move."""
    onward: dict[Node, list[Move]] = {}
    seen, waiting = set(goals), list(goals)
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
        move = min(ways, key=lambda one: (one.names(), one.key)) if len(ways) > 1 else ways[0]
        route.append(move)
        node = move.to
    return route
