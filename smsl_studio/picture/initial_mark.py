"""The place of the dot and arrow at the left of the initial state: where no line runs."""

from __future__ import annotations

from smsl_studio.picture.labels import LinePieces, Rect
from smsl_studio.picture.shape import NodeBox

NEAR, FAR, HALF = 2.0, 26.0, 5.0
"""How far from the node the mark begins and ends, and half its height (pixels of a mark)."""
_SHIFTS = (0.0, -0.6, 0.6, -0.35, 0.35, -0.75, 0.75)


def rect_of(box: NodeBox, shift: float, unit: float) -> Rect:
    """Return what the mark covers if it stands ``shift`` below the middle of its node."""
    right, y, half = box.x - box.w - NEAR * unit, box.y + shift, HALF * unit
    return right - (FAR - NEAR) * unit, y - half, right, y + half


def free_shift(box: NodeBox, lines: LinePieces, unit: float) -> float:
    """Return how far below the middle of its node the mark covers the fewest lines, 0 if it covers
    none there.
    """
    shifts = [share * box.h for share in _SHIFTS]
    covered = lines.covered(-1, [rect_of(box, shift, unit) for shift in shifts])
    return shifts[covered.index(min(covered))]
