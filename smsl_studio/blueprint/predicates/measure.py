"""Numbers of sources as samples carry them: a text, such as ``0.25``, or three of them for a
position."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import isfinite

GOOD, UNCERTAIN, BAD = QUALITIES = ("good", "uncertain", "bad")
"""The quality that a source gives to its own reading. Only a good reading is evidence."""

Measure = float | tuple[float, float, float]

_NUMBER = r"-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
_SIGNS = "0123456789.-+eE"
"""All characters of a number. ``float`` takes more, such as spaces, ``_`` and ``inf``."""
_THREE = re.compile(rf"({_NUMBER}) ({_NUMBER}) ({_NUMBER})", re.ASCII)
LONGEST = 100
"""The largest length of a measure, in characters."""
_SHOWN = 24


def measure_text(value: object, scale: float = 1.0) -> str | None:
    """Return a number, or a position of three, times ``scale`` as a sample carries it. None if it
    is neither.

    The text has the same double again when it is read. A number that is not finite is none.
    """
    if isinstance(value, Sequence) and not isinstance(value, str):
        texts = [measure_text(one, scale) for one in value] if len(value) == 3 else [None]
        # A position inside a position would have spaces in it.
        return (
            None if any(one is None or " " in one for one in texts) else " ".join(map(str, texts))
        )
    if type(value) is int and abs(value) < 2**53:
        value = float(value)
    if not isinstance(value, float) or not isfinite(value * scale):
        return None
    return repr(float(value) * scale)


def measure_of(text: str, position: bool | None) -> Measure | str:
    """Return the number in a sample, or the position. A text is the reason why there is none.

    ``position`` says which of the two is wanted; None takes both.
    """
    short = len(text) <= LONGEST
    if short and not position and not text.strip(_SIGNS) and text[:1] != "+":
        try:
            number = float(text)
        except ValueError:
            pass
        else:
            return number if isfinite(number) else f"{_shown(text)} is too large"
    shown = _shown(text)
    three = _THREE.fullmatch(text) if short and position is not False else None
    if three is None:
        wanted = "which are no three numbers" if position else "which is no number"
        return f"it says {shown!r}, {wanted}"
    x, y, z = (float(one) for one in three.groups())
    return (x, y, z) if all(map(isfinite, (x, y, z))) else f"{shown} is too large"


def _shown(text: str) -> str:
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."
