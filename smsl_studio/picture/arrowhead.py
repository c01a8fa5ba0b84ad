"""The arrowhead of a line."""

from __future__ import annotations

from smsl_studio.picture.shape import EdgeShape, Point

HEAD = 8.0
"""The length of an arrowhead at 100 % (pixels)."""


def arrowhead(shape: EdgeShape, size: float) -> list[Point]:
    """Return the corners of the arrowhead at the end of a line."""
    x, y = shape.tip
    bx, by = shape.at(max(shape.length - size, 0.0))
    dx, dy = x - bx, y - by
    length = (dx * dx + dy * dy) ** 0.5 or 1.0
    dx, dy = dx / length, dy / length
    bx, by, half = x - dx * size, y - dy * size, size * 0.46
    return [(x, y), (bx - dy * half, by + dx * half), (bx + dy * half, by - dx * half)]
