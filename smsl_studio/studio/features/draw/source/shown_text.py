"""How a piece of an exact text is shown in a text widget, and how positions are counted there.

A widget cannot show everything: a BOM has no place in it, CRLF is one line end, a lone CR, U+2028
and some others would break lines that are none. Each of these is shown as one stand-in character,
so that what is shown can always be traced back to what stands there.
"""

from __future__ import annotations

import re
from functools import cache

BOM = "\ufeff"
CR_SHOWN, ODD_SHOWN = "\u240d", "\ufffd"
_ODD = "\u2028\u2029\x00\x0b\x0c\x1c-\x1e\x85\ufdd0\ufdd1\ufffc"


@cache
def _pattern(characters: str) -> re.Pattern[str]:
    """Any of these characters; compiled when it is first needed, because that takes its time."""
    return re.compile(f"[{characters}]")


def shown(text: str, first: bool = False) -> str:
    """The text as it is shown; ``first`` where it begins the file, so that it may have a BOM."""
    if not _pattern(f"\r{BOM}{_ODD}").search(text):
        return text
    if first:
        text = text.removeprefix(BOM)
    return _pattern(_ODD).sub(ODD_SHOWN, text.replace("\r\n", "\n").replace("\r", CR_SHOWN))


def exact_column(line: str, column: int, first: bool = False) -> int:
    """The offset in one exact line of a column of what is shown of it."""
    return column + 1 if first and line.startswith(BOM) else column


def shown_column(line: str, offset: int, first: bool = False) -> int:
    """The column, in what is shown of a line, of an offset in the exact line."""
    ends = 2 if line.endswith("\r\n") else 1 if line.endswith("\n") else 0
    offset = min(offset, len(line) - ends)
    return max(0, offset - 1) if first and line.startswith(BOM) else offset


def units(text: str) -> int:
    """The length of a text as Qt counts it, in UTF-16 units."""
    if text.isascii():
        return len(text)
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


def from_units(text: str, count: int) -> int:
    """How many characters of a text the first ``count`` UTF-16 units are."""
    if text.isascii():
        return min(count, len(text))
    head = text.encode("utf-16-le", "surrogatepass")[: count * 2]
    return len(head.decode("utf-16-le", "replace"))
