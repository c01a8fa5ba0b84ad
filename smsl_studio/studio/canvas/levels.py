"""Levels of detail: what a node looks like at a zoom, and how large a mark's pixel then is."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

FULL_SIZE, COMPACT_SIZE, BOX_SIZE, DOT_SIZE = (108.0, 54.0), (46.0, 24.0), (28.0, 16.0), (6.0, 6.0)
FULL_MAX, COMPACT_MAX = 200.0, 132.0
ROOM = (36.0, 24.0)
"""What full nodes need between them, across and down, for an arrow to be read (pixels)."""


class Level(IntEnum):
    """How much a node shows; the order is the order of detail."""

    DOT = 0
    BOX = 1
    COMPACT = 2
    FULL = 3


def level_at(zoom: float, roomy: bool) -> Level:
    """The level at a zoom; a layout without room for full nodes stays compact when near."""
    if zoom < 0.15:
        return Level.DOT
    if zoom < 0.35:
        return Level.BOX
    return Level.FULL if roomy and zoom >= 0.70 - 1e-9 else Level.COMPACT


def unit_at(zoom: float, level: Level) -> float:
    """Scene units in one pixel of a mark.

    Full nodes are drawn in the scene's own measure. Below that marks keep their size on the
    screen; above 100 % they grow with the picture.
    """
    return 1.0 if level is Level.FULL or zoom >= 1.0 else 1.0 / zoom


def is_roomy(at: NDArray[np.float64], widths: NDArray[np.float64] | None = None) -> bool:
    """Whether full nodes stand far enough apart in a layout for their edges to be read.

    A few near neighbours are allowed (somebody moved them); it is the layout that decides.
    """
    count = len(at)
    if count < 2:
        return True
    order = np.argsort(at[:, 1], kind="stable")
    x, y = at[order, 0], at[order, 1]
    wide = (FULL_SIZE[0] if widths is None else widths[order]) + np.zeros(count)
    near = np.zeros(count, dtype=bool)
    for step in range(1, min(count, 400)):
        down = y[step:] - y[:-step]
        if down.min() >= FULL_SIZE[1] + ROOM[1]:
            break
        across = np.abs(x[step:] - x[:-step])
        need = (wide[step:] + wide[:-step]) / 2 + ROOM[0]
        hit = (across < need) & (down < FULL_SIZE[1] + ROOM[1])
        near[step:] |= hit
        near[:-step] |= hit
    return bool(near.mean() <= 0.25)
