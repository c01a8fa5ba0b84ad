"""The cheapest way through a space that unfolds as it is walked: ties by count, then by names."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Hashable, Iterable
from itertools import count
from math import inf
from typing import Any, NamedTuple, TypeVar

from smsl_studio.errors import PlanningError

Node = TypeVar("Node", bound=Hashable)


class Move(NamedTuple):
    """One step of a search: where it leads, what it costs, and what it stands for.

    ``number`` is how many of the routed SB's edges are in it, ``names`` tells their names when
    asked; ``key`` decides between moves equal in all this; ``what`` is handed back untouched.
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
    """How many joint configurations are looked at before a search is given up.

    Every state of a flat SB, and then some: joint configurations multiply, and a tree of many
    sub-SBs has more of them than anyone would wait for.
    """
    return MOST + 4 * states


def nothing(node: object) -> float:
    """Nothing is known of what is still to be paid."""
    return 0.0


def cheapest(
    start: Node,
    is_goal: Callable[[Node], bool],
    moves: Callable[[Node], Iterable[Move]],
    most: int = MOST,
    ahead: Callable[[Node], float] = nothing,
) -> list[Move] | None:
    """The cheapest sequence of moves to a goal, or None where there is none.

    Ties: cost, number of names, number of moves, then the names themselves, move by move. Costs
    must not be negative. ``ahead`` says what is still to be paid at least, ``inf`` where no way
    leads on; along a move it falls by no more than the move costs. PlanningError after ``most``
    nodes (see ``patience``).
    """
    best: dict[Node, Rank] = {start: (0.0, 0, 0)}
    origins: dict[Node, list[tuple[Node, Move]]] = {start: []}
    order = count()
    heap: list[tuple[Rank, int, Rank, Node]] = []
    if ahead(start) < inf:
        heap.append(((ahead(start), 0, 0), next(order), (0.0, 0, 0), start))
    goals: list[Node] = []
    reached: Rank | None = None
    looked_at = 0
    while heap:
        hoped, _, rank, node = heapq.heappop(heap)
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
                advice="Name a nearer goal, or split the blueprint into fewer sub-SBs.",
            )
        for move in moves(node):
            # Rounded so that sums which differ only in their last bits still tie.
            further = (round(rank[0] + move.cost, 9), rank[1] + move.number, rank[2] + 1)
            known = best.get(move.to)
            if known is None or further < known:
                left = ahead(move.to)
                if left == inf:
                    continue
                best[move.to] = further
                origins[move.to] = [(node, move)]
                hope = (round(further[0] + left, 9), further[1], further[2])
                heapq.heappush(heap, (hope, next(order), further, move.to))
            elif further == known:
                origins[move.to].append((node, move))
    return _first_by_name(start, goals, origins) if goals else None


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
