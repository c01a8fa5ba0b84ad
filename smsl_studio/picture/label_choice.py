"""LabelChoice: where each label of some lines stands, the best free place first. Pure geometry.

Mostly one of the first places is free. So the others are only worked out where they are needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.label_candidates import (
    ASIDE_GAPS,
    ASIDE_SHARES,
    ON_ROOM,
    aside,
    candidates,
)
from smsl_studio.picture.labels import FOOT_ROOM, AsideRect, LabelPlaces, leader
from smsl_studio.picture.line_pieces import LinePieces, Rect
from smsl_studio.picture.shape import EdgeShape, Floats, Point

_RECTS_AT_A_LOOK = 8
_STAGES = ASIDE_GAPS[:3], ASIDE_GAPS[3:]
"""The distances at which places away from a line are looked for together."""
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


class _Away(NamedTuple):
    """A place away from its line, both ends of its leader, and whether it crosses a line."""

    rect: AsideRect
    foot: Point
    end: Point
    across: bool


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
        waits: Callable[[int], bool] = lambda _: False,
    ) -> None:
        """``away`` says that labels may stand away from their lines. ``waits`` tells whether an
        edge has exactly one other line between its two states, whose label has no place yet.
        """
        self._waits = waits
        self._places, self._stages = places, len(_STAGES) if away else 0
        self._away: list[dict[int, list[_Away]]] = [{} for _ in _STAGES]
        self._lines = dict(zip(shapes, zip(shapes.values(), sizes, strict=True), strict=True))
        self._found: dict[int, Floats] = {}
        self._later: dict[int, tuple[Floats, Floats]] = {}
        """Further places that cover no node, and how far other lines must be away."""
        for some in candidates(shapes, sizes, places.unit, compact):
            free = some.fits.copy()
            free[free] = places.off_nodes(some.rects[free])
            first, rest = slice(0, _RECTS_AT_A_LOOK), slice(_RECTS_AT_A_LOOK, None)
            lines, edges = places.lines, some.edges
            free[:, first] &= lines.clear(edges, some.rects[:, first], some.rooms[first])
            late = ~free[:, first].any(axis=1) & free.any(axis=1)
            none: list[int] = np.nonzero(late)[0].tolist()
            own = [edges[row] for row in none]
            free[none, rest] &= lines.clear(own, some.rects[none, rest], some.rooms[rest])
            all_known = set(none)
            for row, edge in enumerate(edges):
                known = free.shape[1] if row in all_known else _RECTS_AT_A_LOOK
                self._found[edge] = some.rects[row, :known][free[row, :known]]
                if free[row, known:].any():
                    further = known + np.nonzero(free[row, known:])[0]
                    self._later[edge] = some.rects[row, further], some.rooms[further]
        anew = [edge for edge, own in self._found.items() if not len(own)]
        for stage in range(self._stages):
            self._look_away(anew, stage)
            anew = [edge for edge in anew if not self._away[stage][edge]]

    def knows(self, edge: int) -> bool:
        """Return whether the label of an edge may be asked for."""
        return edge in self._found

    def take(self, edge: int) -> Rect | None:
        """Take and return the best free place of one label, or None if there is none."""
        found = self._best(edge, self._on_line(edge))
        shape = self._lines[edge][0]
        for stage in range(self._stages):
            if found is None:
                found = self._best(edge, self._led(edge, stage))
        if found is not None:
            self._places.take_label(shape, found)
        return found

    def _on_line(self, edge: int) -> Iterator[Rect]:
        """Yield the places of a label on its line and beside it that cover no node and are at no
        other line, the best first.
        """
        yield from _each(self._found[edge])
        if edge in self._later:
            rects, rooms = self._later.pop(edge)
            clear = self._places.lines.clear([edge], rects[None], rooms)[0]
            # The next question finds all of them.
            self._found[edge] = np.concatenate([self._found[edge], rects[clear]])
            yield from _each(rects[clear])

    def _led(self, edge: int, stage: int) -> Iterator[Rect]:
        """Yield the places of a label away from its line whose leader meets no label."""
        if edge not in self._away[stage]:
            self._look_away([edge], stage)
        places, shape = self._places, self._lines[edge][0]
        waits = self._waits(edge)
        for rect, foot, end, across in self._away[stage][edge]:
            # Beyond the other one of two lines stands the name of that one.
            if across and waits:
                continue
            # The leader that is drawn can begin a little beside the foot that was looked for.
            free = places.is_untaken(rect) and places.may_lead(foot, end)
            if free and places.may_lead(*leader(shape, rect)):
                yield rect

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

    def _look_away(self, edges: Sequence[int], stage: int) -> None:
        """Find the places of some labels away from their lines that cover no node and no line, to
        which a leader can lead, the nearest first. Those whose leader crosses another line come
        last.
        """
        self._away[stage].update((edge, []) for edge in edges)
        if not edges:
            return
        places, lines = self._places, [self._lines[edge] for edge in edges]
        shapes, sizes = [shape for shape, _ in lines], [size for _, size in lines]
        rects, feet, ends = aside(shapes, sizes, places.unit, _STAGES[stage])
        free = self._alone(edges, feet, len(_STAGES[stage]))
        free[free] = places.off_nodes(rects[free])
        some: list[int] = np.nonzero(free.any(axis=1))[0].tolist()
        if not some:
            return
        own = [edges[row] for row in some]
        free, rects, feet, ends = free[some], rects[some], feet[some], ends[some]
        free &= places.lines.clear(own, rects, np.full(rects.shape[1], ON_ROOM * places.unit))
        alone = places.lines.uncrossed(own, feet, ends)
        # A line between two others has its label beyond them, if need be.
        for row, edge in enumerate(own):
            best = np.concatenate(
                [np.nonzero(free[row] & alone[row])[0], np.nonzero(free[row] & ~alone[row])[0]]
            )
            best = best[places.are_led(edge, self._lines[edge][0], rects[row, best])]
            each = (rects, feet, ends, alone)
            found = zip(*(of[row, best].tolist() for of in each), strict=True)
            self._away[stage][edge] = [
                _Away(AsideRect(*rect), (ax, ay), (bx, by), not clear)
                for rect, (ax, ay), (bx, by), clear in found
            ]

    def _alone(self, edges: Sequence[int], feet: Floats, gaps: int) -> NDArray[np.bool_]:
        """Return for each leader, (n, k), whether no other line is near its beginning."""
        spots = feet.reshape(len(edges), gaps, len(ASIDE_SHARES), 2, 2)[:, 0, :, 0]
        room = np.full(len(ASIDE_SHARES), FOOT_ROOM * self._places.unit)
        alone = self._places.lines.clear(edges, np.concatenate([spots, spots], axis=2), room)
        return np.tile(np.repeat(alone, 2, axis=1), (1, gaps))


def _each(rects: Floats) -> Iterator[Rect]:
    """Yield the rectangles of an array, (n, 4). Mostly the first ones are enough, so few are made
    at once.
    """
    for first in range(0, len(rects), _RECTS_AT_A_LOOK):
        some = rects[first : first + _RECTS_AT_A_LOOK].tolist()
        yield from ((left, top, right, bottom) for left, top, right, bottom in some)
