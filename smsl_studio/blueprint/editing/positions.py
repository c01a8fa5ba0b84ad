"""How positions are written."""

from __future__ import annotations

import math

from smsl_studio.blueprint.edge_layout import FAR, Point
from smsl_studio.errors import EditRefused


def point(at: Point) -> list[float]:
    """Return a position as it is written: in tenths of a pixel, whole numbers without a dot.
    EditRefused if it is not on the canvas.
    """
    if not all(math.isfinite(value) and abs(value) < FAR for value in at):
        raise EditRefused(f"the position {at} is not on the canvas", advice="Drop it nearer.")
    return [shortened(value, 1) for value in at]


def shortened(value: float, digits: int) -> float:
    """Return a number with so many digits after its dot; a whole number has none."""
    rounded = round(float(value), digits)
    return int(rounded) if rounded == int(rounded) else rounded
