"""Questions about the graph of a State Branch: reachability, dead ends, traps, components.

All answers are names, in written order where order is seen. Operations to unknown targets count
for nothing here; rule R02 reports them.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of


def reachable(branch: StateBranch, start: str) -> frozenset[str]:
    """The states that operations lead to from ``start``, itself included."""
    graph = graph_of(branch)
    return _named(graph, flood(graph.successors, (graph.number(start),)))


def can_reach(branch: StateBranch, goal: str) -> frozenset[str]:
    """The states from which operations lead to ``goal``, itself included."""
    graph = graph_of(branch)
    return _named(graph, flood(graph.predecessors, (graph.number(goal),)))


def dead_ends(branch: StateBranch) -> tuple[str, ...]:
    """The states that no operation leaves."""
    return tuple(name for name, operations in branch.table.items() if not operations)


def traps(branch: StateBranch, start: str, goal: str) -> tuple[str, ...]:
    """The states ``start`` leads to and from which nothing leads to ``goal``."""
    inside, saved = reachable(branch, start), can_reach(branch, goal)
    return tuple(name for name in branch.table if name in inside and name not in saved)


def components(branch: StateBranch) -> tuple[tuple[str, ...], ...]:
    """The strongly connected components: states that lead to each other, in written order."""
    graph = graph_of(branch)
    found = [sorted(group) for group in strong(graph.successors)]
    return tuple(tuple(graph.names[i] for i in group) for group in sorted(found))


def islands(branch: StateBranch) -> tuple[tuple[str, ...], ...]:
    """The weakly connected parts: states with no operation between them and the rest."""
    graph = graph_of(branch)
    seen: set[int] = set()
    found: list[tuple[str, ...]] = []
    for state in range(len(graph)):
        if state not in seen:
            part = flood(graph.neighbours, (state,))
            seen |= part
            found.append(tuple(graph.names[i] for i in sorted(part)))
    return tuple(found)


def connected(branch: StateBranch, states: Iterable[str]) -> tuple[tuple[str, ...], ...]:
    """Some states in groups: those that operations between them join, in either direction."""
    graph = graph_of(branch)
    wanted = [graph.number(state) for state in states]
    left = set(wanted)
    found: list[tuple[str, ...]] = []
    for start in wanted:
        if start not in left:
            continue
        left.discard(start)
        part = [start]
        for state in part:
            for other in (*graph.successors[state], *graph.predecessors[state]):
                if other in left:
                    left.discard(other)
                    part.append(other)
        found.append(tuple(graph.names[number] for number in sorted(part)))
    return tuple(found)


def flood(near: list[list[int]], starts: Iterable[int]) -> set[int]:
    """The numbers of all states that ``near`` leads to from ``starts``."""
    seen = set(starts)
    queue = list(seen)
    while queue:
        for state in near[queue.pop()]:
            if state not in seen:
                seen.add(state)
                queue.append(state)
    return seen


def distances(near: list[list[int]], start: int) -> list[int]:
    """The number of steps from ``start`` to each state by ``near``; -1 where none leads."""
    found = [-1] * len(near)
    found[start] = 0
    queue = deque((start,))
    while queue:
        state = queue.popleft()
        step = found[state] + 1
        for other in near[state]:
            if found[other] < 0:
                found[other] = step
                queue.append(other)
    return found


def _named(graph: BranchGraph, numbers: Iterable[int]) -> frozenset[str]:
    return frozenset(graph.names[number] for number in numbers)


def strong(near: list[list[int]]) -> list[list[int]]:
    """What is joined in both directions, by number.

    Tarjan's algorithm without recursion, since a chain may be longer than the stack.
    """
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    on_stack: set[int] = set()
    groups: list[list[int]] = []
    for root in range(len(near)):
        if root in order:
            continue
        work = [(root, 0)]
        while work:
            state, position = work.pop()
            if position == 0:
                order[state] = low[state] = len(order)
                stack.append(state)
                on_stack.add(state)
            else:
                low[state] = min(low[state], low[near[state][position - 1]])
            for step in range(position, len(near[state])):
                other = near[state][step]
                if other not in order:
                    work.append((state, step + 1))
                    work.append((other, 0))
                    break
                if other in on_stack:
                    low[state] = min(low[state], order[other])
            else:
                if low[state] == order[state]:
                    groups.append(_pop_until(stack, on_stack, state))
    return groups


def _pop_until(stack: list[int], on_stack: set[int], state: int) -> list[int]:
    group: list[int] = []
    while True:
        top = stack.pop()
        on_stack.discard(top)
        group.append(top)
        if top == state:
            return group
