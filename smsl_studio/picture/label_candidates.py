"""The possible places of labels, the best one first. Pure geometry.

The places of many labels are computed at once. The result is the same as for one label at a time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.shape import EdgeShape, Floats

Size = tuple[float, float]
SHARES = (0.5, 0.43, 0.57, 0.36, 0.64, 0.29, 0.71, 0.22, 0.78)
EARLY_SHARES = (0.4, 0.34, 0.46, 0.28, 0.52, 0.58, 0.22, 0.64, 0.7)
"""In a compact picture opposite edges lie close together. Their labels stand near the starts of
their edges, so they do not meet.
"""
LANE_SHARES = (0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.2, 0.8)
BESIDE_GAP = 6.0
FARTHEST = 40.0
ASIDE_GAPS = 9.0, 14.0, 20.0, 26.0, 33.0, FARTHEST
ASIDE_SHARES = 0.5, 0.36, 0.64, 0.22, 0.78, 0.43, 0.57, 0.29, 0.71, 0.14, 0.86
"""The distances (pixels of a mark) from its line at which a label without a place on it is shown,
and the shares of the line where it is shown.
"""
ON_ROOM, OFF_ROOM = 1.0, 6.0
"""How far other lines are away from a label on its line, and from one beside it (pixels of a mark).
The latter is so far from its own line at most."""
_ON, _BESIDE, _OUTSIDE, _MIDDLE = range(4)
_LEADING = ("line", "curve", "bent", "detour")
"""The kinds of lines that lead from one node to another, except lanes."""


class _Pattern(NamedTuple):
    """The possible places on one kind of line: their costs, their kinds, and their distances from
    the start as shares of the length, each (k,).
    """

    costs: Floats
    kinds: NDArray[np.intp]
    shares: Floats


@cache
def _pattern(way: str, beside: bool, compact: bool) -> _Pattern:
    found: list[tuple[float, int, float]] = []
    shares = LANE_SHARES if way == "lane" else EARLY_SHARES if compact else SHARES
    for order, share in enumerate(shares):
        cost = order * 0.12
        if beside:
            found.append((cost, _BESIDE, share))
        found.append((cost + (1.5 if beside else 0.0), _ON, share))
        if way in _LEADING:
            found.append((cost + 2.2, _OUTSIDE, share))
    if way in _LEADING:
        # This is for a label that hardly fits: the middle between the start and the arrowhead.
        found.append((0.3, _MIDDLE, 0.5))
    found.sort(key=lambda candidate: candidate[0])
    costs, kinds, parts = zip(*found, strict=True)
    return _Pattern(np.array(costs), np.array(kinds), np.array(parts))


class LabelCandidates(NamedTuple):
    """The possible places of the labels of n edges, k for each. The place of the lowest cost is the
    first.

    ``costs`` is (k,) and ``rects`` is (n, k, 4). ``fits``, (n, k), tells whether enough of the
    line can be seen beside the label. ``rooms``, (k,), is how far other lines must be away.
    """

    edges: Sequence[int]
    costs: Floats
    rects: Floats
    fits: NDArray[np.bool_]
    rooms: Floats


def candidates(
    shapes: Mapping[int, EdgeShape], sizes: Sequence[Size], unit: float, compact: bool
) -> list[LabelCandidates]:
    """Return the possible places of the labels of some edges. Lines of one kind are in one item.

    ``sizes`` has the sizes of the labels, in the order of ``shapes``.
    """
    alike: dict[tuple[str, bool], list[tuple[int, Size]]] = {}
    for (edge, shape), size in zip(shapes.items(), sizes, strict=True):
        way = shape.way if shape.way in (*_LEADING, "lane") else ""
        alike.setdefault((way, bool(shape.side)), []).append((edge, size))
    found = []
    for (way, beside), group in alike.items():
        pattern = _pattern(way, beside, compact)
        lines = _LineArrays([shapes[edge] for edge, _ in group])
        wide = np.array([size for _, size in group], dtype=np.float64)
        rects, fits = _places(lines, wide, pattern, unit, way == "lane")
        off = (pattern.kinds == _OUTSIDE) | (pattern.kinds == _BESIDE)
        rooms = np.where(off, OFF_ROOM, ON_ROOM) * unit
        edges = [edge for edge, _ in group]
        found.append(LabelCandidates(edges, pattern.costs, rects, fits, rooms))
    return found


def aside(
    shapes: Sequence[EdgeShape],
    sizes: Sequence[Size],
    unit: float,
    distances: Sequence[float] = ASIDE_GAPS,
) -> tuple[Floats, Floats, Floats]:
    """Return the places of some labels at distances from their lines, (n, k, 4), the nearest first,
    and both ends of their leaders, (n, k, 2): on the line and at the label.

    They are in order of distance, then of ``ASIDE_SHARES``, then of side.
    """
    lines, half = _LineArrays(shapes), np.array(sizes)[:, None, :] / 2
    along = lines.length * np.array(ASIDE_SHARES)
    feet, across = lines.at(along), lines.direction(along)[:, :, ::-1] * (-1.0, 1.0)
    gaps = np.array(distances)[:, None] * unit
    reach = (np.abs(across) * half).sum(axis=2)[:, None] + gaps
    off = (across[:, None] * reach[..., None])[:, :, :, None] * np.array([[1.0], [-1.0]])
    centres = (feet[:, None, :, None] + off).reshape(len(shapes), -1, 2)
    starts = np.broadcast_to(feet[:, None, :, None], off.shape).reshape(centres.shape)
    ends = np.clip(starts, centres - half, centres + half)
    return np.concatenate([centres - half, centres + half], axis=2), starts, ends


def points_along(shapes: Sequence[EdgeShape], shares: Sequence[float]) -> Floats:
    """Return the points at shares of the length of each line, (n, k, 2)."""
    lines = _LineArrays(shapes)
    return lines.at(lines.length * np.array(shares))


class _LineArrays:
    """Several lines as arrays. All have as many points as the line with the most points."""

    def __init__(self, shapes: Sequence[EdgeShape]) -> None:
        count = np.array([len(shape.points) for shape in shapes])
        self._points = np.zeros((len(shapes), int(count.max()), 2))
        self._lengths = np.full(self._points.shape[:2], np.inf)
        for at, shape in enumerate(shapes):
            self._points[at, : len(shape.points)] = shape.points
            self._lengths[at, : len(shape.points)] = shape.lengths
        self._rows = np.arange(len(shapes))[:, None]
        self.length = self._lengths[self._rows[:, 0], count - 1][:, None]
        self._inner = self._lengths[:, 1:].copy()
        self._inner[self._rows[:, 0], count - 2] = np.inf
        self.side = np.array([shape.side for shape in shapes])[:, None]
        self.out = np.array([shape.out for shape in shapes])[:, None]

    def at(self, along: Floats) -> Floats:
        """Return the points at lengths along each line, (n, k) -> (n, k, 2)."""
        after = 1 + (self._inner[:, None, :] <= along[:, :, None]).sum(axis=2)
        low, high = self._lengths[self._rows, after - 1], self._lengths[self._rows, after]
        step = np.where(high > low, high - low, 1.0)
        share = np.where(high > low, np.clip((along - low) / step, 0.0, 1.0), 0.0)[:, :, None]
        before = self._points[self._rows, after - 1]
        found: Floats = before + (self._points[self._rows, after] - before) * share
        return found

    def direction(self, along: Floats) -> Floats:
        """Return the directions at lengths along each line, of length 1."""
        reach = np.maximum(self.length * 0.02, 1e-6)
        step = self.at(np.minimum(along + reach, self.length)) - self.at(
            np.maximum(along - reach, 0.0)
        )
        size = np.hypot(step[:, :, 0], step[:, :, 1])
        found: Floats = step / np.where(size > 0.0, size, 1.0)[:, :, None]
        return found

    def long_side(self) -> tuple[Floats, Floats]:
        """Return the lengths at which the long middle part of each lane begins and ends."""
        known = np.isfinite(self._lengths)
        steps = np.diff(np.where(known, self._lengths, 0.0), axis=1)
        steps[~known[:, 1:]] = -1.0
        # The first and the last piece of a lane lead to its nodes.
        last = (steps >= 0.0).sum(axis=1) - 1
        inner = steps.copy()
        inner[:, 0] = -1.0
        inner[self._rows[:, 0], last] = -1.0
        at = np.where(last > 1, inner.argmax(axis=1), steps.argmax(axis=1))
        rows = self._rows[:, 0]
        return self._lengths[rows, at][:, None], self._lengths[rows, at + 1][:, None]


def _places(
    lines: _LineArrays, size: Floats, pattern: _Pattern, unit: float, lane: bool
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return all places, (n, k, 4), and whether enough of the line can be seen beside each."""
    low, high = lines.long_side() if lane else (0.0, lines.length)
    along = low + (high - low) * pattern.shares
    along = np.where(pattern.kinds == _MIDDLE, (lines.length - 8.0 * unit) / 2, along)
    centre, heading = lines.at(along), lines.direction(along)
    dx, dy = heading[:, :, 0], heading[:, :, 1]
    w, h = size[:, :1], size[:, 1:]
    # With y down, (-dy, dx) points to the right of the direction (dx, dy).
    nx, ny = -dy * lines.out, dx * lines.out
    away = np.abs(nx) * w / 2 + np.abs(ny) * h / 2 + unit
    to_right = np.where(lines.side > 0, -dy, dy) > 0
    aside = np.where(to_right, 1.0, -1.0) * ((BESIDE_GAP - 4.0) * unit + w / 2)
    outside, beside = pattern.kinds == _OUTSIDE, pattern.kinds == _BESIDE
    x = centre[:, :, 0] + np.where(outside, nx * away, np.where(beside, aside, 0.0))
    y = centre[:, :, 1] + np.where(outside, ny * away, 0.0)
    # The words are narrower than the label, by 4 pixels on each side.
    reach = np.minimum(
        (w / 2 - 3.0 * unit) / np.maximum(np.abs(dx), 1e-6), h / 2 / np.maximum(np.abs(dy), 1e-6)
    )
    whole = (along - reach >= -2.0 * unit) & (along + reach <= lines.length - 7.0 * unit)
    return np.stack([x - w / 2, y - h / 2, x + w / 2, y + h / 2], axis=2), (
        whole | outside | beside
    )
