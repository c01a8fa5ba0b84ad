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
"""The least and the largest distance of two columns of narrow nodes (pixels)."""
LETTER, LETTERS = 6.2, 4
"""The mean width of a letter of a label (pixels), and the steps in which lengths count. Few new
names are so much longer that a layout changes.
"""


def in_layers(graph: BranchGraph, ties: Ties, layer: Sequence[int]) -> Floats:
    """Return the centre of each node, for the column that each state stands in."""
    knot = int(STEP[1])
    row = 2 * knot
    found = in_order(columns_of(ties, layer))
    y = heights(found, [row if v < found.states else knot for v in range(len(found.left))])
    places = np.zeros((len(graph), 2), dtype=np.float64)
    for x, column in zip(column_places(graph, ties, layer), found.columns, strict=True):
        lowest = None
        for v in column:
            if v < len(graph):
                # Whole steps of the lattice, in the order of the column.
                wanted = round(y[v] / knot) * knot
                lowest = wanted if lowest is None else max(wanted, lowest + row)
                places[v] = x, lowest
    return places


def column_places(graph: BranchGraph, ties: Ties, layer: Sequence[int]) -> list[float]:
    """Return the x of each column: all as far apart as the longest label needs."""
    nodes = 2.0 * float(ties.half[:, 0].max())
    apart = nodes + 16.0 + LETTER * longest_label(graph.operations)
    apart = round(min(max(apart, COLUMN), max(WIDEST, nodes + 60.0)))
    return [float(at * apart) for at in range(max(layer, default=-1) + 1)]


def words_of(branch: StateBranch) -> tuple[int, int]:
    """Return the length of the longest name of a state and of the longest label, in whole steps.

    Nothing else in a layout depends on words.
    """
    longest = -(-max(map(len, branch.table), default=0) // LETTERS) * LETTERS
    return longest, longest_label(graph_of(branch).operations)


def longest_label(operations: Sequence[str]) -> int:
    """Return the length of the longest label, without the prefix that a picture leaves out."""
    first, last = min(operations, default=""), max(operations, default="")
    same = 0
    while same < min(len(first), len(last)) and first[same] == last[same]:
        same += 1
    longest = max(map(len, operations), default=0) - (first[:same].rfind("_") + 1)
    return -(-longest // LETTERS) * LETTERS
