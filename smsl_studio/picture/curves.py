"""Lines between two states: straight in a row or column, slightly curved otherwise. Pure
geometry.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from smsl_studio.picture.detours import GAP, Detours, Rect, detours, most_passed, reach_of
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point
from smsl_studio.picture.strands import NEAR, TIP_GAP, LineStyle, Strand, drawn

__all__ = [
    "TIP_GAP",
    "Between",
    "LineStyle",
    "around_each",
    "breadth",
    "in_row",
    "is_forward",
    "meets",
    "shapes_of",
    "strands_of",
    "stub",
]

OPPOSITE, PARALLEL, STEEP = 16.0, 18.0, 36.0
"""The distance of two opposite lines, of other lines of a pair, and of three and more in a column
of full nodes: only with so much room inner names stand between their neighbours (pixels
of a mark). Slanted lines do not get it, because they would cross those of other pairs."""
MOST_BEND = 14.0
"""The largest bend of a line that has no node in its way (scene units)."""
MOST_IN_BEND = 3
"""A line that would run through more nodes than this gets a detour and no bend."""
BENDS = (0.08, 0.16, 0.24)
"""The bends that are tried to pass a node, as shares of the line's length."""


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
    clear: bool,
    only: int | None = None,
) -> dict[int, Strand]:
    """Return the lines of all edges between two states, side by side, or only that of the edge
    ``only``. ``shapes_of`` turns them into points.

    ``clear`` says that no other node is in the straight way. A single curve bends upwards
    if it leads up, else downwards: a side that followed from the whole picture would change with
    every state that is added.
    """
    straight = clear and not style.compact and in_row(source, target)
    normal = _normal(source, target)
    strands: dict[int, Strand] = {}
    for edge, there, offset in _side_by_side(pair, source, target, style, only):
        a, b = (source, target) if there else (target, source)
        bow = 0.0
        if not straight and len(pair) == 1 and clear and not style.compact:
            bow = _gentle(a, b) if b.y > a.y else -_gentle(a, b)
        strands[edge] = Strand(a, b, offset, bow, normal, straight)
    return strands


def shapes_of(strands: Mapping[int, Strand], style: LineStyle) -> dict[int, EdgeShape]:
    """Return the points of the lines of some edges."""
    return dict(zip(strands, drawn(list(strands.values()), style), strict=True))


def is_forward(source: NodeBox, target: NodeBox) -> bool:
    """Return whether a line from source to target runs to the right, or straight down."""
    dx, dy = target.x - source.x, target.y - source.y
    return dx > 1.0 or (abs(dx) <= 1.0 and dy > 0.0)


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

    Forward edges are on top or at the left, at every zoom: a line that a person follows must not
    change places with another one.
    """
    ways = [(pair.there, True), (pair.back, False)]
    if not is_forward(source, target):
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
        if len(pair) > 2 and abs(source.x - target.x) <= 1.0:
            step = STEEP
        share = 1.0 if in_row(source, target) else NEAR
        room = 2 * _reach(source, target) / share / max(len(pair) - 1, 1)
        step = min(step, max(room, 7.0))
    return step * style.unit


def _reach(source: NodeBox, target: NodeBox) -> float:
    """Return the largest offset with which a line still begins at both nodes."""
    nx, ny = (max(abs(part), 1e-6) for part in _normal(source, target))
    if in_row(source, target):
        if abs(source.x - target.x) <= 1.0:
            return min(source.w, target.w) - 6.0
        return min(source.h, target.h) - 6.0
    return min(min((box.w - 6.0) / nx, (box.h - 6.0) / ny) for box in (source, target))


def _gentle(source: NodeBox, target: NodeBox) -> float:
    """Return the bend of a single edge: 0 in a row or column, else slight."""
    if in_row(source, target):
        return 0.0
    return min(0.05 * math.hypot(target.x - source.x, target.y - source.y), MOST_BEND)


def breadth(pair: Between, source: NodeBox, target: NodeBox, style: LineStyle) -> float:
    """Return how far the lines of a pair may lie from the straight line between its nodes."""
    if len(pair) > 1:
        return (len(pair) - 1) / 2 * _step(pair, source, target, style)
    return 0.0 if style.compact else _gentle(source, target)


def meets(line: Floats, boxes: Floats, skip: Sequence[int], gap: float) -> bool:
    """Return whether a line of points, (n, 2), is nearer than ``gap`` to one of the boxes.

    ``skip`` has the rows of the boxes that do not count.
    """
    return bool(len(Obstacles(boxes).met(line, gap, skip)))


def around_each(
    pairs: Sequence[Between],
    ends: Sequence[tuple[NodeBox, NodeBox]],
    style: LineStyle,
    obstacles: Obstacles,
) -> list[Detours]:
    """Return the lines of each pair. They miss all other nodes, if there is a way.

    The usual lines are tried first, then slightly bent ones, then a detour. If all of them meet a
    node, the lines are straight. ``ends`` has the two nodes of each pair.
    """
    tried = [_tried(pair, own, style, obstacles) for pair, own in zip(pairs, ends, strict=True)]
    strands = [strand for ways in tried for way in ways for strand in way.values()]
    shapes, first, found = drawn(strands, style), 0, []
    for pair, own, ways in zip(pairs, ends, tried, strict=True):
        last = first + len(ways) * len(pair)
        found.append(_around(pair, own, ways, shapes[first:last], style, obstacles))
        first = last
    return found


def _tried(
    pair: Between, ends: tuple[NodeBox, NodeBox], style: LineStyle, obstacles: Obstacles
) -> list[dict[int, Strand]]:
    """Return the lines that are tried before a detour: the usual ones, then bent ones."""
    source, target = ends
    ways = [strands_of(pair, source, target, style, True)]
    if _in_way(pair, ends, obstacles) <= MOST_IN_BEND:
        normal, length = _normal(source, target), _length(source, target)
        ways += [
            _bent(pair, source, target, style, normal, side * share * length)
            for share in BENDS
            for side in (-1.0, 1.0)
        ]
    return ways


def _in_way(pair: Between, ends: tuple[NodeBox, NodeBox], obstacles: Obstacles) -> int:
    """Return how many other nodes the straight line of a pair meets."""
    line = np.array([(ends[0].x, ends[0].y), (ends[1].x, ends[1].y)])
    return len(obstacles.met(line, 0.0, (pair.a, pair.b)))


def _around(
    pair: Between,
    ends: tuple[NodeBox, NodeBox],
    ways: Sequence[Mapping[int, Strand]],
    shapes: Sequence[EdgeShape],
    style: LineStyle,
    obstacles: Obstacles,
) -> Detours:
    """Return the first of the tried lines of a pair that miss all other nodes, or a detour.

    ``shapes`` has the tried lines one after the other, with the points of ``ways``.
    """
    (source, target), skip, gap = ends, (pair.a, pair.b), GAP * style.unit
    start, end = (source.x, source.y), (target.x, target.y)
    clear = obstacles.keep_clear([shape.points for shape in shapes], gap, skip)
    for at, strands in zip(range(0, len(shapes), len(pair)), ways, strict=True):
        if all(clear[at : at + len(pair)]):
            found = dict(zip(strands, shapes[at : at + len(pair)], strict=True))
            tried = [shape.points for shape in shapes[: at + len(pair)]]
            return Detours(found, _bounds([np.array([start, end]), *tried], gap))
    plain = shapes_of(strands_of(pair, source, target, style, False), style)
    if _in_way(pair, ends, obstacles) > most_passed(len(obstacles.boxes)):
        return Detours(plain, reach_of(start, end, math.inf, style.unit))
    # A detour counts offsets to the right of the way from ``a`` to ``b``. If the normal of the pair
    # points to the left, all offsets change their sign.
    normal = _normal(source, target)
    turn = (target.x - source.x) * normal[1] - (target.y - source.y) * normal[0]
    right = 1.0 if turn > 0.0 else -1.0
    beside = _side_by_side(pair, source, target, style)
    offsets = {edge: (there, offset * right) for edge, there, offset in beside}
    led = detours((source, target), offsets, obstacles, skip, style.unit)
    return led if led.shapes else led._replace(shapes=plain)


def _bounds(lines: Sequence[Floats], room: float) -> Rect:
    """Return the rectangle around some lines, with so much room around them."""
    points = np.concatenate(lines)
    (left, top), (right, bottom) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return left - room, top - room, right + room, bottom + room


def _length(source: NodeBox, target: NodeBox) -> float:
    return math.hypot(target.x - source.x, target.y - source.y)


def _bent(
    pair: Between, source: NodeBox, target: NodeBox, style: LineStyle, normal: Point, bend: float
) -> dict[int, Strand]:
    ends = ((source, target), (target, source))
    return {
        edge: Strand(*ends[not there], offset, bend, normal, False)
        for edge, there, offset in _side_by_side(pair, source, target, style)
    }


def stub(box: NodeBox, own: Sequence[int], edge: int, unit: float) -> EdgeShape:
    """Return the line of an edge whose target is missing: a short arrow down.

    ``own`` has all such edges of the node.
    """
    rank = own.index(edge) - (len(own) - 1) / 2
    x, y = box.x + rank * 18.0 * unit, box.y + box.h
    return EdgeShape(np.array([[x, y + unit], [x, y + 40.0 * unit]]), "stub", 1)
