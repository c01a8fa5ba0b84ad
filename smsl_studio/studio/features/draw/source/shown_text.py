"""How exact text is shown in a text widget, and how positions are converted.

A widget cannot show everything: it has no place for a BOM, shows CRLF as one line end, and would
break lines at a lone CR, U+2028 and some other characters. Each of these is shown as one other
character, so that shown positions can be converted to exact ones.
"""

from __future__ import annotations

import re
from functools import cache

BOM = "\ufeff"
CR_SHOWN, ODD_SHOWN = "\u240d", "\ufffd"
_ODD = "\u2028\u2029\x00\x0b\x0c\x1c-\x1e\x85\ufdd0\ufdd1\ufffc"


@cache
def _pattern(characters: str) -> re.Pattern[str]:
    """A pattern for any of these characters; compiled at first use, because that takes time."""
    return re.compile(f"[{characters}]")


def is_plain(text: str) -> bool:
    """Whether the text is shown as it is."""
    return not _pattern(f"\r{BOM}{_ODD}").search(text)


def shown(text: str, first: bool = False) -> str:
    """The text as it is shown. ``first``: it begins the file, so it may have a BOM."""
    if is_plain(text):
        return text
    if first:
        text = text.removeprefix(BOM)
    return _pattern(_ODD).sub(ODD_SHOWN, text.replace("\r\n", "\n").replace("\r", CR_SHOWN))


def exact_column(line: str, column: int, first: bool = False) -> int:
    """The offset in an exact line of a shown column."""
    return column + 1 if first and line.startswith(BOM) else column


def shown_column(line: str, offset: int, first: bool = False) -> int:
    """The shown column of an offset in an exact line."""
    ends = 2 if line.endswith("\r\n") else 1 if line.endswith("\n") else 0
    offset = min(offset, len(line) - ends)
    return max(0, offset - 1) if first and line.startswith(BOM) else offset


def units(text: str) -> int:
    """The length of a text as Qt counts it, in UTF-16 units."""
    if text.isascii():
        return len(text)
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


def from_units(text: str, count: int) -> int:
    """How many characters the first ``count`` UTF-16 units of a text are."""
    if text.isascii():
        return min(count, len(text))
    head = text.encode("utf-16-le", "surrogatepass")[: count * 2]
    return len(head.decode("utf-16-le", "replace"))
