"""Poster: how a picture is spread over sheets of paper. Pure geometry, in points."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor

from smsl_studio.errors import UsageError

OVERLAP = 28.0
"""The strip that two neighbouring sheets both have (points, 10 mm), for the glue."""
FOOT = 14.0
"""The height below the picture for the place of a sheet in its poster (points)."""
NATURAL = 0.75
"""Points for a pixel of the picture: a picture on one sheet is never larger."""
MOST_SHEETS = 400

Rect = tuple[float, float, float, float]
"""Left, top, width, height."""


@dataclass(frozen=True)
class Printed:
    """One sheet: the part of the picture on it (pixels), where that lies in the room of the sheet
    (points), and the words below it."""

    source: Rect
    target: Rect
    words: str = ""


def on_one_sheet(size: tuple[float, float], room: tuple[float, float]) -> list[list[Printed]]:
    """Return a picture in the middle of one sheet, as large as it fits but not enlarged.

    ``size`` is that of the picture (pixels), ``room`` that of the sheet inside its margins.
    """
    scale = min(room[0] / size[0], room[1] / size[1], NATURAL)
    wide, high = size[0] * scale, size[1] * scale
    left, top = (room[0] - wide) / 2, (room[1] - high) / 2
    return [[Printed((0.0, 0.0, *size), (left, top, wide, high))]]


def poster(
    size: tuple[float, float], room: tuple[float, float], across: int
) -> list[list[Printed]]:
    """Return the rows of sheets of a poster that is ``across`` sheets wide.

    Neighbouring sheets overlap. UsageError if there would be more than ``MOST_SHEETS``.
    """
    wide, high = room[0], room[1] - FOOT
    scale = (across * wide - (across - 1) * OVERLAP) / size[0]
    # A sheet may be left out if it would have no more than a rounding error of the picture.
    down = max(ceil(floor(size[1] * scale - OVERLAP) / (high - OVERLAP)), 1)
    if across * down > MOST_SHEETS:
        raise UsageError(
            f"the poster would have {across * down:,} sheets, and {MOST_SHEETS} are the most",
            advice="Choose fewer sheets across, or larger paper.",
        )
    rows = []
    for row in range(down):
        top = row * (high - OVERLAP) / scale
        tall = min(high / scale, size[1] - top)
        sheets = []
        for column in range(across):
            left = column * (wide - OVERLAP) / scale
            broad = min(wide / scale, size[0] - left)
            words = f"Row {row + 1} of {down}, sheet {column + 1} of {across}"
            target = (0.0, 0.0, broad * scale, tall * scale)
            sheets.append(Printed((left, top, broad, tall), target, words))
        rows.append(sheets)
    return rows
