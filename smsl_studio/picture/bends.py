"""Lines that lead through bends, as somebody has drawn them by hand. Pure geometry."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture.curves import meets
from smsl_studio.picture.labels import LabelPlaces
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point, border, rounded
from smsl_studio.picture.strands import START_GAP, TIP_GAP

GAP = 8.0
"""The distance (pixels of a mark) that a line keeps from nodes, if there is a way around them."""
RADIUS = 8.0
HANDLE = 11.0
"""The size of the handle of a bend (pixels of a mark)."""
_BOWS = (0.08, 0.16, 0.26, 0.38)
"""How far a piece between two bends leads around a node, as a share of its length."""
_CURVE = np.linspace(0.0, 1.0, 9)[1:-1, None]
_PETAL = 9.0
"""Half the width (pixels of a mark) of a loop with one bend."""


def bent(
    source: NodeBox,
    target: NodeBox,
    bends: Sequence[Point],
    unit: float,
    others: Floats | None = None,
) -> EdgeShape | None:
    """Return the line from one node to another through bends, None if all bends lie at its nodes.

    A bend at the node from which the line comes, or to which it goes next, is left out.
    ``others`` has all other nodes, (n, 4), around which the pieces between bends lead if they can.
    """
    start, end = START_GAP * unit, TIP_GAP * unit
    points = list(bends)
    while points and _is_at(source, points[0], start):
        points.pop(0)
    while points and _is_at(target, points[-1], end):
        points.pop()
    if not points:
        return None
    first, last = _anchor(source, points[0]), _anchor(target, points[-1])
    if source == target and len(points) == 1:
        first, last = _petal(source, first, points[0], unit)
    corners = [
        border(source, first, points[0], start),
        *points,
        border(target, last, points[-1], end),
    ]
    if others is not None and len(others):
        corners = _around(corners, others, GAP * unit)
    return EdgeShape(rounded(corners, RADIUS * unit), "bent")


def clear_of(at: Point, boxes: Floats, gap: float) -> Point:
    """Return the nearest point that is outside all nodes, with a gap. ``boxes`` is (n, 4). Between
    nodes without room it is only outside the first one.
    """
    x, y = at
    off = np.abs(boxes[:, :2] - (x, y)) - boxes[:, 2:] - gap
    inside = np.nonzero((off < 0.0).all(axis=1))[0]
    if not len(inside):
        return at
    box_x, box_y, w, h = boxes[inside[0]].tolist()
    if off[inside[0], 0] > off[inside[0], 1]:
        return box_x + (w + gap) * (1.0 if x >= box_x else -1.0), y
    return x, box_y + (h + gap) * (1.0 if y >= box_y else -1.0)


def keep_clear(layouts: Iterable[EdgeLayout], places: LabelPlaces) -> None:
    """Keep labels off the handles of all bends."""
    half = HANDLE / 2 * places.unit
    for layout in layouts:
        for x, y in layout.bends:
            places.take((x - half, y - half, x + half, y + half))


def rank_of(shape: EdgeShape, bends: Sequence[Point], at: Point) -> int:
    """Return the place among the bends that a new bend at a point near the line gets."""
    along = shape.along(*at)
    return sum(shape.along(*bend) < along for bend in bends)


def _is_at(box: NodeBox, point: Point, gap: float) -> bool:
    return bool(box.depth(np.array([point]))[0] <= gap)


def _anchor(box: NodeBox, towards: Point) -> Point:
    """Return the point inside a node to which its line is drawn. Beside the node's middle it is
    straight across from the bend.
    """
    wide, high = box.w / 2, box.h / 2
    x = min(max(towards[0], box.x - wide), box.x + wide)
    return x, min(max(towards[1], box.y - high), box.y + high)


def _petal(box: NodeBox, anchor: Point, bend: Point, unit: float) -> tuple[Point, Point]:
    """Return two anchors beside each other, so that a loop does not run back on itself."""
    x, y = bend[0] - anchor[0], bend[1] - anchor[1]
    half = min(_PETAL * unit, box.h / 3) / (float(np.hypot(x, y)) or 1.0)
    across = -y * half, x * half
    return (
        (anchor[0] + across[0], anchor[1] + across[1]),
        (anchor[0] - across[0], anchor[1] - across[1]),
    )


def _around(corners: list[Point], others: Floats, gap: float) -> list[Point]:
    """Return the corners with more of them where a piece would meet a node and has a way around."""
    found = corners[:1]
    for a, b in pairwise(corners):
        found += _detour(np.array(a), np.array(b), others, gap)
        found.append(b)
    return found


def _detour(a: Floats, b: Floats, others: Floats, gap: float) -> list[Point]:
    if not meets(np.array([a, b]), others, (), gap):
        return []
    step = b - a
    normal = np.array([-step[1], step[0]])
    for share in _BOWS:
        for side in (1.0, -1.0):
            middle = (a + b) / 2 + normal * (2.0 * share * side)
            t = _CURVE
            curve = (1 - t) ** 2 * a + 2 * t * (1 - t) * middle + t**2 * b
            if not meets(np.vstack([a, curve, b]), others, (), gap):
                return [(float(x), float(y)) for x, y in curve]
    return []
