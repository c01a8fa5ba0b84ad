"""EdgeShape: the line of one edge as a row of points. Pure geometry."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]
_HALVINGS = 24


@dataclass(frozen=True, eq=False)
class EdgeShape:
    """The line of an edge, from the border of its source to the tip of its arrowhead.

    ``points`` is an (n, 2) array, n >= 2 (scene units). ``way`` is its kind: ``line``, ``curve``,
    ``lane``, ``detour``, ``loop``, ``stub``, or ``bent`` (by hand). ``side`` is the side at which
    the label of a steep line may stand: -1 is left of the line's direction, 1 right of it, and 0 on
    the line. ``out`` is the side on which no parallel line runs: 1 is right, -1 is left.
    """

    points: Floats
    way: str = "line"
    side: int = 0
    out: int = 1

    @cached_property
    def lengths(self) -> Floats:
        """The length from the start to each point, (n,)."""
        if len(self.points) == 2:
            (ax, ay), (bx, by) = self.points.tolist()
            return np.array([0.0, np.hypot(bx - ax, by - ay)])
        steps = np.hypot(*(self.points[1:] - self.points[:-1]).T)
        return np.concatenate([[0.0], np.cumsum(steps)])

    @cached_property
    def length(self) -> float:
        """The length of the whole line."""
        return float(self.lengths[-1])

    @cached_property
    def reversed(self) -> EdgeShape:
        """The same line in the other direction."""
        return EdgeShape(self.points[::-1], self.way, -self.side, -self.out)

    @property
    def tip(self) -> Point:
        """The point where the line ends."""
        return float(self.points[-1, 0]), float(self.points[-1, 1])

    @cached_property
    def heading(self) -> Point:
        """The direction of the arrowhead, of length 1."""
        return self.direction(self.length)

    def at(self, along: float) -> Point:
        """Return the point at a length along the line."""
        lengths, points = self._plain
        i = bisect_right(lengths, along, 1, len(lengths) - 1)
        low, high = lengths[i - 1], lengths[i]
        share = min(max((along - low) / (high - low), 0.0), 1.0) if high > low else 0.0
        (ax, ay), (bx, by) = points[i - 1], points[i]
        return ax + (bx - ax) * share, ay + (by - ay) * share

    @cached_property
    def _plain(self) -> tuple[list[float], list[list[float]]]:
        """Lengths and points as lists, because single values are read faster from a list."""
        return self.lengths.tolist(), self.points.tolist()

    def direction(self, along: float) -> Point:
        """Return the direction at a length along the line, of length 1."""
        reach = max(self.length * 0.02, 1e-6)
        low, high = max(along - reach, 0.0), min(along + reach, self.length)
        (ax, ay), (bx, by) = self.at(low), self.at(high)
        size = float(np.hypot(bx - ax, by - ay)) or 1.0
        return (bx - ax) / size, (by - ay) / size

    def cut(self, start: float, end: float) -> Floats:
        """Return the part of the line between two lengths along it, (n, 2)."""
        start, end = max(start, 0.0), min(end, self.length)
        if len(self.points) == 2:
            return np.array([self.at(start), self.at(max(end, start))])
        inside = self.points[(self.lengths > start) & (self.lengths < end)]
        return np.concatenate([[self.at(start)], inside, [self.at(max(end, start))]])

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def is_like(self, other: EdgeShape) -> bool:
        """Return whether another line is equal."""
        if self is other:
            return True
        if (self.way, self.side, self.out) != (other.way, other.side, other.out):
            return False
        return bool(np.array_equal(self.points, other.points))

    @cached_property
    def pieces(self) -> Floats:
        """The straight pieces of the line, (n, 4). Of a curve, so many points are left out that
        no piece is farther than about half a pixel from it.
        """
        points = self.points
        if self.way in ("curve", "loop"):
            step = 2 if self.way == "loop" else self._spared()
            points = np.concatenate([points[:-1:step], points[-1:]])
        return np.concatenate([points[:-1], points[1:]], axis=1)

    def _spared(self) -> int:
        """Return of how many points of a curve one is enough, by how much it bends."""
        (ax, ay), (x, y), (bx, by) = self.points[[0, len(self.points) // 2, -1]].tolist()
        bend = math.hypot(x - (ax + bx) / 2, y - (ay + by) / 2)
        return 4 if bend <= 32.0 else 2 if bend <= 128.0 else 1

    def distance(self, x: float, y: float) -> float:
        """Return the distance of a point from the line."""
        return float(self._near(np.array([[x, y]]))[0].min())

    def along(self, x: float, y: float) -> float:
        """Return the length along the line at which it is nearest to a point."""
        return self.all_along(np.array([[x, y]]))[0]

    def all_along(self, points: Floats) -> list[float]:
        """Return for each point, (n, 2), the length along the line at which it is nearest."""
        away, share = self._near(points)
        piece = away.argmin(axis=1)
        low, high = self.lengths[piece], self.lengths[piece + 1]
        found: list[float] = (low + (high - low) * share[np.arange(len(points)), piece]).tolist()
        return found

    def _near(self, points: Floats) -> tuple[Floats, Floats]:
        """Return for each point and piece, (n, k), their distance, and at which share of the piece
        that is.
        """
        start, step, size = self._steps
        share = np.clip(((points[:, None] - start) * step).sum(axis=2) / size, 0.0, 1.0)
        near = start + step * share[:, :, None] - points[:, None]
        return np.hypot(near[..., 0], near[..., 1]), share

    @cached_property
    def _steps(self) -> tuple[Floats, Floats, Floats]:
        """Where each piece starts, where it leads from there, and its length squared."""
        start, step = self.points[:-1], self.points[1:] - self.points[:-1]
        size = (step**2).sum(axis=1)
        size[size == 0.0] = 1.0
        return start, step, size


@dataclass(frozen=True, slots=True)
class NodeBox:
    """A node as an obstacle: its centre, half its width and height, and the radius of its
    corners.
    """

    x: float
    y: float
    w: float
    h: float
    radius: float = 8.0

    def depth_at(self, x: float, y: float) -> float:
        """Return the distance of a point from the rounded border. It is negative inside."""
        dx = abs(x - self.x) - (self.w - self.radius)
        dy = abs(y - self.y) - (self.h - self.radius)
        outside = math.hypot(max(dx, 0.0), max(dy, 0.0))
        return outside + min(max(dx, dy), 0.0) - self.radius

    def depth(self, points: Floats) -> Floats:
        """Return the distance of each point from the rounded border, negative inside."""
        dx = np.abs(points[:, 0] - self.x) - (self.w - self.radius)
        dy = np.abs(points[:, 1] - self.y) - (self.h - self.radius)
        outside = np.hypot(np.maximum(dx, 0.0), np.maximum(dy, 0.0))
        depth: Floats = outside + np.minimum(np.maximum(dx, dy), 0.0) - self.radius
        return depth


def border(box: NodeBox, inside: Point, outside: Point, gap: float) -> Point:
    """Return the point on the straight way from ``inside`` a node to ``outside`` at which the
    distance from its border is ``gap``.
    """
    (ax, ay), (bx, by) = inside, outside
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        share = (low + high) / 2
        if box.depth_at(ax + (bx - ax) * share, ay + (by - ay) * share) <= gap:
            low = share
        else:
            high = share
    return ax + (bx - ax) * high, ay + (by - ay) * high


def rounded(corners: list[Point], radius: float) -> Floats:
    """Return a line through ``corners``, (n, 2), whose inner corners are rounded."""
    points: list[Point] = [corners[0]]
    for before, corner, after in zip(corners, corners[1:], corners[2:], strict=False):
        r = min(radius, _far(before, corner) / 2, _far(corner, after) / 2)
        start, end = _towards(corner, before, r), _towards(corner, after, r)
        for share in (0.0, 0.25, 0.5, 0.75, 1.0):
            a, b, c = (1 - share) ** 2, 2 * share * (1 - share), share**2
            x = a * start[0] + b * corner[0] + c * end[0]
            points.append((x, a * start[1] + b * corner[1] + c * end[1]))
    points.append(corners[-1])
    return np.array(points)


def _far(a: Point, b: Point) -> float:
    return float(np.hypot(b[0] - a[0], b[1] - a[1]))


def _towards(a: Point, b: Point, length: float) -> Point:
    size = _far(a, b) or 1.0
    return a[0] + (b[0] - a[0]) * length / size, a[1] + (b[1] - a[1]) * length / size
