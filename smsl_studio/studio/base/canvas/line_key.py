"""LineKey: everything on which the lines of a sheet depend, except the places of the states."""

from __future__ import annotations

import math
from typing import NamedTuple

from smsl_studio.picture.levels import Level


class LineKey(NamedTuple):
    """Everything on which the lines of a sheet depend, except the places of its states.

    It has two flags, for compact nodes and for a far picture, and the size of a pixel of a mark in
    scene units.
    """

    compact: bool
    far: bool
    unit: float


def line_key(level: Level, unit: float) -> LineKey:
    """The key for a level of detail.

    The unit is rounded to steps of 4 %, so that a zoom does not need new lines in every frame.
    """
    step = round(math.log(unit) / math.log(1.04))
    steps = 1.0 if unit == 1.0 else round(1.04**step, 6)
    return LineKey(level is not Level.FULL, level < Level.COMPACT, steps)
