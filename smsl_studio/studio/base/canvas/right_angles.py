"""Lines whose pieces are all level or upright: their corners, and how one piece moves.

Pure geometry in scene units. A piece is known by its number, corners by their rank from the source.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point

EXACT = 0.3
"""Values that differ by less than this (scene units) are equal."""
LEAN = 0.02
"""A piece that leans by less than this share of its length is level or upright. Those of rounded
corners lean more, however small they are.
"""
ARC = 20.0
"""The longest rounded corner (pixels of a mark)."""
STUB = 24.0
"""How far from a state (pixels of a mark) a line turns off if its first or last piece moves away.
"""
JOIN = 6.0
"""A piece that comes so near (pixels of a mark) to the line of the one before last joins it."""
GAP = 8.0
"""The distance (pixels of a mark) that a moved piece keeps from states."""


def corners_of(shape: EdgeShape, unit: float) -> list[Point] | None:
    """The corners of a line with right angles, with its two ends; None if it has other angles."""
    pieces: list[tuple[int, Point, Point]] = []
    between = 0.0
    for a, b in pairwise(_points(shape.points)):
        dx, dy = abs(b[0] - a[0]), abs(b[1] - a[1])
        if max(dx, dy) < 1e-6:
            continue
        if min(dx, dy) > LEAN * max(dx, dy):
            between += dx + dy
            if between > ARC * unit * 1.5:
                return None
            continue
        between, axis = 0.0, int(dx < dy)
        if pieces and pieces[-1][0] == axis and abs(a[1 - axis] - pieces[-1][2][1 - axis]) <= EXACT:
            pieces[-1] = axis, pieces[-1][1], b
        else:
            pieces.append((axis, a, b))
    if not pieces or between:
        return None
    corners = [pieces[0][1]]
    for (axis, _, end), (other, start, _) in pairwise(pieces):
        if axis != other:
            corners.append((start[0], end[1]) if axis == 0 else (end[0], start[1]))
            continue
        # A short piece between two rounded corners has no straight part left.
        half = (end[axis] + start[axis]) / 2
        corners += [_at(axis, half, end[1 - axis]), _at(axis, half, start[1 - axis])]
    return [*corners, pieces[-1][2]]


def axis_of(corners: Sequence[Point], piece: int) -> int:
    """0 for a level piece, 1 for an upright one."""
    (ax, ay), (bx, by) = corners[piece : piece + 2]
    return int(abs(bx - ax) < abs(by - ay))


def piece_at(corners: Sequence[Point], at: Point) -> int:
    """The number of the piece that is nearest to a point."""
    line = EdgeShape(np.array(corners))
    along = line.along(*at)
    return min(int(np.searchsorted(line.lengths, along, side="right")) - 1, len(corners) - 2)


def moved(
    corners: Sequence[Point], piece: int, to: float, ends: tuple[NodeBox, NodeBox], unit: float
) -> list[Point]:
    """The bends of the line with one piece elsewhere: at this y if it is level, at this x if it is
    upright.

    The first and the last piece stay at their state: beyond the middle half of its side the line
    turns off before it.
    """
    points, axis = list(corners), axis_of(corners, piece)
    across = 1 - axis
    last = len(points) - 2
    low, high = points[piece], points[piece + 1]
    beside = (points[n][across] for n in (piece - 2, piece + 2) if 0 <= n <= last)
    to = next((value for value in beside if abs(value - to) <= JOIN * unit), to)
    fits = all(
        abs(to - _middle(box, across)) <= _half(box, across)
        for box, own in zip(ends, (piece == 0, piece == last), strict=True)
        if own
    )
    way = high[axis] - low[axis]
    if fits or (piece in (0, last) and abs(way) < 4 * JOIN * unit):
        to = _held(to, ends, piece, last, across)
        points[piece], points[piece + 1] = _at(axis, low[axis], to), _at(axis, high[axis], to)
        return _clean(points, JOIN * unit)
    stub = min(STUB * unit, abs(way) / 4) * (1.0 if way > 0 else -1.0)
    rest = _at(axis, low[axis], to), _at(axis, high[axis], to)
    head, tail = [rest[0]], [rest[1]]
    if piece == 0:
        head = [low, _at(axis, low[axis] + stub, low[across]), _at(axis, low[axis] + stub, to)]
    if piece == last:
        tail = [_at(axis, high[axis] - stub, to), _at(axis, high[axis] - stub, high[across]), high]
    return _clean([*points[:piece], *head, *tail, *points[piece + 2 :]], JOIN * unit)


def corner_moved(
    corners: Sequence[Point], rank: int, to: Point, ends: tuple[NodeBox, NodeBox]
) -> list[Point]:
    """The bends of the line with one corner elsewhere; both of its pieces follow.

    A piece at a state stays in the middle half of its side.
    """
    points = list(corners)
    for piece in (rank - 1, rank):
        axis = axis_of(corners, piece)
        value = _held(to[1 - axis], ends, piece, len(points) - 2, 1 - axis)
        for at in (piece, piece + 1):
            points[at] = _at(axis, points[at][axis], value)
    return points[1:-1]


def clear_value(
    corners: Sequence[Point], piece: int, to: float, boxes: Floats, unit: float
) -> float:
    """The value nearest to ``to`` at which a piece meets no state. ``boxes`` is (n, 4)."""
    axis = axis_of(corners, piece)
    low, high = sorted((corners[piece][axis], corners[piece + 1][axis]))
    gap = GAP * unit
    middle, half = boxes[:, axis], boxes[:, 2 + axis]
    near = boxes[(middle + half > low) & (middle - half < high)]
    at, wide = near[:, 1 - axis], near[:, 3 - axis] + gap
    tries = np.concatenate([[to], at - wide, at + wide])
    free = ~((np.abs(tries[:, None] - at) < wide - 1e-6).any(axis=1))
    if not free.any():
        return to
    return float(min(tries[free].tolist(), key=lambda one: abs(one - to)))


def _held(value: float, ends: tuple[NodeBox, NodeBox], piece: int, last: int, across: int) -> float:
    """The nearest value at which a piece still leaves its states straight."""
    for box, own in zip(ends, (piece == 0, piece == last), strict=True):
        if own:
            half, middle = _half(box, across), _middle(box, across)
            value = min(max(value, middle - half), middle + half)
    return value


def _clean(points: Sequence[Point], least: float) -> list[Point]:
    """The corners between the two ends, without those at which the line does not turn.

    Two pieces that are less than ``least`` beside each other become one.
    """
    kept = list(points)
    for piece in range(1, len(kept) - 2):
        axis = axis_of(kept, piece)
        if abs(kept[piece + 1][axis] - kept[piece][axis]) >= least:
            continue
        if piece < len(kept) - 3:
            value = kept[piece][axis]
            kept[piece + 1 : piece + 3] = [
                _at(1 - axis, at[1 - axis], value) for at in kept[piece + 1 : piece + 3]
            ]
        elif piece > 1:
            value = kept[piece + 1][axis]
            kept[piece - 1 : piece + 1] = [
                _at(1 - axis, at[1 - axis], value) for at in kept[piece - 1 : piece + 1]
            ]
    corners = kept[:1]
    for at, after in pairwise(kept[1:]):
        sides = zip(corners[-1], at, after, strict=True)
        if not any(abs(a - b) <= EXACT and abs(b - c) <= EXACT for a, b, c in sides):
            corners.append(at)
    return corners[1:]


def _points(points: Floats) -> list[Point]:
    return [(float(x), float(y)) for x, y in points]


def _at(axis: int, along: float, across: float) -> Point:
    return (along, across) if axis == 0 else (across, along)


def _middle(box: NodeBox, axis: int) -> float:
    return box.x if axis == 0 else box.y


def _half(box: NodeBox, axis: int) -> float:
    """Half the part of a side from which a line leaves its state straight."""
    return (box.w if axis == 0 else box.h) / 2
