"""The order of the states in each column of a layered layout. In a good order few lines cross.

A line that passes a column has a knot there. A knot is sorted like a state. A sweep sorts every
column by the mean place of the neighbours in the column before. Then two that stand side by side
in a column change places, as long as fewer lines cross.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from random import Random

import numpy as np

from smsl_studio.graph.crossings import Ties
from smsl_studio.stop import heed

STARTS, SWEEPS = 5, 10
FEW_SWEEPS, MANY = 3, 800
"""With more than ``MANY`` states and knots, there are one start and ``FEW_SWEEPS`` sweeps."""
MOST_KNOTS = 2_000
"""If the lines need more knots than this, they get none, because the order would take too long."""


@dataclass(frozen=True, eq=False)
class OrderedColumns:
    """The columns from left to right. States have the numbers below ``states``, knots those above.

    ``left`` and ``right`` have for each number its neighbours in the columns beside it, and the
    weight of the line to each neighbour.
    """

    states: int
    columns: list[list[int]]
    left: list[list[tuple[int, float]]]
    right: list[list[tuple[int, float]]]
    crossings: float = 0.0
    """The number of lines that cross between neighbouring columns."""


def columns_of(ties: Ties, layer: Sequence[int]) -> OrderedColumns:
    """Return the columns before they are sorted, with knots for the lines that pass columns.

    ``layer`` has the column of each state.
    """
    count = len(layer)
    columns: list[list[int]] = [[] for _ in range(max(layer, default=-1) + 1)]
    for state, at in enumerate(layer):
        columns[at].append(state)
    left: list[list[tuple[int, float]]] = [[] for _ in range(count)]
    right: list[list[tuple[int, float]]] = [[] for _ in range(count)]
    spans = sum(max(abs(layer[a] - layer[b]) - 1, 0) for a, b in ties.pairs.tolist())
    for pair, weight in zip(ties.pairs.tolist(), ties.weight.tolist(), strict=True):
        last, end = sorted(pair, key=layer.__getitem__)
        if layer[end] - layer[last] > 1 and spans > MOST_KNOTS:
            continue
        for at in range(layer[last] + 1, layer[end] + 1):
            to = end
            if at < layer[end]:
                to = len(left)
                left.append([])
                right.append([])
                columns[at].append(to)
            right[last].append((to, weight))
            left[to].append((last, weight))
            last = to
    return OrderedColumns(count, columns, left, right)


def in_order(given: OrderedColumns) -> OrderedColumns:
    """Return the columns in the best order found. The search starts from several orders."""
    best: tuple[float, list[list[int]]] | None = None
    many = len(given.left) > MANY
    for start in range(1 if many else STARTS):
        heed()
        columns = [_begin(column, start) for column in given.columns]
        for sweep in range(FEW_SWEEPS if many else SWEEPS):
            heed()
            _sweep(given, columns, sweep % 2 == 0)
            if not many:
                _transpose(given, columns)
            crossings = _crossings(given, columns)
            if best is None or crossings < best[0]:
                best = crossings, [list(column) for column in columns]
            if not best[0]:
                break
    crossings, columns = best or (0.0, [])
    return OrderedColumns(given.states, columns, given.left, given.right, crossings)


def _begin(column: list[int], start: int) -> list[int]:
    if start == 0:
        return list(column)
    if start == 1:
        return column[::-1]
    return Random(start).sample(column, len(column))


def _sweep(given: OrderedColumns, columns: list[list[int]], onwards: bool) -> None:
    """Sort each column by the mean place of the neighbours in the column before it."""
    order = range(1, len(columns)) if onwards else range(len(columns) - 2, -1, -1)
    near = given.left if onwards else given.right
    for number in order:
        column = columns[number]
        before = {v: i for i, v in enumerate(columns[number - 1 if onwards else number + 1])}
        keys: dict[int, float] = {}
        for slot, v in enumerate(column):
            weight = sum(w for _, w in near[v])
            total = sum(before[u] * w for u, w in near[v])
            # A state without neighbours stays where it is.
            share = len(before) / len(column)
            keys[v] = round(total / weight if weight else slot * share, 6)
        column.sort(key=keys.__getitem__)


def _transpose(given: OrderedColumns, columns: list[list[int]]) -> None:
    """Let two that stand side by side in a column change places, as long as fewer lines cross."""
    for number, column in enumerate(columns):
        sides = [
            (near, {v: i for i, v in enumerate(columns[other])})
            for near, other in ((given.left, number - 1), (given.right, number + 1))
            if 0 <= other < len(columns)
        ]
        better = True
        while better:
            better = False
            for slot in range(len(column) - 1):
                v, u = column[slot], column[slot + 1]
                gain = 0.0
                for near, place in sides:
                    for a, wa in near[v]:
                        for b, wb in near[u]:
                            gain += wa * wb * ((place[a] > place[b]) - (place[a] < place[b]))
                if gain > 0:
                    column[slot], column[slot + 1] = u, v
                    better = True


def _crossings(given: OrderedColumns, columns: list[list[int]]) -> float:
    found = 0.0
    for one, other in pairwise(columns):
        place = {v: i for i, v in enumerate(other)}
        lines = [(i, place[u], w) for i, v in enumerate(one) for u, w in given.right[v]]
        if lines:
            p, q, w = np.array(lines, dtype=np.float64).T
            crossed = (p[:, None] < p[None]) & (q[:, None] > q[None])
            found += float((crossed * (w[:, None] * w[None])).sum())
    return found
