"""The marks in place of names that have no room, with the number of these names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.label_candidates import SHARES
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
        for edge in edges:
            if picture.target[edge] >= 0 and geometry.is_hidden(edge):
                a, b = int(picture.source[edge]), int(picture.target[edge])
                pairs[min(a, b), max(a, b)] = None
        anew = [pair for pair in pairs if pair not in self._known]
        own = [self._hidden_between(*pair) for pair in anew]
        for pair, names, at in zip(anew, own, self._places([one[0] for one in own]), strict=True):
            self._known[pair] = HiddenNames(names, at)
        return [self._known[pair] for pair in pairs]

    def _hidden_between(self, a: int, b: int) -> tuple[int, ...]:
        there, back = self._geometry.picture.between(a, b)
        both = dict.fromkeys((*there, *back))
        return tuple(edge for edge in both if self._geometry.is_hidden(edge))

    def _places(self, edges: Sequence[int]) -> list[Point]:
        """Return the place of the mark on each line: in its middle, or where it covers no node and
        no label.

        In a large picture not all labels have their places yet, so it is in the middle.
        """
        geometry, half = self._geometry, RADIUS * self._geometry.style.unit
        shapes = [geometry.shape(edge) for edge in edges]
        points = [[shape.at(shape.length * share) for share in SHARES] for shape in shapes]
        if not geometry.small or geometry.places is None or not points:
            return [own[0] for own in points]
        middles = np.array(points)
        rects = np.concatenate([middles - half, middles + half], axis=2)
        free = geometry.places.off_nodes(rects.reshape(-1, 4)).reshape(rects.shape[:2])
        untaken = geometry.places.is_untaken
        found = []
        for at, own in enumerate(points):
            shown = (k for k in np.nonzero(free[at])[0] if untaken(tuple(rects[at, k].tolist())))
            found.append(own[next(shown, 0)])
        return found


def hidden_names(geometry: Geometry, edges: Iterable[int]) -> list[HiddenNames]:
    """Return the marks for the pairs of states of these operations."""
    return HiddenMarks(geometry).of(edges)
