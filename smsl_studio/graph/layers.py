"""Layers: the column of each state in a layered layout, counted from the left.

The states are put into an order in which few operations lead back, by the greedy method of Eades,
Lin and Smyth. INITIAL is the first. Operations that lead back in this order do not count, so cycles
do no harm.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.graph.build import BranchGraph
from smsl_studio.graph.shape import distances


def by_steps(graph: BranchGraph, start: int) -> list[int]:
    """Return for each state the smallest number of operations from INITIAL to it.

    A state that cannot be reached stands one column left of a neighbour.
    """
    layer = distances(graph.successors, start)
    near = distances(graph.neighbours, start)
    reached = [i for i, at in enumerate(layer) if at >= 0]
    while reached:
        further = []
        for state in reached:
            for other in graph.neighbours[state]:
                if layer[other] < 0:
                    layer[other] = max(layer[state] - 1, 0)
                    further.append(other)
        reached = further
    return [at if at >= 0 else max(near[i], 0) for i, at in enumerate(layer)]


def by_chains(graph: BranchGraph, start: int) -> list[int]:
    """Return for each state the length of the longest chain of forward operations to it.

    If no forward operation leads to a state, it stands just before the states that it leads to.
    """
    order = _greedy_order(graph, start)
    rank = {state: at for at, state in enumerate(order)}
    layer = [0] * len(graph)
    before: list[list[int]] = [[] for _ in order]
    after: list[list[int]] = [[] for _ in order]
    for state in order:
        for other in graph.neighbours[state]:
            if rank[other] > rank[state]:
                before[other].append(state)
                after[state].append(other)
    for state in order:
        layer[state] = max((layer[other] + 1 for other in before[state]), default=0)
    for state in reversed(order):
        if state != start and len(after[state]) > len(before[state]):
            layer[state] = min(layer[other] for other in after[state]) - 1
    least = min(layer, default=0)
    return [at - least for at in layer]


def _greedy_order(graph: BranchGraph, start: int) -> list[int]:
    """Return the states in an order in which few operations lead back. INITIAL is the first."""
    away = distances(graph.neighbours, start)
    left = dict.fromkeys(range(len(graph)))
    out = [_without(state, graph.successors[state]) for state in left]
    into = [_without(state, graph.predecessors[state]) for state in left]
    first, last = [start], list[int]()
    _drop(start, left, out, into)
    while left:
        sinks = [state for state in left if not out[state]]
        if sinks:
            # The sink that is farthest from INITIAL comes last.
            state = max(sinks, key=lambda i: (away[i], i))
            last.append(state)
        else:
            state = max(left, key=lambda i: (not into[i], len(out[i]) - len(into[i]), -away[i], -i))
            first.append(state)
        _drop(state, left, out, into)
    return first + last[::-1]


def _without(state: int, others: Sequence[int]) -> dict[int, None]:
    return {other: None for other in others if other != state}


def _drop(
    state: int,
    left: dict[int, None],
    out: list[dict[int, None]],
    into: list[dict[int, None]],
) -> None:
    del left[state]
    for other in out[state]:
        into[other].pop(state, None)
    for other in into[state]:
        out[other].pop(state, None)
