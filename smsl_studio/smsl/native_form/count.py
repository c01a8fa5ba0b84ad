"""Counts the names and values of a native text before anything is made of them."""

from __future__ import annotations

import re

from smsl_studio.smsl.document.limits import MAX_CHARACTERS, most_values
from smsl_studio.smsl.native_form.tokens import QUOTED

_MARKS = re.compile(rf"(->|[\[{{])|#([^\r\n]*+)|{QUOTED}|//[^\r\n]*+")
_IN_A_LINE = re.compile(rf"[,{{\[(]|{QUOTED}")


def beyond_budget(text: str) -> int | None:
    """Return the offset at which a text exceeds the limits, None if it does not.

    It is 0 for a text that is too long.

    Each operation has an arrow, each state and SB a bracket, each line a ``#``. In a line, a comma
    or a bracket is before every value of a map or list.
    """
    if len(text) > MAX_CHARACTERS:
        return 0
    most = most_values(text)
    if sum(map(text.count, ("->", "[", "{", "#", ",", "("))) <= most:
        return None
    count = 0
    for found in _MARKS.finditer(text):
        if found[1]:
            count += 1
        elif found[2] is not None:
            count += 1
            if count + sum(map(found[2].count, ",{[(")) > most:
                for inner in _IN_A_LINE.finditer(text, *found.span(2)):
                    count += inner[0][0] != '"'
                    if count > most:
                        return inner.start()
            else:
                count += sum(1 for one in _IN_A_LINE.finditer(found[2]) if one[0][0] != '"')
        if count > most:
            return found.start()
    return None
