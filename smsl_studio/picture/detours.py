"""Detours: lines that lead around the nodes between two other nodes. Pure geometry.

A detour is the shortest way that keeps its distance from nodes. It depends only on its two nodes
and on nodes near it (``reach_of``). So an edit elsewhere does not change it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from smsl_studio.picture.obstacles import Ints, Obstacles, pieces_hit
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point, border, rounded
from smsl_studio.picture.strands import START_GAP, TIP_GAP

GAP = 8.0
"""The distance that lines keep from nodes, if there is a way (pixels of a mark)."""
_TRIED = (
    (1.0, 18.0, 1.0), (1.0, 18.0, 0.0), (1.0, 7.0, 0.0),
    (0.5, 5.0, 0.0), (0.2, 3.0, 0.0), (0.05, 1.0, 0.0),
)  # fmt: skip
"""What is tried, one after the other. The numbers are the share of ``GAP`` that lines keep from
nodes, the largest distance between parallel lines (pixels of a mark), and the share of ``_APART``.
The last rows are for nodes that stand very close together.
"""
_SPARE = 2.0
"""A detour gets so much room in addition to the gap, so that its corners can be rounded (pixels of
a mark).
"""
_APART = 6.0
"""A detour keeps a further distance from nodes: 0, 1 or 2 times this (pixels of a mark). The places
of its two nodes choose which. So two detours around the same node seldom lie on each other.
"""
_RADII = (40.0, 22.0, 10.0, 5.0, 1.0)
MOST_PASSED = 28
"""A line that would have to pass more nodes than this gets no detour."""
FEW, MOST_PASSED_OF_MANY = 100, 4
"""In a picture with more than ``FEW`` nodes, this limit holds instead of ``MOST_PASSED``."""
_TIE = 1e-6
_BESIDE = 90.0
"""The largest distance of a line from the way that it follows (pixels of a mark)."""
Rect = tuple[float, float, float, float]


class Detours(NamedTuple):
    """Lines around nodes, by edge. Only nodes inside the rectangle ``reach`` can change them."""

    shapes: dict[int, EdgeShape]
    reach: Rect


def detours(
    ends: tuple[NodeBox, NodeBox],
    offsets: Mapping[int, tuple[bool, float]],
    obstacles: Obstacles,
    skip: Sequence[int],
    unit: float,
) -> Detours:
    """Return parallel lines that lead around all nodes between two others.

    There are no lines if there is no way. ``offsets`` has two values for each edge: whether it
    leads from the first node to the second one, and its distance from the middle of the lines
    (positive to the right, seen from the first node). ``skip`` has the numbers of the two nodes.
    """
    first, second = ends
    start, end = (first.x, first.y), (second.x, second.y)
    widest = max(abs(offset) for _, offset in offsets.values())
    room = min(first.w, first.h, second.w, second.h) - 4.0 * unit
    apart = _APART * unit * (round(sum((*start, *end))) % 3)
    longest = 0.0
    for share, pitch, more in _TRIED:
        gap = share * GAP * unit
        narrow = min(1.0, room / widest, pitch / 18.0) if widest else 1.0
        wanted = gap + narrow * widest + _SPARE * share * unit + more * apart
        way = shortest_way(start, end, obstacles, wanted, skip)
        longest = max(longest, length_of(way) if way else math.inf)
        if way is None:
            continue
        if not way:
            break
        shapes = {}
        for edge, (there, offset) in offsets.items():
            line = _beside(way, offset * narrow)
            pair = (first, second) if there else (second, first)
            shape = _shape(line if there else line[::-1], pair, obstacles, skip, gap, unit)
            if shape is None:
                break
            shapes[edge] = shape
        else:
            return Detours(shapes, reach_of(start, end, longest, unit))
    return Detours({}, reach_of(start, end, math.inf, unit))


def length_of(way: Sequence[Point]) -> float:
    """Return the length of the way from point to point."""
    return sum(math.dist(a, b) for a, b in pairwise(way))


def shortest_way(
    start: Point, end: Point, obstacles: Obstacles, gap: float, skip: Sequence[int] = ()
) -> list[Point] | None:
    """Return the points of the shortest way from ``start`` to ``end`` that keeps a gap from nodes.

    It is None if there is no way. It is empty if too many nodes are in the way (``most_passed``).
    """
    passed: Ints = np.zeros(0, dtype=np.intp)
    while len(passed) <= most_passed(len(obstacles.boxes)):
        way = _shortest(start, end, obstacles.boxes[passed], gap)
        if way is None:
            return None
        # The way leads around the nodes known so far. If it meets other nodes, they count from now
        # on. If it meets none, no shorter way exists.
        met = [obstacles.met(np.array(piece), gap - 1e-6, skip) for piece in pairwise(way)]
        hit = np.setdiff1d(np.concatenate(met), passed)
        if not len(hit):
            return way
        passed = np.union1d(passed, hit)
    return []


def most_passed(nodes: int) -> int:
    """Return the largest number of nodes that a detour may pass in a picture with so many nodes."""
    return MOST_PASSED if nodes <= FEW else MOST_PASSED_OF_MANY


def _shortest(start: Point, end: Point, boxes: Floats, gap: float) -> list[Point] | None:
    """Return the shortest way around these boxes, from corner to corner. None if there is none."""
    signs = np.array([(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)])
    corners = boxes[:, None, :2] + (boxes[:, None, 2:] + gap) * signs
    points = np.vstack([[start, end], corners.reshape(-1, 2)])
    off = np.abs(points[:, None] - boxes[None, :, :2]) - boxes[None, :, 2:] - gap
    free = ~(off.max(axis=2, initial=-np.inf) < -1e-6).any(axis=1)
    if not free[:2].all():
        return None
    points = points[free]
    count = len(points)
    a, b = np.triu_indices(count, 1)
    seen = ~pieces_hit(points[a], points[b], boxes, gap - 1e-6).any(axis=1)
    apart = np.full((count, count), np.inf)
    apart[a[seen], b[seen]] = np.hypot(*(points[b[seen]] - points[a[seen]]).T)
    apart = np.minimum(apart, apart.T)
    return _through(points, apart)


def _through(points: Floats, apart: Floats) -> list[Point] | None:
    """Return the shortest way from point 0 to point 1, by the algorithm of Dijkstra.

    ``apart`` has the distances of all points, infinite if a box is between them. If two ways are
    equally long, the one through the first points is taken.
    """
    length, before = np.full(len(points), np.inf), np.zeros(len(points), dtype=np.intp)
    length[0], open_ = 0.0, np.ones(len(points), dtype=bool)
    while open_[1]:
        at = int(np.where(open_, length, np.inf).argmin())
        if not open_[at] or not np.isfinite(length[at]):
            return None
        open_[at] = False
        longer = length[at] + apart[at]
        better = longer < length - _TIE
        length[better], before[better] = longer[better], at
    way = [1]
    while way[-1]:
        way.append(int(before[way[-1]]))
    return [(float(x), float(y)) for x, y in points[way[::-1]]]


def _beside(way: Sequence[Point], offset: float) -> Floats:
    """Return the line that runs parallel to a way, to its right (y down). It keeps its distance at
    corners, too. Outside a very sharp corner it comes nearer.
    """
    points = np.array(way)
    step = points[1:] - points[:-1]
    across = np.column_stack([-step[:, 1], step[:, 0]]) / np.hypot(*step.T)[:, None]
    middle = across[:-1] + across[1:]
    size = np.maximum((middle**2).sum(axis=1), 0.5)
    return points + offset * np.vstack([across[:1], 2.0 * middle / size[:, None], across[-1:]])


def _shape(
    line: Floats,
    ends: tuple[NodeBox, NodeBox],
    obstacles: Obstacles,
    skip: Sequence[int],
    gap: float,
    unit: float,
) -> EdgeShape | None:
    """Return the line between the borders of its nodes, with corners as round as the room allows.

    It is None if the line comes too near to another node, or if it does not end in its nodes.
    """
    corners = _cut([(float(x), float(y)) for x, y in line], *ends, unit)
    if corners is None:
        return None
    lines = [rounded(corners, radius * unit) for radius in _RADII]
    for points, clear in zip(lines, obstacles.keep_clear(lines, gap, skip), strict=True):
        if clear:
            return EdgeShape(points, "detour", 0, _out(corners))
    return None


def _cut(line: list[Point], source: NodeBox, target: NodeBox, unit: float) -> list[Point] | None:
    """Return the part of a line outside its two nodes, from border to border.

    It is None if the line does not begin inside ``source`` and end inside ``target``.
    """
    start, end = START_GAP * unit, TIP_GAP * unit
    inside = source.depth(np.array(line)) <= start
    arrived = target.depth(np.array(line)) <= end
    if not (inside[0] and arrived[-1]):
        return None
    first = int(np.nonzero(~inside)[0][0]) if not inside.all() else len(line)
    last = int(np.nonzero(~arrived)[0][-1]) if not arrived.all() else -1
    if last < first - 1 or first == len(line):
        return None
    head = border(source, line[first - 1], line[first], start)
    tail = border(target, line[last + 1], line[last], end)
    return [head, *line[first : last + 1], tail]


def _out(corners: Sequence[Point]) -> int:
    """Return the outer side of a bent line: 1 is right, -1 is left."""
    (ax, ay), (bx, by) = corners[0], corners[-1]
    turn = sum((bx - ax) * (y - ay) - (by - ay) * (x - ax) for x, y in corners[1:-1])
    return 1 if turn >= 0.0 else -1


def reach_of(start: Point, end: Point, longest: float, unit: float) -> Rect:
    """Return a rectangle (left, top, right, bottom) around all ways from ``start`` to ``end`` that
    are at most ``longest`` long. The lines and gaps beside these ways are in it, too.
    """
    direct = math.dist(start, end)
    across = math.sqrt(max(longest**2 - direct**2, 0.0)) / 2
    aside = across + max(longest - direct, 0.0) / 2 + _BESIDE * unit
    (ax, ay), (bx, by) = start, end
    return min(ax, bx) - aside, min(ay, by) - aside, max(ax, bx) + aside, max(ay, by) + aside
