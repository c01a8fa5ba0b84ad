"""A layered layout: columns from left to right, INITIAL in the first one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.brandes_koepf import heights
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.column_order import columns_of, in_order
from smsl_studio.graph.crossings import Floats, Ties

COLUMN, WIDEST = 218, 320
"""The least and the largest distance of two columns of narrow nodes (pixels)."""
ROW = 110
"""The distance of two rows (pixels)."""
BESIDE = 12.0
"""The room beside a label, in addition to that around nodes (pixels)."""
LETTER, LETTERS = 6.2, 4
"""The mean width of a letter of a label (pixels), and the step to which lengths are rounded up. So
a new name seldom changes the whole layout.
"""


def in_layers(ties: Ties, layer: Sequence[int]) -> Iterator[Floats]:
    """Yield the centre of each node, for the column that each state stands in. If no lines cross,
    a second layout has columns that are farther apart.
    """
    count = len(layer)
    knot = int(ties.step[1])
    row = 2 * knot
    found = in_order(columns_of(ties, layer))
    y = heights(found, [row if v < found.states else knot for v in range(len(found.left))])
    places = np.zeros((count, 2), dtype=np.float64)
    for x, column in zip(column_places(ties, layer), found.columns, strict=True):
        lowest = None
        for v in column:
            if v < count:
                # Whole steps of the lattice, in the order of the column.
                wanted = round(y[v] / knot) * knot
                lowest = wanted if lowest is None else max(wanted, lowest + row)
                places[v] = x, lowest
    yield places
    if not found.crossings:
        yield _wide(ties, layer, places)


def _wide(ties: Ties, layer: Sequence[int], places: Floats) -> Floats:
    """Return places with columns so far apart that steep lines between them do not touch the other
    nodes of these columns, but no more than twice as far apart as usual.
    """
    wide, high = ties.half.max(axis=0, initial=0.0)
    usual, row = 2.0 * ties.step
    column = np.array(layer, dtype=np.intp)
    a, b = ties.pairs.T
    beside = np.abs(column[a] - column[b]) == 1
    rise = np.abs(places[a, 1] - places[b, 1])
    shift = np.zeros(int(column.max()) + 1)
    for at, steep in zip(np.minimum(column[a], column[b])[beside], rise[beside], strict=True):
        needed = min(wide * steep / (row - high), 2.0 * usual) - usual
        shift[at + 1] = max(shift[at + 1], np.ceil(needed / ties.step[0]) * ties.step[0])
    return np.asarray(places + np.outer(shift.cumsum()[column], (1.0, 0.0)))


def column_places(ties: Ties, layer: Sequence[int]) -> list[float]:
    """Return the x of each column: all as far apart as the longest label needs."""
    return [2.0 * at * float(ties.step[0]) for at in range(max(layer, default=-1) + 1)]


def lattice(graph: BranchGraph, half: Floats) -> Floats:
    """Return half the distance of two columns, and half that of two rows (whole pixels)."""
    nodes = 2.0 * float(half[:, 0].max())
    apart = nodes + BESIDE + LETTER * longest_label(graph.operations)
    apart = min(max(apart, COLUMN), max(WIDEST, nodes + 60.0))
    return np.array([round(apart / 2.0), ROW / 2.0])


def words_of(branch: StateBranch) -> tuple[int, int]:
    """Return the lengths of the longest state name and of the longest label (letters, rounded up).

    A layout depends on nothing else in the names.
    """
    longest = -(-max(map(len, branch.table), default=0) // LETTERS) * LETTERS
    return longest, longest_label(graph_of(branch).operations)


def longest_label(operations: Sequence[str]) -> int:
    """Return the length of the longest label (letters), without the prefix that all labels share.

    A picture does not show this prefix.
    """
    first, last = min(operations, default=""), max(operations, default="")
    same = 0
    while same < min(len(first), len(last)) and first[same] == last[same]:
        same += 1
    longest = max(map(len, operations), default=0) - (first[:same].rfind("_") + 1)
    return -(-longest // LETTERS) * LETTERS
