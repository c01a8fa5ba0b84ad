"""Bottlenecks: the states and operations through which every way between two states leads."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of


@dataclass(frozen=True)
class Bottlenecks:
    """What every way passes, in the order in which it is passed.

    ``edges`` are pairs (state, operation). ``length`` is the number of operations of a shortest
    way, 0 if there is none.
    """

    states: tuple[str, ...] = ()
    edges: tuple[tuple[str, str], ...] = ()
    length: int = 0


def bottlenecks(
    branch: StateBranch, start: str, goal: str, shut: Container[str] = frozenset()
) -> Bottlenecks:
    """Return what every way from ``start`` to ``goal`` passes. Ways do not enter states in
    ``shut``. AddressError if an end is no state.

    One pass is enough: along a shortest way, everything is looked at that can be reached without
    the rest of this way. The time grows linearly with the number of operations.
    """
    graph = graph_of(branch)
    first, last = graph.number(start), graph.number(goal)
    closed = [name in shut for name in graph.names] if shut else [False] * len(graph)
    way = _shortest(graph, first, last, closed)
    on_way = {state: index for index, state in enumerate(way)}
    entered: list[list[int]] = [[] for _ in way]
    states: list[str] = []
    edges: list[tuple[str, str]] = []
    far = 0
    for index, place in enumerate(way[:-1]):
        waiting = [place]
        for state in waiting:
            for edge in graph.edges_out(state):
                target = graph.targets[edge]
                if closed[target]:
                    continue
                hit = on_way.get(target)
                if hit is None:
                    closed[target] = True
                    waiting.append(target)
                else:
                    entered[hit].append(edge)
                    far = max(far, hit)
        if far == index + 1:
            states.append(graph.names[way[far]])
            if len(entered[far]) == 1:
                only = entered[far][0]
                edges.append((graph.names[graph.sources[only]], graph.operations[only]))
    return Bottlenecks(tuple(states[:-1]), tuple(edges), max(0, len(way) - 1))


def _shortest(graph: BranchGraph, start: int, goal: int, closed: list[bool]) -> list[int]:
    """Return the states of a shortest way, empty if there is none or if it has no operation."""
    came = {start: start}
    waiting = [start]
    for state in waiting:
        if goal in came:
            break
        for edge in graph.edges_out(state):
            target = graph.targets[edge]
            if target not in came and not closed[target]:
                came[target] = state
                waiting.append(target)
    if goal not in came or goal == start:
        return []
    way = [goal]
    while way[-1] != start:
        way.append(came[way[-1]])
    return way[::-1]
