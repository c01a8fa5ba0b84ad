"""Labels: the place of each label on its line, so that it covers no node and no other label.

A label slides along its edge to a free place, or stands away from it with a leader. It is nearer to
its own line than to any other line, and covers none, because people take the word in the gap of an
arrow for its name. Without such a place it is hidden until the edge is hovered, selected or lit.
Pure geometry.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.edge_layout import LabelPlace
from smsl_studio.picture.line_pieces import LinePieces, Rect
from smsl_studio.picture.shape import EdgeShape, Floats, Point

__all__ = [
    "FOOT",
    "AsideRect",
    "LabelPlaces",
    "Rect",
    "by_hand",
    "centred",
    "leader",
    "meet",
    "outside",
    "rank_of",
]

_RECTS_AT_ONCE = 4_000
"""The number of places that are compared with all nodes at once. It limits the memory."""
FOOT = 2.0
"""The radius of the dot on its line where the leader of a label begins (pixels of a mark). It tells
to which of several lines the label belongs."""
FOOT_ROOM = 4.0
"""How far another line is away from such a dot (pixels of a mark)."""
_RANKS = {"loop": 0, "line": 1, "curve": 2, "bent": 2, "detour": 2, "stub": 3, "lane": 4}


class AsideRect(NamedTuple):
    """The rectangle of a label that stands away from its line, so a leader joins them."""

    left: float
    top: float
    right: float
    bottom: float


def meet(a: Rect, b: Rect) -> bool:
    """Return whether two rectangles overlap."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def rank_of(edge: int, shape: EdgeShape) -> tuple[int, float, int]:
    """Return the sort key of an edge. Labels with few possible places choose first."""
    return _RANKS[shape.way], round(shape.length), edge


class LabelPlaces:
    """The places that are taken, in a grid of cells. No label covers a node or another label.

    ``boxes`` has the nodes, an (n, 4) array of centres and half sizes.
    """

    def __init__(self, boxes: Floats, unit: float) -> None:
        self.unit = unit
        self.lines = LinePieces({})
        """All lines that a label may not cover, except its own."""
        self.loops: list[Rect] = []
        """The bounds of the loops that are drawn. Labels of further loops may not cover them."""
        self._cell = 40.0 * unit
        self._cells: dict[tuple[int, int], list[Rect]] = {}
        self._waiting: list[Rect] = []
        """The places that are taken and not in their cells yet. Many together are put there
        quicker.
        """
        margin = 2.0 * unit
        self._nodes = np.hstack(
            [boxes[:, :2] - boxes[:, 2:] - margin, boxes[:, :2] + boxes[:, 2:] + margin]
        )

    def take(self, rect: Rect, margin: float = 1.0) -> None:
        """Keep a rectangle free of labels from now on."""
        m = margin * self.unit
        self._waiting.append((rect[0] - m, rect[1] - m, rect[2] + m, rect[3] + m))

    def take_label(self, shape: EdgeShape, rect: Rect) -> None:
        """Keep the place of the label of a line free, and its leader if it has one."""
        self.take(rect)
        if isinstance(rect, AsideRect):
            for dot in self._dots(*leader(shape, rect)):
                self.take(dot)

    def may_lead(self, foot: Point, end: Point) -> bool:
        """Return whether a leader between these points meets no label."""
        return all(map(self.is_untaken, self._dots(foot, end)))

    def are_led(self, edge: int, shape: EdgeShape, rects: Floats) -> NDArray[np.bool_]:
        """Return for each label away from its line, (n, 4), whether its leader meets no node, and
        begins on its line alone.
        """
        if not len(rects):
            return np.ones(0, dtype=bool)
        ways, room, half = np.array(leaders(shape, rects)), FOOT_ROOM * self.unit, FOOT * self.unit
        feet, steps = ways[:, 0], ways[:, 1] - ways[:, 0]
        sizes = np.hypot(steps[:, 0], steps[:, 1])
        counts = np.maximum(np.ceil(sizes / (2.0 * half)).astype(int), 1)
        begins = np.cumsum(counts) - counts
        of = np.repeat(np.arange(len(rects)), counts)
        shares = (np.arange(len(of)) - begins[of]) / counts[of]
        spots = feet[of] + steps[of] * shares[:, None]
        off = self.off_nodes(np.hstack([spots - half, spots + half]))
        squares: list[Rect] = [centred((x, y), (2.0 * room, 2.0 * room)) for x, y in feet.tolist()]
        alone = np.array(self.lines.covered(edge, squares)) == 0
        found: NDArray[np.bool_] = np.logical_and.reduceat(off, begins) & alone
        return found

    def _dots(self, foot: Point, end: Point) -> list[Rect]:
        """Return small rectangles along a leader."""
        (ax, ay), (bx, by) = foot, end
        half = FOOT * self.unit
        count = max(1, math.ceil(math.hypot(bx - ax, by - ay) / (2.0 * half)))
        spots = ((ax + (bx - ax) * at / count, ay + (by - ay) * at / count) for at in range(count))
        return [(x - half, y - half, x + half, y + half) for x, y in spots]

    def is_free(self, rect: Rect) -> bool:
        """Return whether a rectangle covers no node and no taken place."""
        return self.is_untaken(rect) and bool(self.off_nodes(np.array([rect]))[0])

    def is_untaken(self, rect: Rect) -> bool:
        """Return whether a rectangle covers no place that is taken."""
        if self._waiting:
            self._settle()
        left, top, right, bottom = rect
        cell, cells = self._cell, self._cells
        for x in range(int(left // cell), int(right // cell) + 1):
            for y in range(int(top // cell), int(bottom // cell) + 1):
                for a, b, c, d in cells.get((x, y), ()):
                    if left < c and a < right and top < d and b < bottom:
                        return False
        return True

    def off_nodes(self, rects: Floats) -> NDArray[np.bool_]:
        """Return for each rectangle, (n, 4), whether it covers no node."""
        found = np.ones(len(rects), dtype=bool)
        if not len(rects):
            return found
        low, high = rects[:, :2].min(axis=0), rects[:, 2:].max(axis=0)
        near = self._nodes[((self._nodes[:, 2:] > low) & (self._nodes[:, :2] < high)).all(axis=1)]
        for first in range(0, len(rects) if len(near) else 0, _RECTS_AT_ONCE):
            some = slice(first, first + _RECTS_AT_ONCE)
            one = rects[some, :, None]
            covers = one[:, 0] < near[:, 2]
            covers &= one[:, 2] > near[:, 0]
            covers &= one[:, 1] < near[:, 3]
            covers &= one[:, 3] > near[:, 1]
            found[some] = ~covers.any(axis=1)
        return found

    def _settle(self) -> None:
        """Put all places that wait into their cells."""
        waiting, self._waiting = self._waiting, []
        spans = np.floor_divide(np.array(waiting), self._cell).astype(int).tolist()
        for rect, (left, top, right, bottom) in zip(waiting, spans, strict=True):
            for x in range(left, right + 1):
                for y in range(top, bottom + 1):
                    self._cells.setdefault((x, y), []).append(rect)


def leader(shape: EdgeShape, rect: Rect) -> tuple[Point, Point]:
    """Return the points of a line and of the border of its label that are near each other."""
    return leaders(shape, np.array([rect]))[0]


def leaders(shape: EdgeShape, rects: Floats) -> list[tuple[Point, Point]]:
    """Return these two points for many places, (n, 4), of the label of a line."""
    found = []
    along = shape.all_along((rects[:, :2] + rects[:, 2:]) / 2)
    for length, (left, top, right, bottom) in zip(along, rects.tolist(), strict=True):
        x, y = foot = shape.at(length)
        found.append((foot, (min(max(x, left), right), min(max(y, top), bottom))))
    return found


def by_hand(shape: EdgeShape, at: LabelPlace, size: tuple[float, float]) -> Rect:
    """Return the rectangle of a label that somebody has moved. Away from its line it has a
    leader."""
    share, dx, dy = at
    x, y = shape.at(shape.length * share)
    rect = centred((x + dx, y + dy), size)
    foot, end = leader(shape, rect)
    return AsideRect(*rect) if math.dist(foot, end) > size[1] / 2 else rect


def outside(
    shape: EdgeShape, along: float, size: tuple[float, float], gap: float, side: int = 1
) -> Rect:
    """Return a rectangle beside a line, with a gap, on its outer side (``side`` 1) or inner side
    (-1).
    """
    x, y = shape.at(along)
    dx, dy = shape.direction(along)
    nx, ny = -dy * shape.out * side, dx * shape.out * side
    reach = abs(nx) * size[0] / 2 + abs(ny) * size[1] / 2 + gap
    return centred((x + nx * reach, y + ny * reach), size)


def centred(point: Point, size: tuple[float, float]) -> Rect:
    """Return the rectangle of a size around a point."""
    x, y = point
    w, h = size[0] / 2, size[1] / 2
    return x - w, y - h, x + w, y + h
