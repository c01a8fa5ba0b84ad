"""Lines between two states: straight in a row or column, slightly curved otherwise. Pure
geometry.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point
from smsl_studio.picture.strands import NEAR, TIP_GAP, LineStyle, Strand, drawn

__all__ = [
    "TIP_GAP",
    "Between",
    "LineStyle",
    "around",
    "in_row",
    "is_clear",
    "is_forward",
    "is_outward",
    "meets",
    "shapes_of",
    "strands_of",
]

OPPOSITE, PARALLEL = 16.0, 18.0


@dataclass(frozen=True, slots=True)
class Between:
    """The edges between two states, by number and in order: from ``a`` to ``b``, and back."""

    a: int
    b: int
    there: tuple[int, ...]
    back: tuple[int, ...]

    def __len__(self) -> int:
        return len(self.there) + len(self.back)


def strands_of(
    pair: Between,
    source: NodeBox,
    target: NodeBox,
    style: LineStyle,
    outward: Point | None,
    only: int | None = None,
) -> dict[int, Strand]:
    """Return the lines of all edges between two states, side by side, or only that of the edge
    ``only``. ``shapes_of`` turns them into points.

    ``outward`` is the direction away from the middle of the picture; a single curve bends that way.
    None means that other nodes are in the straight way.
    """
    straight = outward is not None and not style.compact and in_row(source, target)
    normal = _normal(source, target)
    strands: dict[int, Strand] = {}
    for edge, there, offset in _side_by_side(pair, source, target, style, only):
        a, b = (source, target) if there else (target, source)
        bow = 0.0
        if not straight and len(pair) == 1 and outward is not None and not style.compact:
            bow = _gentle(a, b, normal, outward)
        strands[edge] = Strand(a, b, offset, bow, normal, straight)
    return strands


def shapes_of(strands: Mapping[int, Strand], style: LineStyle) -> dict[int, EdgeShape]:
    """Return the points of the lines of some edges."""
    return dict(zip(strands, drawn(list(strands.values()), style), strict=True))


def is_forward(source: NodeBox, target: NodeBox) -> bool:
    """Return whether a line from source to target runs to the right, or straight down."""
    dx, dy = target.x - source.x, target.y - source.y
    return dx > 1.0 or (abs(dx) <= 1.0 and dy > 0.0)


def is_outward(source: NodeBox, target: NodeBox, middle: Point) -> bool:
    """Return whether positive offsets lead away from the middle of the picture."""
    nx, ny = _normal(source, target)
    x, y = (source.x + target.x) / 2 - middle[0], (source.y + target.y) / 2 - middle[1]
    return nx * x + ny * y >= 0.0


def in_row(source: NodeBox, target: NodeBox) -> bool:
    """Return whether two nodes stand in one row or one column."""
    return abs(source.y - target.y) <= 1.0 or abs(source.x - target.x) <= 1.0


def _normal(source: NodeBox, target: NodeBox) -> Point:
    """Return the direction of positive offsets, across the line: downwards, or right for vertical
    lines.
    """
    dx, dy = target.x - source.x, target.y - source.y
    size = math.hypot(dx, dy) or 1.0
    nx, ny = -dy / size, dx / size
    upward = ny < -0.05 or (abs(ny) <= 0.05 and nx < 0.0)
    return (-nx, -ny) if upward else (nx, ny)


def _side_by_side(
    pair: Between, source: NodeBox, target: NodeBox, style: LineStyle, only: int | None = None
) -> Iterator[tuple[int, bool, float]]:
    """Yield for each edge (or only ``only``): its number, whether it leads from ``pair.a`` to
    ``pair.b``, and its offset from the middle.

    Between full nodes, forward edges are on top or at the left. Between compact nodes, edges keep
    to the right, as traffic does.
    """
    ways = [(pair.there, True), (pair.back, False)]
    if is_forward(source, target) == style.compact:
        ways.reverse()
    step, first = _step(pair, source, target, style), -(len(pair) - 1) / 2
    for edges, there in ways:
        if only is None:
            for at, edge in enumerate(edges):
                yield edge, there, (first + at) * step
        else:
            at = bisect_left(edges, only)
            if edges[at : at + 1] == (only,):
                yield only, there, (first + at) * step
        first += len(edges)


def _step(pair: Between, source: NodeBox, target: NodeBox, style: LineStyle) -> float:
    """Return the distance between the lines of a pair. It is so small that all lines begin at their
    node.
    """
    step = OPPOSITE if len(pair.there) == len(pair.back) == 1 else PARALLEL
    if not style.compact:
        share = 1.0 if in_row(source, target) else NEAR
        room = 2 * _reach(source, target) / share / max(len(pair) - 1, 1)
        step = min(step, max(room, 7.0))
    return step * style.unit


def _reach(source: NodeBox, target: NodeBox) -> float:
    """Return the largest offset with which a line still begins at both nodes."""
    nx, ny = (max(abs(part), 1e-6) for part in _normal(source, target))
    if in_row(source, target):
        return min(source.h, target.h) - 6.0
    return min(min((box.w - 6.0) / nx, (box.h - 6.0) / ny) for box in (source, target))


def _gentle(source: NodeBox, target: NodeBox, normal: Point, outward: Point) -> float:
    """Return the bend of a single edge: 0 in a row or column, else slight and away from the
    middle.
    """
    if in_row(source, target):
        return 0.0
    length = math.hypot(target.x - source.x, target.y - source.y)
    away = normal[0] * outward[0] + normal[1] * outward[1]
    return math.copysign(min(0.05 * length, 14.0), away)


def is_clear(
    source: NodeBox, target: NodeBox, boxes: Floats, skip: Sequence[int], gap: float
) -> bool:
    """Return whether the straight line between two nodes meets no other node.

    ``boxes`` is an (n, 4) array of centres and half sizes. ``skip`` has the rows to leave out.
    """
    line = np.array([[source.x, source.y], [target.x, target.y]])
    return not meets(line, boxes, skip, gap)


def meets(line: Floats, boxes: Floats, skip: Sequence[int], gap: float) -> bool:
    """Return whether a line of points, (n, 2), runs through one of the boxes or nearer than
    ``gap``.
    """
    low = line.min(axis=0) - gap
    high = line.max(axis=0) + gap
    reach_low, reach_high = boxes[:, :2] - boxes[:, 2:], boxes[:, :2] + boxes[:, 2:]
    near = ((reach_high >= low) & (reach_low <= high)).all(axis=1)
    near[list(skip)] = False
    rows = np.nonzero(near)[0]
    if not len(rows):
        return False
    a, b = line[:-1, None, :], line[1:, None, :]
    corner = reach_low[rows] - gap, reach_high[rows] + gap
    step = b - a
    step = np.where(np.abs(step) < 1e-9, 1e-9, step)
    t1, t2 = (corner[0] - a) / step, (corner[1] - a) / step
    enter = np.minimum(t1, t2).max(axis=2)
    leave = np.maximum(t1, t2).min(axis=2)
    return bool(((enter < leave) & (leave > 0.0) & (enter < 1.0)).any())


def around(
    pair: Between, source: NodeBox, target: NodeBox, style: LineStyle, boxes: Floats, outward: Point
) -> dict[int, EdgeShape]:
    """Return curves that bend around other nodes, with the slightest bend that meets none.

    If every bend meets a node, the lines are those of ``strands_of``.
    """
    normal = _normal(source, target)
    length = math.hypot(target.x - source.x, target.y - source.y)
    first = 1.0 if normal[0] * outward[0] + normal[1] * outward[1] >= 0 else -1.0
    for share in (0.08, 0.16, 0.26, 0.38):
        for side in (first, -first):
            bend = side * share * length
            (trial,) = drawn([Strand(source, target, 0.0, bend, normal, False)], style)
            if not meets(trial.points, boxes, (pair.a, pair.b), 8.0 * style.unit):
                return _bent(pair, source, target, style, normal, bend)
    return shapes_of(strands_of(pair, source, target, style, None), style)


def _bent(
    pair: Between, source: NodeBox, target: NodeBox, style: LineStyle, normal: Point, bend: float
) -> dict[int, EdgeShape]:
    ends = ((source, target), (target, source))
    strands = {
        edge: Strand(*ends[not there], offset, bend, normal, False)
        for edge, there, offset in _side_by_side(pair, source, target, style)
    }
    return shapes_of(strands, style)
