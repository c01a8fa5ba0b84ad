"""How much one file may ask for, in any form, so that none exhausts memory or stack."""

from __future__ import annotations

from math import isfinite

MAX_CHARACTERS = 64 * 1024 * 1024
MAX_DEPTH = 64
MAX_DIGITS = 4000
MAX_FAULTS = 100
"""So many faults of one text are told; nobody repairs more in one go."""

TOO_DEEP = (
    f"nested deeper than {MAX_DEPTH} levels",
    "SMSL needs three levels and a few for annotations.",
)
"""What is told of it, and what to do."""


def too_long(most: int) -> tuple[str, str]:
    """What is told of a text of more than so many characters, and what to do."""
    words = f"the file is larger than {most >> 20} million characters"
    return words, "Split it into several files."


def too_large(number: str) -> bool:
    """Whether a number has more digits, or a larger exponent, than there is room for."""
    if number.lstrip("-").isdecimal():
        return len(number) > MAX_DIGITS
    return len(number) > MAX_DIGITS or not isfinite(float(number))
