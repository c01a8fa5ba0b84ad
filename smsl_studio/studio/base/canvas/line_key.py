"""LineKey: what the lines of a sheet depend on besides the places of its states."""

from __future__ import annotations

import math
from typing import NamedTuple

from smsl_studio.picture.levels import Level


class LineKey(NamedTuple):
    """Whether nodes are compact, whether the picture is far, and the scene units of a mark
    pixel."""

    compact: bool
    far: bool
    unit: float


def line_key(level: Level, unit: float) -> LineKey:
    """The key at a level of detail. The unit is rounded to steps of 4 %, so that a zoom does not
    need new lines in every frame."""
    step = round(math.log(unit) / math.log(1.04))
    steps = 1.0 if unit == 1.0 else round(1.04**step, 6)
    return LineKey(level is not Level.FULL, level < Level.COMPACT, steps)
