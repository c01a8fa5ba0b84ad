"""Alignment: where states stand after they were lined up, distributed, or spaced equally.

These are pure functions of boxes. A box is the centre of a state's node with its width and height
(pixels at 100 %). A result holds the new centre of every box.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial

from smsl_studio.picture.levels import ROOM
from smsl_studio.picture.shape import Point

Box = tuple[float, float, float, float]
Boxes = Mapping[str, Box]
Places = dict[str, Point]

ACROSS, DOWN = 0, 1

SIDES = {
    "left": (ACROSS, -1),
    "centre": (ACROSS, 0),
    "right": (ACROSS, 1),
    "top": (DOWN, -1),
    "middle": (DOWN, 0),
    "bottom": (DOWN, 1),
}
"""The axis of each side, and which part of a box is meant: its begin (-1), middle (0), or end."""


def align(boxes: Boxes, side: str) -> Places:
    """Return the places at which all boxes have one line for a side, such as ``left``.

    The line is the outermost one that a box has at this side, or the middle of all boxes. Along the
    line only a box moves that would cover the one before it: it goes behind that one.
    """
    axis, part = SIDES[side]
    low = min((_begin(box, axis) for box in boxes.values()), default=0.0)
    high = max((_end(box, axis) for box in boxes.values()), default=0.0)
    line = (low + high) / 2 + part * (high - low) / 2
    places = {name: _at(box, axis, line - part * box[2 + axis] / 2) for name, box in boxes.items()}
    along, free = 1 - axis, -math.inf
    for name in _in_order(boxes, along):
        size, begin = boxes[name][2 + along], _begin(boxes[name], along)
        if begin < free:
            begin = free + ROOM[along]
            places[name] = _at((*places[name], 0.0, 0.0), along, begin + size / 2)
        free = begin + size
    return places


def distribute(boxes: Boxes, axis: int) -> Places:
    """Return the places at which the centres have equal distances. The outermost ones stay."""
    order = _in_order(boxes, axis)
    places = {name: (box[0], box[1]) for name, box in boxes.items()}
    if len(order) > 2:
        first, last = boxes[order[0]][axis], boxes[order[-1]][axis]
        for rank, name in enumerate(order[1:-1], 1):
            at = first + (last - first) * rank / (len(order) - 1)
            places[name] = _at(boxes[name], axis, at)
    return places


def space(boxes: Boxes, axis: int) -> Places:
    """Return the places at which the gaps between neighbours are equal.

    The outermost boxes stay. If the gaps would be too small for an arrow (``ROOM``), they spread
    from the middle.
    """
    order = _in_order(boxes, axis)
    if len(order) < 2:
        return {name: (box[0], box[1]) for name, box in boxes.items()}
    low = min(_begin(box, axis) for box in boxes.values())
    high = max(_end(box, axis) for box in boxes.values())
    filled = sum(box[2 + axis] for box in boxes.values())
    gap = (high - low - filled) / (len(order) - 1)
    if gap < ROOM[axis]:
        gap = ROOM[axis]
        low = (low + high - filled - gap * (len(order) - 1)) / 2
    places = {}
    for name in order:
        size = boxes[name][2 + axis]
        places[name] = _at(boxes[name], axis, low + size / 2)
        low += size + gap
    return {name: places[name] for name in boxes}


ARRANGEMENTS: dict[str, Callable[[Boxes], Places]] = {
    **{side: partial(align, side=side) for side in SIDES},
    "distribute_across": partial(distribute, axis=ACROSS),
    "distribute_down": partial(distribute, axis=DOWN),
    "space_across": partial(space, axis=ACROSS),
    "space_down": partial(space, axis=DOWN),
}
"""All ways to arrange boxes, by name."""


def _in_order(boxes: Boxes, axis: int) -> list[str]:
    """The names in the order of their centres. Equal centres keep the order of the other axis."""
    return sorted(boxes, key=lambda name: (boxes[name][axis], boxes[name][1 - axis]))


def _begin(box: Box, axis: int) -> float:
    return box[axis] - box[2 + axis] / 2


def _end(box: Box, axis: int) -> float:
    return box[axis] + box[2 + axis] / 2


def _at(box: Box, axis: int, value: float) -> Point:
    return (value, box[1]) if axis == ACROSS else (box[0], value)
