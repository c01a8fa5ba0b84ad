"""Numbers configurations with a hash table. It is for sets that are not known before the search."""

from __future__ import annotations

import numpy as np

from smsl_studio.graph.joint.codes import Array
from smsl_studio.graph.joint.products import TooLarge

FIRST_BITS, MOST_BITS = 16, 26
"""The table begins with 2 to the power of ``FIRST_BITS`` cells, and grows to 2 to the power of
``MOST_BITS``. The largest table takes 0.5 GB."""

_MIXED = 0x9E3779B97F4A7C15
"""An odd number that spreads codes over all cells (the golden ratio, in 64 bits)."""


class HashNumbers:
    """Gives each configuration a cell of a hash table. The cell's place is its number.

    At most half of the cells are filled, so that a free cell is found fast.
    """

    def __init__(self) -> None:
        self._begin(FIRST_BITS)

    def _begin(self, bits: int) -> None:
        self._bits = bits
        # A filled cell has the code plus 1; a free cell has 0. The system gives memory only to
        # pages that have been written.
        self._cells = np.zeros(1 << bits, np.int64)

    @property
    def size(self) -> int:
        """The number of cells."""
        return len(self._cells)

    def made_room(self, count: int) -> bool:
        """Make the table large enough for ``count`` configurations in total.

        Return True if the table has grown: then all old numbers are invalid, and the caller must
        ask for them again. TooLarge if ``count`` needs a table above the limit.
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
        """Return the number of each configuration. A new configuration gets a free cell."""
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
