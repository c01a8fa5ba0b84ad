"""Guides: lines of other states' centres, to which a dragged state snaps."""

from __future__ import annotations

import numpy as np

from smsl_studio.picture.shape import Floats, Point

Guide = tuple[float, float, float, float]
"""A line from one point to another: x, y, x, y (scene units)."""
SAME = 0.05
"""In scene units. Centres that differ by less are on one line, because files keep tenths."""


def snapped(
    at: Point, others: Floats, reach: float, grid: float
) -> tuple[Point, tuple[Guide, ...]]:
    """Return where a state snaps to, and the guides that show why.

    In each direction it takes the nearest centre of the others, (n, 2), within ``reach``. Without
    one it takes the nearest line of the grid, which has no guide.
    """
    found = [_nearest(at[axis], others[:, axis], reach) for axis in (0, 1)]
    x, y = (
        centre if centre is not None else round(at[axis] / grid) * grid
        for axis, centre in enumerate(found)
    )
    guides: list[Guide] = []
    if found[0] is not None:
        low, high = _extent(others, 0, x, y)
        guides.append((x, low, x, high))
    if found[1] is not None:
        low, high = _extent(others, 1, y, x)
        guides.append((low, y, high, y))
    return (x, y), tuple(guides)


def _nearest(value: float, centres: Floats, reach: float) -> float | None:
    """The centre nearest to a value, None if none is within reach."""
    if not len(centres):
        return None
    best = float(centres[np.abs(centres - value).argmin()])
    return best if abs(best - value) <= reach else None


def _extent(others: Floats, axis: int, line: float, own: float) -> tuple[float, float]:
    """From where to where a guide reaches: all states on the line and the dragged one itself."""
    along = others[np.abs(others[:, axis] - line) <= SAME, 1 - axis]
    return min(float(along.min()), own), max(float(along.max()), own)
