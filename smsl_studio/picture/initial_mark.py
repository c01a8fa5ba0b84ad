"""The place of the mark of the initial state: a dot and an arrow left of the node, off lines."""

from __future__ import annotations

from smsl_studio.picture.line_pieces import LinePieces, Rect
from smsl_studio.picture.shape import NodeBox

NEAR, FAR, HALF = 2.0, 26.0, 5.0
"""The distances from the node to the right and left end of the mark, and half its height (pixels of
a mark)."""
_SHIFTS = (0.0, -0.6, 0.6, -0.35, 0.35, -0.75, 0.75)


def rect_of(box: NodeBox, shift: float, unit: float) -> Rect:
    """Return the rectangle of the mark if it stands ``shift`` below the middle of its node."""
    right, y, half = box.x - box.w - NEAR * unit, box.y + shift, HALF * unit
    return right - (FAR - NEAR) * unit, y - half, right, y + half


def placed(box: NodeBox, lines: LinePieces, unit: float) -> tuple[float, Rect]:
    """Return how far below the middle of its node the mark stands, and its rectangle."""
    shift = free_shift(box, lines, unit)
    return shift, rect_of(box, shift, unit)


def free_shift(box: NodeBox, lines: LinePieces, unit: float) -> float:
    """Return the distance below the middle of the node at which the mark covers the fewest lines.

    It is 0 if the mark covers no line in the middle.
    """
    shifts = [share * box.h for share in _SHIFTS]
    covered = lines.covered(-1, [rect_of(box, shift, unit) for shift in shifts])
    return shifts[covered.index(min(covered))]
