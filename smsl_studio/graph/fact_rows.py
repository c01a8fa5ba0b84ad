"""A layout in rows: there is one row for each value of an independent fact.

A fact is independent if each of its values occurs with all combinations of the other facts. An
example is a tool pose that can be planned at any time. The column of a state is the number of other
facts that differ from those of INITIAL.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.crossings import Ties
from smsl_studio.graph.layered import column_places

Point = tuple[float, float]
ROW = 172.0
"""Pixels between rows."""
MOST_ROWS = 4


def in_fact_rows(branch: StateBranch, ties: Ties) -> dict[str, Point] | None:
    """Return the place of each state (pixels). INITIAL is at the top left.

    It is None if no fact is independent, or if two states of a row would have the same column.
    """
    graph = graph_of(branch)
    facts = [branch.facts(name) for name in graph.names]
    start = graph.index.get(branch.initial, 0)
    if len(facts) < 4 or len(facts[0]) < 2 or not _steps_by_one(graph, facts, start):
        return None
    digit = _row_digit(graph, facts)
    if digit is None:
        return None
    values = dict.fromkeys((facts[start][digit], *(state[digit] for state in facts)))
    rests = [state[:digit] + state[digit + 1 :] for state in facts]
    away = [_differences(rests[start], rest) for rest in rests]
    used = sorted(set(away))
    if len(used) * len(values) != len(graph):
        return None
    x = column_places(ties, [used.index(steps) for steps in away])
    rows = list(values)
    return {
        name: (float(x[used.index(steps)]), rows.index(state[digit]) * ROW)
        for name, steps, state in zip(graph.names, away, facts, strict=True)
    }


def _steps_by_one(graph: BranchGraph, facts: Sequence[tuple[str, ...]], start: int) -> bool:
    """Return whether at least half of the operations lead to the next column or the one before.

    Only operations that change facts count.
    """
    away = [_differences(facts[start], state) for state in facts]
    moves = [
        abs(away[target] - away[source])
        for source, target in zip(graph.sources, graph.targets, strict=True)
        if facts[source] != facts[target]
    ]
    return bool(moves) and moves.count(1) * 2 >= len(moves)


def _differences(one: tuple[str, ...], other: tuple[str, ...]) -> int:
    """Return in how many facts two states differ."""
    return sum(a != b for a, b in zip(one, other, strict=True))


def _row_digit(graph: BranchGraph, facts: Sequence[tuple[str, ...]]) -> int | None:
    """Return the number of the independent fact that makes the rows, or None if there is none.

    If there are several, few operations should change the fact together with other facts. Of equal
    ones, the last is taken.
    """
    found: list[tuple[int, int]] = []
    states = set(facts)
    for digit in range(len(facts[0])):
        values = {state[digit] for state in facts}
        rests = {state[:digit] + state[digit + 1 :] for state in facts}
        few = 2 <= len(values) <= MOST_ROWS and len(rests) > 1
        if few and len(values) * len(rests) == len(states):
            mixed = sum(
                facts[s][digit] != facts[t][digit] and _differences(facts[s], facts[t]) > 1
                for s, t in zip(graph.sources, graph.targets, strict=True)
            )
            found.append((mixed, -digit))
    return None if len(states) < len(facts) or not found else -min(found)[1]
