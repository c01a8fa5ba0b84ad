"""Halves of surrogate pairs, which no file can hold."""

from __future__ import annotations

import re

HALF = re.compile("[\ud800-\udfff]")
"""A half as a character. Only a text that came from no file can have one."""

ESCAPED_HALF = re.compile(r"\\u[dD][89a-fA-F]")
HALF_PAIR = (
    "half a surrogate pair is no character",
    "Write the character itself, or both halves of the pair.",
)
"""The sentence and the advice."""

_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|.)", re.DOTALL)


def half_pair(text: str, start: int, end: int) -> int | None:
    """Return the offset of the first escaped surrogate that stands alone, None if there is none."""
    high: int | None = None
    for escape in _ESCAPE.finditer(text, start, end):
        code = int(escape[1], 16) if escape[1] else 0
        if high is not None:
            if not (0xDC00 <= code < 0xE000 and escape.start() == high + 6):
                return high
            high = None
        elif 0xD800 <= code < 0xDC00:
            high = escape.start()
        elif 0xDC00 <= code < 0xE000:
            return escape.start()
    return high
