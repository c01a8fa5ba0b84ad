"""The marks in place of names that have no room, with the number of these names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.label_candidates import SHARES, points_along
from smsl_studio.picture.labels import Rect, meet
from smsl_studio.picture.shape import Floats, Point

RADIUS = 7.5
"""The radius of the mark (pixels of a mark)."""
RING = 3.5
"""The radius of a mark without room for its number (pixels of a mark)."""
_SIZES = RADIUS, RING, RING
MARK_SHARES = tuple(0.5 + side * step / 40 for step in range(17) for side in (1, -1)[: step + 1])
"""The shares of a line at which its mark may stand."""


class HiddenNames(NamedTuple):
    """The operations between two states whose names are not shown, and the middle of their mark."""

    edges: tuple[int, ...]
    at: Point
    radius: float = RADIUS
    """The radius of the mark (pixels of a mark); ``RING`` without room for its number, 0 without
    room for a ring."""

    @property
    def large(self) -> bool:
        """Whether there is room for the number."""
        return self.radius == RADIUS

    @property
    def words(self) -> str:
        """The text of a large mark."""
        return f"+{len(self.edges)}"


class HiddenMarks:
    """The marks of one geometry. Each is computed when it is first asked for.

    A line that is drawn anew needs a new object.
    """

    def __init__(self, geometry: Geometry) -> None:
        self._geometry = geometry
        self._known: dict[tuple[int, int], HiddenNames] = {}

    def of(self, edges: Iterable[int]) -> list[HiddenNames]:
        """Return the marks for the pairs of states of these operations. A mark counts all names
        between its states that are not shown, and stands on the line of the first.
        """
        pairs = self._pairs(edges)
        if any(pair not in self._known for pair in pairs):
            # The marks of a small picture make room for each other.
            small, every = self._geometry.small, range(len(self._geometry.picture.operations))
            anew = [p for p in (self._pairs(every) if small else pairs) if p not in self._known]
            own = [self._hidden_between(*pair) for pair in anew]
            for pair, names, at in zip(anew, own, self._places(own), strict=True):
                self._known[pair] = HiddenNames(names, *at)
        return [self._known[pair] for pair in pairs]

    def _pairs(self, edges: Iterable[int]) -> list[tuple[int, int]]:
        """Return the pairs of states of those of these operations that are not named."""
        picture, pairs = self._geometry.picture, dict[tuple[int, int], None]()
        for edge in self._geometry.hidden_among(edges):
            if picture.target[edge] >= 0:
                pairs[self._pair(edge)] = None
        return list(pairs)

    def _pair(self, edge: int) -> tuple[int, int]:
        """Return the states between which an operation leads, the lower number first."""
        a, b = int(self._geometry.picture.source[edge]), int(self._geometry.picture.target[edge])
        return min(a, b), max(a, b)

    def _hidden_between(self, a: int, b: int) -> tuple[int, ...]:
        there, back = self._geometry.picture.between(a, b)
        return tuple(self._geometry.hidden_among(dict.fromkeys((*there, *back))))

    def _places(self, marks: Sequence[tuple[int, ...]]) -> list[tuple[Point, float]]:
        """Return the place of each mark on one of its lines, and its radius.

        It covers no node, no label and no line between other states. Without room it is a ring,
        which may lie where lines cross.
        """
        geometry = self._geometry
        if not marks:
            return []
        if not geometry.small:
            return self._off_nodes([edges[0] for edges in marks])
        edges = [edge for own in marks for edge in own]
        points = points_along(list(map(geometry.shape, edges)), MARK_SHARES)
        wanted: list[list[Point]] = points.tolist()
        unit, places = geometry.style.unit, geometry.places
        around = [np.concatenate([points - r * unit, points + r * unit], axis=2) for r in _SIZES]
        free = [self._free(edges, rects, at < 2) for at, rects in enumerate(around)]
        found, taken, first = list[tuple[Point, float]](), list[Rect](), 0
        for own in marks:
            rows = range(first, first + len(own))
            first += len(own)
            spots = (
                (radius, row, rank, (left, top, right, bottom))
                for radius, rects, ok in zip(_SIZES, around, free, strict=True)
                for row in rows
                for rank in np.nonzero(ok[row])[0].tolist()
                for left, top, right, bottom in (rects[row, rank].tolist(),)
            )
            clear = (
                spot
                for spot in spots
                if places.is_untaken(spot[3]) and not any(meet(spot[3], r) for r in taken)
            )
            radius, row, rank, rect = next(clear, (0.0, rows[0], 0, None))
            if rect is not None:
                taken.append(rect)
            x, y = wanted[row][rank]
            found.append(((x, y), radius))
        return found

    def _off_nodes(self, edges: Sequence[int]) -> list[tuple[Point, float]]:
        """Return the place of the mark on each line of a large picture, and its radius.

        Not all labels have their places yet there, so it is in the middle, or where it covers no
        node. Half a mark behind a node would say nothing, so there is none where nodes leave no
        room.
        """
        geometry, half = self._geometry, RADIUS * self._geometry.style.unit
        shapes = list(map(geometry.shape, edges))
        found = [((x, y), 0.0) for ((x, y),) in points_along(shapes, SHARES[:1]).tolist()]
        for shares in (SHARES[:1], SHARES[1:]):
            left = [at for at, (_, radius) in enumerate(found) if not radius]
            if not left:
                break
            points = points_along([shapes[at] for at in left], shares)
            around = np.concatenate([points - half, points + half], axis=2)
            free = geometry.places.off_nodes(around.reshape(-1, 4)).reshape(points.shape[:2])
            for row in np.nonzero(free.any(axis=1))[0].tolist():
                x, y = points[row, free[row].argmax()].tolist()
                found[left[row]] = (x, y), RADIUS
        return found

    def _free(self, edges: Sequence[int], rects: Floats, alone: bool) -> NDArray[np.bool_]:
        """Return for each rectangle, (n, k, 4), whether it covers no node; ``alone`` says that it
        may cover no line between other states than those of its line, either.
        """
        places, picture = self._geometry.places, self._geometry.picture
        room = np.full(rects.shape[1], places.unit)
        found = places.off_nodes(rects.reshape(-1, 4)).reshape(rects.shape[:2])
        if alone:
            found &= places.lines.clear(edges, rects, room, picture.pair_numbers)
        return found


def hidden_names(geometry: Geometry, edges: Iterable[int]) -> list[HiddenNames]:
    """Return the marks for the pairs of states of these operations."""
    return HiddenMarks(geometry).of(edges)
