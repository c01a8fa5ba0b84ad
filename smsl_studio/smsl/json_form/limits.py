"""How much one JSON file may ask for, so that none exhausts memory or stack."""

from __future__ import annotations

from math import isfinite

MAX_CHARACTERS = 64 * 1024 * 1024
MAX_DEPTH = 64
MAX_DIGITS = 4000
MAX_FAULTS = 100
"""So many faults of one text are told; nobody repairs more in one go."""
MAX_REMOVED = 2000
"""A text with so many pieces that belong nowhere is no JSON, and is not read to its end."""


def too_large(number: str) -> bool:
    """Whether a number has more digits, or a larger exponent, than there is room for."""
    if number.lstrip("-").isdecimal():
        return len(number) > MAX_DIGITS
    return len(number) > MAX_DIGITS or not isfinite(float(number))
