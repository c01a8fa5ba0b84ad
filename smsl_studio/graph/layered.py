"""A layered layout: columns from left to right, INITIAL in the first one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.brandes_koepf import heights
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.column_order import columns_of, in_order
from smsl_studio.graph.crossings import Floats, Ties
from smsl_studio.graph.local_search import STEP

COLUMN, WIDEST = 218, 320
"""The smallest and the largest distance between two columns of narrow nodes (pixels)."""
LETTER, LETTERS = 6.2, 4
"""The mean width of a letter of a label (pixels), and the step to which lengths are rounded up. So
a new name seldom changes the whole layout.
"""


def in_layers(graph: BranchGraph, ties: Ties, layer: Sequence[int]) -> Floats:
    """Return the centre of each node, (n, 2) in pixels. ``layer`` has the column of each state."""
    knot = int(STEP[1])
    row = 2 * knot
    found = in_order(columns_of(ties, layer))
    y = heights(found, [row if v < found.states else knot for v in range(len(found.left))])
    places = np.zeros((len(graph), 2), dtype=np.float64)
    for x, column in zip(column_places(graph, ties, layer), found.columns, strict=True):
        lowest = None
        for v in column:
            if v < len(graph):
                # The y is a whole number of steps of the lattice, and keeps the column's order.
                wanted = round(y[v] / knot) * knot
                lowest = wanted if lowest is None else max(wanted, lowest + row)
                places[v] = x, lowest
    return places


def column_places(graph: BranchGraph, ties: Ties, layer: Sequence[int]) -> list[float]:
    """Return the x of each column (pixels). The longest label fits between any two columns."""
    nodes = 2.0 * float(ties.half[:, 0].max())
    apart = nodes + 16.0 + LETTER * longest_label(graph.operations)
    apart = round(min(max(apart, COLUMN), max(WIDEST, nodes + 60.0)))
    return [float(at * apart) for at in range(max(layer, default=-1) + 1)]


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
