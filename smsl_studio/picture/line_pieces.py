"""LinePieces: the straight pieces of many lines, to see which of them a rectangle covers."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.shape import EdgeShape, Floats, Point

Rect = tuple[float, float, float, float]
"""Left, top, right, bottom."""
_PAIRS_AT_ONCE = 400_000
"""The number of rectangles and pieces that are compared at once. It limits the memory."""


class LinePieces:
    """The straight pieces of all lines in one array, to count the lines that a label covers."""

    def __init__(self, shapes: Mapping[int, EdgeShape]) -> None:
        self._shapes = dict(shapes)
        pieces = [shape.pieces for shape in shapes.values()]
        found = np.concatenate(pieces) if pieces else np.zeros((0, 4))
        self._owners = np.repeat(np.array(list(shapes), dtype=int), [len(p) for p in pieces])
        self._start, end = found[:, :2], found[:, 2:]
        step = end - self._start
        self._step = np.where(np.abs(step) < 1e-9, 1e-9, step)
        self._low, self._high = np.minimum(self._start, end), np.maximum(self._start, end)

    def covered(self, edge: int, rects: Sequence[Rect]) -> list[int]:
        """Return for each rectangle how many pieces of other lines than ``edge`` it covers."""
        if not len(self._owners):
            return [0] * len(rects)
        left, top, right, bottom = zip(*rects, strict=True)
        near = self._near((min(left), min(top)), (max(right), max(bottom)))
        near = near[self._owners[near] != edge]
        if not len(near):
            return [0] * len(rects)
        box = np.array(rects)[:, None]
        counts: list[int] = self._covers(box, near[None]).sum(axis=1).tolist()
        return counts

    def but(self, edges: Collection[int], shapes: Mapping[int, EdgeShape]) -> LinePieces:
        """Return the pieces without these lines and with some others."""
        kept = {edge: shape for edge, shape in self._shapes.items() if edge not in edges}
        return LinePieces(kept | dict(shapes))

    def clear(
        self,
        edges: Sequence[int],
        rects: Floats,
        room: Floats,
        groups: NDArray[np.integer] | None = None,
    ) -> NDArray[np.bool_]:
        """Return for each rectangle, (n, k, 4), whether other lines keep away from it, (n, k).

        Row i has places of the label of line ``edges[i]``, which does not count as another line.
        With ``groups``, the number of the group of each line, no line of the same group counts.
        ``room`` is how far other lines must be away, (k,) (scene units).
        """
        own, owners = np.array(edges), self._owners
        if groups is not None:
            own, owners = groups[own], groups[owners]
        wide = rects + np.array([-1.0, -1.0, 1.0, 1.0]) * room[:, None]
        found = np.ones(rects.shape[:2], dtype=bool)
        low, high = wide[:, :, :2].min(axis=1), wide[:, :, 2:].max(axis=1)
        rows = max(1, _PAIRS_AT_ONCE // max(len(self._owners), 1))
        for first in range(0, len(rects), rows):
            some = slice(first, first + rows)
            near = owners != own[some, None]
            for axis in (0, 1):
                near &= self._high[:, axis] > low[some, axis, None]
                near &= self._low[:, axis] < high[some, axis, None]
            row, piece = near.nonzero()
            if len(row):
                hits = self._covers(wide[row + first], piece[:, None])
                begins = np.nonzero(np.diff(row, prepend=-1))[0]
                found[row[begins] + first] = ~np.logical_or.reduceat(hits, begins)
        return found

    def uncrossed(self, edges: Sequence[int], starts: Floats, ends: Floats) -> NDArray[np.bool_]:
        """Return for each straight way, from (n, k, 2) to (n, k, 2), whether it crosses no line.

        Row i has ways from line ``edges[i]``, which does not count.
        """
        found = np.ones(starts.shape[:2], dtype=bool)
        both = np.concatenate([starts, ends], axis=1)
        low, high = both.min(axis=1), both.max(axis=1)
        for row, edge in enumerate(edges):
            near = self._near(low[row].tolist(), high[row].tolist())
            near = near[self._owners[near] != edge]
            if len(near):
                a, step = starts[row][:, None], (ends[row] - starts[row])[:, None]
                b, other = self._start[near][None], self._step[near][None]
                gap, area = b - a, _cross(step, other)
                area = np.where(np.abs(area) < 1e-9, np.inf, area)
                t, u = _cross(gap, other) / area, _cross(gap, step) / area
                hits = (t >= 0.0) & (t <= 1.0) & (u >= 0.0) & (u <= 1.0) & np.isfinite(area)
                found[row] = ~hits.any(axis=1)
        return found

    def _near(self, low: Point, high: Point) -> NDArray[np.intp]:
        """Return the pieces of lines whose bounds overlap a rectangle."""
        near = self._high[:, 0] > low[0]
        near &= self._low[:, 0] < high[0]
        near &= self._high[:, 1] > low[1]
        near &= self._low[:, 1] < high[1]
        return np.nonzero(near)[0]

    def _covers(self, box: Floats, piece: NDArray[np.intp]) -> NDArray[np.bool_]:
        start, step = self._start[piece], self._step[piece]
        t1, t2 = (box[..., :2] - start) / step, (box[..., 2:] - start) / step
        enter = np.minimum(t1, t2).max(axis=-1)
        leave = np.maximum(t1, t2).min(axis=-1)
        hits: NDArray[np.bool_] = (enter < leave) & (leave > 0.0) & (enter < 1.0)
        return hits


def _cross(a: Floats, b: Floats) -> Floats:
    found: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return found
