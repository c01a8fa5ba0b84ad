"""Where the names of things stand in the picture of a world: each close to its thing, none over
another."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF

HIGH, GAP, STEP = 18.0, 8.0, 20.0
"""The height of a name, its distance from the foot of its thing, and how far it is moved at once
(pixels)."""
SMALL = 60.0
"""A thing that covers less (pixels) in both directions is not covered by a name."""

EVERYWHERE = QRectF(-1e6, -1e6, 2e6, 2e6)

RINGS = 12
"""How many distances from the usual place are tried."""


def free_place(
    foot: tuple[float, float], width: float, taken: Sequence[QRectF], room: QRectF = EVERYWHERE
) -> QRectF:
    """Return the place of a name of this width: below the foot of its thing if that is free and in
    the ``room`` of the picture, else the nearest such one. Where very many names meet it stands
    over another."""
    usual = QRectF(foot[0] - width / 2, foot[1] + GAP, width, HIGH)
    for number in range(RINGS):
        for right, down in _ring(number, width):
            place = usual.translated(right, down)
            if room.contains(place) and not any(place.intersects(other) for other in taken):
                return place
    return usual


def is_aside(place: QRectF, foot: tuple[float, float]) -> bool:
    """Whether a name stands elsewhere than below the foot of its thing."""
    return abs(place.center().x() - foot[0]) > 1.0 or abs(place.top() - foot[1] - GAP) > 1.0


def _ring(number: int, width: float) -> list[tuple[float, float]]:
    """Return the ways (pixels) to places that are about ``number`` steps away, best first."""
    if number == 0:
        return [(0.0, 0.0)]
    aside = width / 2 + GAP + (number - 1) * STEP
    up, down = -(HIGH + 2 * GAP) - number * STEP, number * STEP
    return [(aside, -HIGH), (-aside, -HIGH), (0.0, down), (0.0, up), (aside, up), (-aside, up)]
