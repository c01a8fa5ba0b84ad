"""Strands: descriptions of single lines between two states, and their drawing.

All lines are drawn together with a few steps of numpy. Pure geometry.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point

Ints = NDArray[np.intp]
START_GAP, TIP_GAP = 1.0, 2.0
NEAR = 0.8
"""A curve leaves and arrives at this share of its offset."""
_SHARES = np.linspace(0.0, 1.0, 33)
_LAST = len(_SHARES) - 1


class LineStyle(NamedTuple):
    """The style of lines.

    It has the scene units in one pixel of a mark, whether nodes are compact, and by which factor
    the layout is enlarged. The lines of a ``far`` picture are straight. Its compact nodes overlap
    each other, so lines around them would make long detours.
    """

    unit: float = 1.0
    compact: bool = False
    scale: float = 1.0
    far: bool = False


class Strand(NamedTuple):
    """The description of one line between two nodes.

    It runs ``offset`` beside the middle, in the direction of ``normal``. It is straight, or ``bow``
    bends it in that direction. Lengths are scene units.
    """

    source: NodeBox
    target: NodeBox
    offset: float
    bow: float
    normal: Point
    straight: bool


def drawn(strands: Sequence[Strand], style: LineStyle) -> list[EdgeShape]:
    """Return the lines. Each is cut at the borders of its source and its target."""
    if not strands:
        return []
    given = np.array([_numbers(one) for one in strands])
    source, target = given[:, 0:5], given[:, 5:10]
    offset, bow, normal = given[:, 10:11], given[:, 11:12], given[:, 12:14]
    straight = np.array([one.straight for one in strands])
    points, ends = _points(given, straight, style)
    first = _depth(points, source) - START_GAP * style.unit
    last = _depth(points, target) - TIP_GAP * style.unit
    cuts = _cuts(points, first, last)
    tips = np.where(straight[:, None, None], ends, np.stack([cuts.head, cuts.tail], axis=1))
    out, side = _sides(tips, offset[:, 0], bow[:, 0], normal, straight)
    shapes, lost = [], cuts.lost.tolist()
    for at, (begin, end, whole) in enumerate(
        zip(cuts.begin.tolist(), cuts.end.tolist(), straight.tolist(), strict=True)
    ):
        line = np.empty((2, 2)) if whole or lost[at] else points[at, begin : end + 1].copy()
        line[0], line[-1] = cuts.head[at], cuts.tail[at]
        shapes.append(EdgeShape(line, "line" if whole else "curve", side[at], out[at]))
    return shapes


def _numbers(one: Strand) -> tuple[float, ...]:
    a, b = one.source, one.target
    return (a.x, a.y, a.w, a.h, a.radius, b.x, b.y, b.w, b.h, b.radius,
            one.offset, one.bow, *one.normal)  # fmt: skip


def _points(given: Floats, straight: NDArray[np.bool_], style: LineStyle) -> tuple[Floats, Floats]:
    """Return the points of each line from centre to centre, (n, 33, 2), and the ends of a straight
    line between the same nodes, (n, 2, 2).

    ``given`` has a row of ``_numbers`` for each line.
    """
    source, target = given[:, 0:5], given[:, 5:10]
    offset, bow, normal = given[:, 10:11], given[:, 11:12], given[:, 12:14]
    ends = np.stack([source[:, :2] + normal * offset, target[:, :2] + normal * offset], axis=1)
    near = offset * (0.5 if style.compact else NEAR)
    start, goal = source[:, :2] + normal * near, target[:, :2] + normal * near
    # The middle of a quadratic curve lies half as far out as its control point.
    middle = (start + goal) / 2 + normal * (2.0 * (offset - near + bow))
    t = _SHARES[None, :, None]
    curved = (
        (1 - t) ** 2 * start[:, None] + 2 * t * (1 - t) * middle[:, None] + t**2 * goal[:, None]
    )
    line = ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * t
    return np.where(straight[:, None, None], line, curved), ends


def _depth(points: Floats, boxes: Floats) -> Floats:
    """Return the distance of each point from the rounded border of its line's box, negative
    inside.
    """
    radius = boxes[:, 4:5]
    off = np.abs(points - boxes[:, None, :2]) - (boxes[:, None, 2:4] - radius[:, None])
    dx, dy = off[:, :, 0], off[:, :, 1]
    outside = np.hypot(np.maximum(dx, 0.0), np.maximum(dy, 0.0))
    depth: Floats = outside + np.minimum(np.maximum(dx, dy), 0.0) - radius
    return depth


class _Cuts(NamedTuple):
    """Where each line is cut: the points ``begin`` to ``end`` remain, the first of them moved to
    ``head`` and the last to ``tail``.

    A line is ``lost`` if its nodes overlap, so that no part of it is outside both.
    """

    begin: Ints
    end: Ints
    head: Floats
    tail: Floats
    lost: NDArray[np.bool_]


def _cuts(points: Floats, first: Floats, last: Floats) -> _Cuts:
    every, columns = np.arange(len(points)), np.arange(_LAST + 1)
    inside = first <= 0.0
    leaves = inside.any(axis=1)
    begin = np.where(leaves, _LAST - inside[:, ::-1].argmax(axis=1), 0)
    within = (last <= 0.0) & (columns >= begin[:, None])
    reached = within.any(axis=1)
    end = np.where(reached, within.argmax(axis=1), _LAST)
    lost = (begin >= _LAST) | (end <= begin)
    begin, end = np.where(lost, 0, begin), np.where(lost, _LAST, end)
    head = np.where(
        (leaves & ~lost)[:, None], _crossing(points, first, begin), points[every, begin]
    )
    tail = np.where(
        (reached & ~lost)[:, None], _crossing(points, last, end - 1), points[every, end]
    )
    return _Cuts(begin, end, head, tail, lost)


def _crossing(points: Floats, depth: Floats, at: Ints) -> Floats:
    """Return the point where each line crosses a border, between point ``at`` and the next one."""
    every = np.arange(len(points))
    a, b = depth[every, at], depth[every, at + 1]
    step = np.where(a != b, a - b, 1.0)
    share = np.where(a != b, a / step, 0.0)[:, None]
    before = points[every, at]
    crossing: Floats = before + (points[every, at + 1] - before) * share
    return crossing


def _sides(
    tips: Floats, offset: Floats, bow: Floats, normal: Floats, straight: NDArray[np.bool_]
) -> tuple[list[int], list[int]]:
    """Return for each line the side away from its neighbours (1 right, -1 left of its direction),
    and the side on which its label may stand (0 on the line).
    """
    dx, dy = (tips[:, 1] - tips[:, 0]).T
    right = -dy * normal[:, 0] + dx * normal[:, 1]
    leaning = np.where(straight | (offset != 0.0), offset, bow)
    out = np.where(right * leaning >= 0.0, 1, -1)
    beside = np.where(right * offset >= 0.0, 1, -1)
    steep = (np.abs(dx) <= 0.35 * np.abs(dy)) & (offset != 0.0)
    return out.tolist(), np.where(steep, beside, 0).tolist()
