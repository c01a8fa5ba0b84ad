"""Numbers the configurations of a diagram without a gap, so that a byte each is enough.

The number of a configuration is how many come before it. For each node at the top of a group of SBs
a table says how many come before each value of the field of the group, and which node follows.
"""

from __future__ import annotations

import numpy as np

from smsl_studio.graph.joint.codes import Array, CodeLayout
from smsl_studio.graph.joint.diagram import Diagram
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.stop import heed

MOST_ENTRIES = 8_000_000
"""The largest number of entries of the tables, 64 MB."""

_Level = tuple[Array, Array]
"""The rows of the nodes below, and how many configurations come before each of them."""


class RankNumbers:
    """Numbers the configurations of the set ``whole``. Row 0 of each table is the empty set.

    TooLarge if the tables would be too large.
    """

    def __init__(self, layout: CodeLayout, diagram: Diagram, whole: int) -> None:
        self.size = diagram.count(whole)
        self._layout, self._diagram = layout, diagram
        nodes = [whole]
        level = diagram.height - 1
        self._before: list[Array] = []
        self._rows: list[Array] = []
        entries = 0
        for group, width in enumerate(layout.widths):
            entries += (len(nodes) + 1) << width
            if entries > MOST_ENTRIES:
                raise TooLarge(f"{MOST_ENTRIES:,} entries of tables")
            rows = np.arange(len(nodes) + 1).reshape(-1, 1)
            before = np.zeros((len(nodes) + 1, 1), np.int32)
            for _ in layout.groups[group]:
                heed()
                nodes, (below, smaller) = self._level(nodes, level)
                before = (before[:, :, None] + smaller[rows]).reshape(len(rows), -1)
                rows = below[rows].reshape(len(rows), -1)
                level -= 1
            after = layout.widths[group + 1] if group + 1 < len(layout.widths) else 0
            self._before.append(self._padded(before, width))
            self._rows.append(self._padded(rows << after, width))

    def _level(self, nodes: list[int], level: int) -> tuple[list[int], _Level]:
        """Return the nodes below those of a level, and the tables of the level."""
        children = self._diagram.children
        further = dict.fromkeys(one for node in nodes for one in children[node] if one)
        row = {0: 0, **{node: number for number, node in enumerate(further, 1)}}
        size = self._diagram.sizes[level]
        below = np.zeros((len(nodes) + 1, size), np.int32)
        counts = np.zeros((len(nodes) + 1, size), np.int32)
        for number, node in enumerate(nodes, 1):
            heed()
            below[number] = [row[one] for one in children[node]]
            counts[number] = [self._diagram.count(one) for one in children[node]]
        return list(further), (below, np.cumsum(counts, axis=1, dtype=np.int32) - counts)

    def _padded(self, table: Array, width: int) -> Array:
        found = np.zeros((len(table), 1 << width), np.int32)
        found[:, : table.shape[1]] = table
        return found.reshape(-1)

    def made_room(self, count: int) -> bool:
        """Return False: there is room for all."""
        return False

    def of(self, codes: Array) -> Array:
        """Return the number of each configuration, which must be one of the set."""
        field = self._layout.field(codes, 0)
        field = field + (1 << self._layout.widths[0])  # the row of the whole set
        found = self._before[0].take(field)
        rows = self._rows[0].take(field)
        for group in range(1, len(self._before)):
            at = rows + self._layout.field(codes, group)
            found += self._before[group].take(at)
            rows = self._rows[group].take(at)
        return found


def ranked(diagram: Diagram, whole: int) -> tuple[CodeLayout, RankNumbers]:
    """Return codes and numbers for a set, in groups that are as large as the tables allow.

    TooLarge if no groups are small enough.
    """
    by_level = [0] * diagram.height
    for one, level in enumerate(diagram.levels):
        by_level[one] = diagram.sizes[level]
    most = 4_096
    while True:
        layout = CodeLayout(by_level, diagram.levels, most)
        try:
            return layout, RankNumbers(layout, diagram, whole)
        except TooLarge:
            if most < 64:
                raise
            most //= 8
