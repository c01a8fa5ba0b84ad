"""Questions about the graph of a State Branch: reachability, dead ends, traps, components.

Public answers are names, and tuples are in written order. An operation to an unknown target has no
edge here; rule R02 reports it.
"""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of


def reachable(branch: StateBranch, start: str) -> frozenset[str]:
    """Return the states that operations lead to from ``start``, with ``start`` itself."""
    graph = graph_of(branch)
    return _named(graph, flood(graph.successors, (graph.number(start),)))


def can_reach(branch: StateBranch, goal: str) -> frozenset[str]:
    """Return the states from which operations lead to ``goal``, with ``goal`` itself."""
    graph = graph_of(branch)
    return _named(graph, flood(graph.predecessors, (graph.number(goal),)))


def dead_ends(branch: StateBranch) -> tuple[str, ...]:
    """Return the states that no operation leaves."""
    return tuple(name for name, operations in branch.table.items() if not operations)


def traps(branch: StateBranch, start: str, goal: str) -> tuple[str, ...]:
    """Return the states that ``start`` leads to and from which no operations lead to ``goal``."""
    inside, saved = reachable(branch, start), can_reach(branch, goal)
    return tuple(name for name in branch.table if name in inside and name not in saved)


def components(branch: StateBranch) -> tuple[tuple[str, ...], ...]:
    """Return the strongly connected components: groups of states that lead to each other."""
    graph = graph_of(branch)
    found = [sorted(group) for group in strong(graph.successors)]
    return tuple(tuple(graph.names[i] for i in group) for group in sorted(found))


def islands(branch: StateBranch) -> tuple[tuple[str, ...], ...]:
    """Return the weakly connected components: groups of states that no operation joins with the
    rest.
    """
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
    """Return ``states`` in groups. Operations between states of a group, in either direction, join
    it.
    """
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


def bottom_groups(branch: StateBranch, states: Iterable[str]) -> tuple[tuple[str, ...], ...]:
    """Return the strongly connected groups of ``states`` that no operation leaves towards another
    of them.
    """
    graph = graph_of(branch)
    wanted = sorted(graph.number(state) for state in states)
    place = {state: index for index, state in enumerate(wanted)}
    near = [[place[t] for t in graph.successors[s] if t in place] for s in wanted]
    found = []
    for group in strong(near):
        if set(group).issuperset(target for state in group for target in near[state]):
            found.append(tuple(graph.names[wanted[index]] for index in sorted(group)))
    return tuple(found)


def flood(near: list[list[int]], starts: Iterable[int]) -> set[int]:
    """Return the numbers of all states that ``near`` leads to from ``starts``."""
    seen = set(starts)
    queue = list(seen)
    while queue:
        for state in near[queue.pop()]:
            if state not in seen:
                seen.add(state)
                queue.append(state)
    return seen


def distances(near: list[list[int]], start: int) -> list[int]:
    """Return the number of steps from ``start`` to each state by ``near``, -1 if there is no
    path.
    """
    found = [-1] * len(near)
    found[start] = step = 0
    reached = [start]
    while reached:
        step += 1
        further: list[int] = []
        for state in reached:
            for other in near[state]:
                if found[other] < 0:
                    found[other] = step
                    further.append(other)
        reached = further
    return found


def _named(graph: BranchGraph, numbers: Iterable[int]) -> frozenset[str]:
    return frozenset(graph.names[number] for number in numbers)


def strong(near: list[list[int]]) -> list[list[int]]:
    """Return the strongly connected components, as numbers.

    It is Tarjan's algorithm without recursion, because a chain may be longer than Python's stack.
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
