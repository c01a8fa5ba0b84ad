"""The marks in place of names that have no room, with the number of these names."""

from __future__ import annotations

from collections.abc import Iterable
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


def hidden_names(geometry: Geometry, edges: Iterable[int]) -> list[HiddenNames]:
    """Return the marks for the pairs of states of these operations. A mark counts all names between
    its states that are not shown, and stands on the line of the first.
    """
    picture, pairs = geometry.picture, dict[tuple[int, int], None]()
    for edge in edges:
        if picture.target[edge] >= 0 and geometry.is_hidden(edge):
            a, b = int(picture.source[edge]), int(picture.target[edge])
            pairs[min(a, b), max(a, b)] = None
    found = []
    for a, b in pairs:
        there, back = picture.between(a, b)
        own = [edge for edge in dict.fromkeys((*there, *back)) if geometry.is_hidden(edge)]
        found.append(HiddenNames(tuple(own), _place(geometry, own[0])))
    return found


def _place(geometry: Geometry, edge: int) -> Point:
    """Return the place of a mark on a line: in its middle, or where it covers no node and no label.

    In a large picture not all labels have their places yet, so it is in the middle.
    """
    shape, half = geometry.shape(edge), RADIUS * geometry.style.unit
    points = [shape.at(shape.length * share) for share in SHARES]
    if not geometry.small or geometry.places is None:
        return points[0]
    rects = np.array([(x - half, y - half, x + half, y + half) for x, y in points])
    free = geometry.places.off_nodes(rects).tolist()
    untaken = geometry.places.is_untaken
    shown = (at for at, rect in enumerate(rects.tolist()) if free[at] and untaken(rect))
    return points[next(shown, 0)]
