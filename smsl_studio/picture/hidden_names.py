"""The marks in place of names that have no room, with the number of these names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.label_candidates import SHARES, points_along
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.shape import Point

RADIUS = 7.5
"""The radius of the mark (pixels of a mark)."""


class HiddenNames(NamedTuple):
    """The operations between two states whose names are not shown, and the middle of their mark."""

    edges: tuple[int, ...]
    at: Point

    @property
    def words(self) -> str:
        """The text of the mark."""
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
        geometry, picture = self._geometry, self._geometry.picture
        pairs = dict[tuple[int, int], None]()
        for edge in geometry.hidden_among(edges):
            if picture.target[edge] >= 0:
                a, b = int(picture.source[edge]), int(picture.target[edge])
                pairs[min(a, b), max(a, b)] = None
        anew = [pair for pair in pairs if pair not in self._known]
        own = [self._hidden_between(*pair) for pair in anew]
        for pair, names, at in zip(anew, own, self._places([one[0] for one in own]), strict=True):
            self._known[pair] = HiddenNames(names, at)
        return [self._known[pair] for pair in pairs]

    def _hidden_between(self, a: int, b: int) -> tuple[int, ...]:
        there, back = self._geometry.picture.between(a, b)
        return tuple(self._geometry.hidden_among(dict.fromkeys((*there, *back))))

    def _places(self, edges: Sequence[int]) -> list[Point]:
        """Return the place of the mark on each line: in its middle, or where it covers no node and
        no label.

        In a large picture not all labels have their places yet, so it is in the middle.
        """
        geometry, half = self._geometry, RADIUS * self._geometry.style.unit
        if not edges:
            return []
        points = points_along(list(map(geometry.shape, edges)), SHARES)
        wanted: list[list[Point]] = points.tolist()
        if not geometry.small:
            return [(own[0][0], own[0][1]) for own in wanted]
        places, rects = geometry.places, np.concatenate([points - half, points + half], axis=2)
        free = places.off_nodes(rects.reshape(-1, 4)).reshape(points.shape[:2])
        around: list[list[Rect]] = rects.tolist()
        found = []
        for at, own in enumerate(wanted):
            shown = (rank for rank, rect in enumerate(around[at])
                     if free[at, rank] and places.is_untaken(rect))  # fmt: skip
            x, y = own[next(shown, 0)]
            found.append((x, y))
        return found


def hidden_names(geometry: Geometry, edges: Iterable[int]) -> list[HiddenNames]:
    """Return the marks for the pairs of states of these operations."""
    return HiddenMarks(geometry).of(edges)
