"""Labels: the place of each label on its line, so that it covers no node and no other label.

A label slides along its edge to a free place, or stands away from it with a leader. It is nearer to
its own line than to any other line, and covers none, because people take the word in the gap of an
arrow for its name. Without such a place it is hidden until the edge is hovered, selected or lit.
Pure geometry.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.edge_layout import LabelPlace
from smsl_studio.picture.label_candidates import ON_ROOM, aside, candidates
from smsl_studio.picture.line_pieces import LinePieces, Rect
from smsl_studio.picture.shape import EdgeShape, Floats, Point

__all__ = [
    "FOOT",
    "AsideRect",
    "LabelChoice",
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
_RECTS_AT_A_LOOK = 8
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
        self._cell = 96.0 * unit
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
            for dot in self._dots(shape, rect):
                self.take(dot)

    def is_led(self, edge: int, shape: EdgeShape, rect: Rect) -> bool:
        """Return whether the leader of a label away from its line meets no label and no node, and
        begins on its line alone.
        """
        foot, room = leader(shape, rect)[0], FOOT_ROOM * self.unit
        if self.lines.covered(edge, [centred(foot, (2.0 * room, 2.0 * room))])[0]:
            return False
        dots = self._dots(shape, rect)
        return all(map(self.is_untaken, dots)) and bool(self.off_nodes(np.array(dots)).all())

    def _dots(self, shape: EdgeShape, rect: Rect) -> list[Rect]:
        """Return small rectangles along the leader of a label."""
        (ax, ay), (bx, by) = leader(shape, rect)
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
        for cell in self._over(rect):
            if any(meet(rect, other) for other in self._cells.get(cell, ())):
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

    def _over(self, rect: Rect) -> list[tuple[int, int]]:
        left, top, right, bottom = (int(v // self._cell) for v in rect)
        return [(x, y) for x in range(left, right + 1) for y in range(top, bottom + 1)]


MOST_BESIDE = 8
"""Of more lines between two states no label can be told apart at a glance. Then they are not
compared, because that takes the square of their number."""
Beside = Callable[[int], Sequence[EdgeShape]]
"""Returns the other lines between the two states of an edge."""


def tells_apart(rect: Rect, own: EdgeShape, beside: Sequence[EdgeShape]) -> bool:
    """Return whether a label at this place belongs to its own line at a glance: it covers no line
    ``beside``, and its middle is nearer to its own.
    """
    if any(LinePieces({0: line}).covered(-1, [rect])[0] for line in beside):
        return False
    x, y = (rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2
    away = own.distance(x, y)
    return all(line.distance(x, y) > away for line in beside)


class LabelChoice:
    """The choice of a place for each label of some lines.

    ``shapes`` has all lines whose label may be asked for, ``sizes`` the sizes of the labels.
    """

    beside: Beside = staticmethod(lambda _: ())
    """The lines from which a label must be told apart in a large picture."""

    def __init__(
        self,
        shapes: Mapping[int, EdgeShape],
        sizes: Sequence[tuple[float, float]],
        places: LabelPlaces,
        compact: bool,
        away: bool = False,
    ) -> None:
        """``away`` says that labels may stand away from their lines."""
        self._places, self._aside = places, away
        self._beside: dict[int, list[AsideRect]] = {}
        self._lines = dict(zip(shapes, zip(shapes.values(), sizes, strict=True), strict=True))
        self._found: dict[int, Floats] = {}
        for some in candidates(shapes, sizes, places.unit, compact):
            free = some.fits & places.lines.clear(some.edges, some.rects, some.rooms)
            free[free] = places.off_nodes(some.rects[free])
            for edge, rects, ok in zip(some.edges, some.rects, free, strict=True):
                self._found[edge] = rects[ok]
        if away:
            self._look_aside([edge for edge, own in self._found.items() if not len(own)])

    def knows(self, edge: int) -> bool:
        """Return whether the label of an edge may be asked for."""
        return edge in self._found

    def take(self, edge: int) -> Rect | None:
        """Take and return the best free place of one label, or None if there is none."""
        found = self._best(edge, _each(self._found[edge]))
        if found is None and self._aside:
            if edge not in self._beside:
                self._look_aside([edge])
            places, shape = self._places, self._lines[edge][0]
            led = (rect for rect in self._beside[edge] if places.is_led(edge, shape, rect))
            found = self._best(edge, led)
        if found is not None:
            self._places.take_label(self._lines[edge][0], found)
        return found

    def _best(self, edge: int, rects: Iterable[Rect]) -> Rect | None:
        """Return the first free place that tells the line of the label from those beside it, or the
        first free one.
        """
        first: Rect | None = None
        beside = self.beside(edge)
        if len(beside) > MOST_BESIDE:
            beside = ()
        for rect in filter(self._places.is_untaken, rects):
            if not beside or tells_apart(rect, self._lines[edge][0], beside):
                return rect
            first = first or rect
        return first

    def _look_aside(self, edges: Sequence[int]) -> None:
        """Find the places of some labels away from their lines that cover no node, the nearest
        first.
        """
        if not edges:
            return
        lines = [self._lines[edge] for edge in edges]
        places = self._places
        shapes, sizes = [shape for shape, _ in lines], [size for _, size in lines]
        rects, feet, ends = aside(shapes, sizes, places.unit)
        free = places.off_nodes(rects.reshape(-1, 4)).reshape(rects.shape[:2])
        room = np.full(rects.shape[1], ON_ROOM * places.unit)
        free &= places.lines.clear(edges, rects, room)
        alone = places.lines.uncrossed(edges, feet, ends)
        # A line between two others has its label beyond them, if need be.
        for edge, own, ok, better in zip(edges, rects, free, alone, strict=True):
            best = [*own[ok & better].tolist(), *own[ok & ~better].tolist()]
            self._beside[edge] = [AsideRect(*rect) for rect in best]


def _each(rects: Floats) -> Iterator[Rect]:
    """Yield the rectangles of an array, (n, 4). Mostly the first ones are enough, so few are made
    at once.
    """
    for first in range(0, len(rects), _RECTS_AT_A_LOOK):
        some = rects[first : first + _RECTS_AT_A_LOOK].tolist()
        yield from ((left, top, right, bottom) for left, top, right, bottom in some)


def leader(shape: EdgeShape, rect: Rect) -> tuple[Point, Point]:
    """Return the points of a line and of the border of its label that are near each other."""
    left, top, right, bottom = rect
    foot = shape.at(shape.along((left + right) / 2, (top + bottom) / 2))
    return foot, (min(max(foot[0], left), right), min(max(foot[1], top), bottom))


def by_hand(shape: EdgeShape, at: LabelPlace, size: tuple[float, float]) -> Rect:
    """Return the rectangle of a label that somebody has moved."""
    share, dx, dy = at
    x, y = shape.at(shape.length * share)
    return centred((x + dx, y + dy), size)


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
