"""The places of a drawing that are taken, and the nearest free place to a point."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count

Point = tuple[float, float]
NODE_GAP = (150.0, 90.0)
"""The least distance (pixels) between two nodes, across and down. A full node is 108 by 54."""
TRIED = 200_000
"""The number of places that are tried for all new states together. The other states stand in rows
below.
"""


class TakenPlaces:
    """The places that are taken, in cells, so that a free place near a point is found quickly.

    ``gap`` is the least distance of two places, across and down, and ``step`` the distance of the
    places that are tried (pixels), by default half the gap.
    """

    def __init__(
        self, points: Iterable[Point], gap: Point = NODE_GAP, step: Point | None = None
    ) -> None:
        self._cells: dict[tuple[int, int], list[Point]] = {}
        self._gap, self._step = gap, step or (gap[0] / 2, gap[1] / 2)
        self._left = self._right = self._bottom = 0.0
        self._tries = TRIED
        self._rows: Iterator[Point] | None = None
        for point in points:
            self.take(point)

    @property
    def below(self) -> Point:
        """The start of a row below all places."""
        return self._left, self._bottom + 172.0

    def free(self, wanted: Point) -> Point:
        """Return the nearest free place on rings around ``wanted``, and take it.

        If too many places were tried, the result stands in rows below everything.
        """
        ring = 0
        while self._tries > 0:
            cells = _ring(ring)
            self._tries -= len(cells)
            for x, y in cells:
                point = (wanted[0] + x * self._step[0], wanted[1] + y * self._step[1])
                if self.is_free(point):
                    self.take(point)
                    return point
            ring += 1
        self._rows = self._rows or _rows(self.below, self._right, self._gap)
        return next(self._rows)

    def take(self, point: Point) -> None:
        """Note that a place is taken."""
        x, y = point
        if not self._cells:
            self._left, self._right, self._bottom = x, x, y
        self._left, self._right = min(self._left, x), max(self._right, x)
        self._bottom = max(self._bottom, y)
        self._cells.setdefault(self._cell(point), []).append(point)

    def is_free(self, point: Point) -> bool:
        """Return whether no taken place is nearer than the gap, across and down."""
        (column, row), (wide, high) = self._cell(point), self._gap
        return not any(
            abs(point[0] - x) < wide and abs(point[1] - y) < high
            for i in (column - 1, column, column + 1)
            for j in (row - 1, row, row + 1)
            for x, y in self._cells.get((i, j), ())
        )

    def _cell(self, point: Point) -> tuple[int, int]:
        return int(point[0] // self._gap[0]), int(point[1] // self._gap[1])


def _rows(start: Point, right: float, gap: Point) -> Iterator[Point]:
    """Yield places side by side, in rows one below the other."""
    wide = max(1, int((right - start[0]) // gap[0]) + 1)
    for at in count():
        yield start[0] + at % wide * gap[0], start[1] + at // wide * gap[1]


def _ring(radius: int) -> list[tuple[int, int]]:
    """Return the half cells of a ring at this distance, nearest first, right before left and below
    before above.
    """
    if radius == 0:
        return [(0, 0)]
    ends = (-radius, radius)
    cells = [(x, y) for x in range(-radius, radius + 1) for y in ends]
    cells += [(x, y) for x in ends for y in range(1 - radius, radius)]
    return sorted(cells, key=lambda cell: (abs(cell[0]) + abs(cell[1]), -cell[0], -cell[1]))
