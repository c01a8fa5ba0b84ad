"""Counts in conditions of rules: ``count(FACT, FACT = VALUE) OP N``.

They are found outside of quotes, in one pass from left to right. A condition may come from
anywhere.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple, NoReturn

from smsl_studio.errors import FormulaError
from smsl_studio.stop import heed

_MOST_DIGITS = 6
_QUOTED = r"""'(?:[^']|'')*'|"(?:[^"]|"")*\""""
_BARE = r"""[^\s{}\[\]:,\#/"()<>'=!]+"""
_WORD = re.compile(rf"(?P<quoted>{_QUOTED})|(?P<bare>{_BARE})|.", re.DOTALL)
_PART = re.compile(
    rf"\s*(?:(?P<quoted>{_QUOTED})|(?P<bare>{_BARE})|(?P<sign><=|>=|!=|[=<>,()]))", re.DOTALL
)
_SIGNS = frozenset(("=", "!=", "<", "<=", ">", ">="))
_STAND_IN = "count = 1"


class Count(NamedTuple):
    """One count. A fact is its digit or its name. ``sign`` compares the sum with ``number``."""

    facts: tuple[int | str, ...]
    value: str
    sign: str
    number: int


def without_counts(text: str) -> tuple[str, Mapping[int, Count]]:
    """Return a condition with a term of equal length in place of each count, and the counts by
    their offsets.

    A term belongs to a count if it begins at the count's offset, whatever its words are.
    FormulaError if a count cannot be read.
    """
    parts: list[str] = []
    counts: dict[int, Count] = {}
    at = 0
    while at < len(text):
        heed()
        found = _WORD.match(text, at)
        assert found is not None, "any character is a word"
        end = found.end()
        if found["bare"] == "count" and text.startswith("(", end):
            reader = _CountReader(text, at, end + 1)
            counts[at] = reader.count()
            end = reader.end
            parts.append(_STAND_IN.ljust(end - at))
        else:
            parts.append(found[0])
        at = end
    return "".join(parts), counts


class _CountReader:
    """Reads one count from its bracket on. ``end`` is the offset behind what is read."""

    def __init__(self, text: str, begin: int, end: int) -> None:
        self._text, self._begin, self.end = text, begin, end

    def count(self) -> Count:
        """Read up to the number."""
        facts = [self._fact()]
        while (sign := self._take("sign")) == ",":
            facts.append(self._fact())
        if sign != "=":
            self._refuse()
        value = self._take("bare", "quoted")
        if self._take("sign") != ")":
            self._refuse()
        sign = self._take("sign")
        if sign not in _SIGNS:
            self._refuse()
        return Count(tuple(facts), _unquoted(value), sign, self._number(self._take("bare")))

    def _fact(self) -> int | str:
        heed()
        name = self._take("bare", "quoted")
        return self._number(name) if name.isascii() and name.isdecimal() else _unquoted(name)

    def _number(self, text: str) -> int:
        if not (text.isascii() and text.isdecimal() and len(text) <= _MOST_DIGITS):
            self._refuse()
        return int(text)

    def _take(self, *kinds: str) -> str:
        """Take the next part, which must be of one of these kinds."""
        found = _PART.match(self._text, self.end)
        if found is None or found.lastgroup not in kinds:
            self._refuse()
        self.end = found.end()
        return found[found.lastgroup]

    def _refuse(self) -> NoReturn:
        raise FormulaError(
            "a count cannot be read",
            self._begin,
            f"Write count(FACT, FACT = VALUE) OP N, with at most {_MOST_DIGITS} digits for a "
            "number. Other names than letters, digits, _ and - stand in quotes.",
        )


def _unquoted(text: str) -> str:
    sign = text[0]
    return text[1:-1].replace(sign * 2, sign) if sign in "'\"" else text
