"""Numbers the configurations of a set that a diagram holds: 0, 1, 2 and so on, without a gap.

So a search needs only one byte for each configuration of the set to mark it as seen. The number of
a configuration is the count of those that come before it. The tables give this count group by group
(see ``CodeLayout``). Each row of a table is for one node of the diagram. Each column is for one
value of the group's field.
"""

from __future__ import annotations

import numpy as np

from smsl_studio.graph.joint.codes import Array, CodeLayout
from smsl_studio.graph.joint.diagram import Diagram
from smsl_studio.graph.joint.products import TooLarge
from smsl_studio.stop import heed

MOST_ENTRIES = 8_000_000
"""The largest number of entries of all tables together (64 MB)."""

_Level = tuple[Array, Array]
"""Two tables for one level: the row of the node below, and how many configurations come before."""


class RankNumbers:
    """Numbers the configurations of the set ``whole``. Row 0 of each table is for the empty set.

    TooLarge if the tables would have more than ``MOST_ENTRIES`` entries.
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
        """Return the nodes one level below ``nodes``, and the two tables of this level."""
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
        """Return False: every configuration of the set already has a number."""
        return False

    def of(self, codes: Array) -> Array:
        """Return the number of each configuration. All must belong to the set."""
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
    """Return a layout of codes and the numbers for a set.

    The groups are as large as the tables allow, because fewer groups are faster. TooLarge if even
    small groups need too many entries.
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
