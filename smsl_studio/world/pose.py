"""Checks of positions, orientations and amounts that come from library code."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from smsl_studio.errors import WorldError

FARTHEST = 1000.0
"""The largest distance (m) of a body from the origin. Farther away its motion is not exact."""

LOOSE = 0.01
"""The largest difference between the length of a quaternion and 1."""


def check_position(name: str, position: Sequence[float]) -> None:
    """Raise WorldError if a position is not three finite lengths (m) up to ``FARTHEST``."""
    if not _are_numbers(position, 3):
        raise WorldError(f"{name!r} cannot stand at {position!r}: it takes x, y and z in metres")
    if any(abs(value) > FARTHEST for value in position):
        raise WorldError(
            f"{name!r} cannot stand at {position!r}: that is more than {FARTHEST:g} m away",
            advice="Positions are in metres.",
        )


def check_orientation(name: str, orientation: Sequence[float]) -> None:
    """Raise WorldError if an orientation is no quaternion of length 1."""
    if not _are_numbers(orientation, 4) or abs(math.hypot(*orientation) - 1.0) > LOOSE:
        raise WorldError(
            f"{name!r} cannot be turned by {orientation!r}: it takes a quaternion x, y, z, w "
            "of length 1"
        )


def check_amounts(name: str, what: str, values: Iterable[float], least: float = -math.inf) -> None:
    """Raise WorldError if a value is no finite number or below ``least``. ``what`` names the
    values in the message."""
    for value in values:
        if not _is_number(value) or value < least:
            raise WorldError(f"{what} of {name!r} cannot be {value!r}")


def _are_numbers(values: object, count: int) -> bool:
    try:
        found = list(values)  # type: ignore[call-overload]
    except TypeError:
        return False
    return len(found) == count and all(_is_number(value) for value in found)


def _is_number(value: object) -> bool:
    try:
        return math.isfinite(value)  # type: ignore[arg-type]
    except (TypeError, OverflowError):
        return False
