"""Operations back to the start: those that lead to the initial state from far away.

In a dense drawing they share one lane outside the rows. Each state from which one leads has a small
mark, and the chip of the lane counts them all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.shape import NodeBox, Point
from smsl_studio.picture.words import width

AWAY, LEAST = 2, 3
"""So many operations away from the initial state a state is far, and so many operations or more
share a lane."""
CHIP_HIGH, CHIP_SIDES, HOUSE = 20.0, 30.0, 12.0
"""The height of the chip of the lane, the room beside its words, and the size of the house in front
of them (pixels of a mark)."""
TEXT = 11.0
Ints = NDArray[np.int32]
Rect = tuple[float, float, float, float]


def returns_of(source: Ints, target: Ints, initial: int) -> tuple[int, ...]:
    """Return the operations to the initial state from states that are far from it, by number; none
    if these are too few for a lane. A state that is not reached counts as far.
    """
    if initial < 0:
        return ()
    near = np.zeros(int(max(source.max(initial=0), target.max(initial=0))) + 1, dtype=bool)
    near[initial] = True
    for _ in range(AWAY - 1):
        onward = target[near[source]]
        near[onward[onward >= 0]] = True
    found = np.nonzero((target == initial) & ~near[source])[0].tolist()
    return tuple(found) if len(found) >= LEAST else ()


def lane_words(count: int) -> str:
    """Return the words on the chip of the lane."""
    return f"to start, {count}"


def lane_chip_size(count: int) -> tuple[float, float]:
    """Return the width and height of the chip of the lane (pixels of a mark)."""
    return round(width(lane_words(count), TEXT)) + CHIP_SIDES, CHIP_HIGH


def stub_of(box: NodeBox, unit: float) -> list[Point]:
    """Return the line of the mark below a state from which an operation leads back to the start. It
    ends in an arrowhead.
    """
    x, top = box.x - box.w * 0.5, box.y + box.h + 1.5 * unit
    low = top + 7.0 * unit
    return [(x + 6.0 * unit, top), (x + 6.0 * unit, low), (x - 8.0 * unit, low)]


def stub_rect(box: NodeBox, unit: float) -> Rect:
    """Return the rectangle of the mark, which no label may cover."""
    (right, top), (_, low), (left, _) = stub_of(box, unit)
    return left, top, right + unit, low + 4.0 * unit


def house(x: float, y: float) -> list[Point]:
    """Return the corners of a house whose middle is at a point (pixels of a mark)."""
    half, wall = HOUSE / 2, HOUSE / 2 - 2.0
    return [
        (x - half, y), (x, y - half), (x + half, y), (x + wall, y),
        (x + wall, y + half - 1.0), (x - wall, y + half - 1.0), (x - wall, y),
    ]  # fmt: skip
