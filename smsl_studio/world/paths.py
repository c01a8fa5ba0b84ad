"""Paths of a tool in space, and the timetable along them. The functions only compute; they need no
engine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from smsl_studio.world.pose import check_position

Array = NDArray[np.float64]


def minimum_jerk(share: float) -> float:
    """Return the share (0..1) of the way that a minimum-jerk motion has made after ``share`` (0..1)
    of its time."""
    return share**3 * (10.0 - 15.0 * share + 6.0 * share**2)


def waypoints(corners: Sequence[Array], spacing: float = 0.012) -> tuple[list[Array], list[float]]:
    """Return points through the corners, at most ``spacing`` (m) apart, and the way (m) of each
    point from the start.

    WorldError for a corner that is no position.
    """
    for corner in corners:
        check_position("a way", list(corner))
    points, ways = [np.asarray(corners[0], dtype=np.float64)], [0.0]
    for start, end in pairwise(corners):
        length = float(np.linalg.norm(np.subtract(end, start)))
        count = max(1, math.ceil(length / spacing))
        before = ways[-1]
        for i in range(1, count + 1):
            points.append(np.add(start, np.subtract(end, start) * (i / count)))
            ways.append(before + length * i / count)
    return points, ways


def rounded(corners: Sequence[Array], radius: float, pieces: int = 6) -> list[Array]:
    """Return the same path with rounded inner corners. Each curve begins ``radius`` (m) before its
    corner and has ``pieces`` parts."""
    path = [corners[0]]
    for before, corner, after in zip(corners, corners[1:], corners[2:], strict=False):
        a = corner + _towards(corner, before, radius)
        b = corner + _towards(corner, after, radius)
        for i in range(pieces + 1):
            t = i / pieces
            path.append((1 - t) ** 2 * a + 2 * t * (1 - t) * corner + t**2 * b)
    path.append(corners[-1])
    return path


def _towards(here: Array, there: Array, length: float) -> Array:
    way = there - here
    distance = float(np.linalg.norm(way))
    return way * (min(length, distance / 2) / distance) if distance > 0 else way


def timetable(ways: Sequence[float], speed: float, tick: float) -> list[tuple[int, float]]:
    """Return the segment, and the share (0..1) of it, at each tick of a smooth motion.

    ``ways`` are the ways (m) of the points from the start. ``speed`` is the greatest speed (m/s); a
    minimum-jerk motion takes 15/8 of length / speed. ``tick`` is in seconds.
    """
    length = ways[-1]
    ticks = max(1, math.ceil(1.875 * length / speed / tick))
    table, segment = [], 0
    for i in range(1, ticks + 1):
        way = length * minimum_jerk(i / ticks)
        while segment < len(ways) - 2 and ways[segment + 1] < way:
            segment += 1
        span = ways[segment + 1] - ways[segment]
        table.append((segment, min(1.0, (way - ways[segment]) / span) if span > 0 else 1.0))
    return table
