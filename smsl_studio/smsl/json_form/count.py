"""Counts the names and values of a JSON text before any are made."""

from __future__ import annotations

import re
from itertools import islice

from smsl_studio.smsl.document.limits import MAX_CHARACTERS, most_values

_MARKS = re.compile(r'[,{\[]|"[^"\\]*+(?:\\.[^"\\]*+)*+"', re.DOTALL)


def beyond_budget(text: str) -> int | None:
    """Return the offset at which a text exceeds the limits, None if it does not.

    A text that is too long exceeds them at its beginning. Every member and element has a comma
    before it, or the opening bracket if it is the first. Commas and brackets inside texts are left
    out if they matter.
    """
    if len(text) > MAX_CHARACTERS:
        return 0
    most = most_values(text)
    if sum(map(text.count, ",{[")) <= most:
        return None
    marks = (found.start() for found in _MARKS.finditer(text) if found[0][0] != '"')
    return next(islice(marks, most, None), None)
