"""Numbers configurations by themselves: each gets a cell of a table when it is first met."""

from __future__ import annotations

import numpy as np

from smsl_studio.graph.joint.codes import Array
from smsl_studio.graph.joint.products import TooLarge

FIRST_BITS, MOST_BITS = 16, 26
"""A table has from 2 to the power of 16 up to 2 to the power of 26 cells: then it takes 0.5 GB."""

_MIXED = 0x9E3779B97F4A7C15
"""An odd number that spreads codes over all cells (the golden ratio, in 64 bits)."""


class HashNumbers:
    """Numbers configurations by their cells. At most half of the cells are filled."""

    def __init__(self) -> None:
        self._begin(FIRST_BITS)

    def _begin(self, bits: int) -> None:
        self._bits = bits
        # Zeros take no memory before they are used. A cell has its code and one more.
        self._cells = np.zeros(1 << bits, np.int64)

    @property
    def size(self) -> int:
        """The number of cells."""
        return len(self._cells)

    def made_room(self, count: int) -> bool:
        """Have cells for ``count`` configurations. Return whether all must be numbered anew.

        TooLarge if they are too many.
        """
        bits = self._bits
        while 2 * count > 1 << bits:
            bits += 1
        if bits == self._bits:
            return False
        if bits > MOST_BITS:
            raise TooLarge(f"{1 << MOST_BITS - 1:,} configurations in arrays")
        self._begin(min(bits + 2, MOST_BITS))
        return True

    def of(self, codes: Array) -> Array:
        """Return the cell of each configuration."""
        wanted = codes.astype(np.int64) + 1
        mixed = wanted.astype(np.uint64) * np.uint64(_MIXED)
        cells = (mixed >> np.uint64(64 - self._bits)).astype(np.int64)
        left = np.arange(len(wanted))
        while len(left):
            at = cells.take(left)
            free = left.take((self._cells.take(at) == 0).nonzero()[0])
            self._cells[cells.take(free)] = wanted.take(free)
            (wrong,) = (self._cells.take(at) != wanted.take(left)).nonzero()
            left = left.take(wrong)
            cells[left] = (cells.take(left) + 1) & (len(self._cells) - 1)
        return cells
