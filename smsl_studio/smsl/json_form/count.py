"""How many names and values a JSON text holds, counted before anything is made of them."""

from __future__ import annotations

import re
from itertools import islice

from smsl_studio.smsl.document.limits import MAX_CHARACTERS, most_values

_MARKS = re.compile(r'[,{\[]|"[^"\\]*+(?:\\.[^"\\]*+)*+"', re.DOTALL)


def beyond_budget(text: str) -> int | None:
    """The offset at which a text holds more than it may; None where it does not.

    A text that is too long is beyond it from its beginning.

    Every member and element has a comma before it, or the bracket that it is the first in. Commas
    and brackets in texts are left out where it depends on them.
    """
    if len(text) > MAX_CHARACTERS:
        return 0
    most = most_values(text)
    if sum(map(text.count, ",{[")) <= most:
        return None
    marks = (found.start() for found in _MARKS.finditer(text) if found[0][0] != '"')
    return next(islice(marks, most, None), None)
