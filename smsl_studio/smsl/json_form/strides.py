"""Fast questions about a faulty JSON text, without reading every token."""

from __future__ import annotations

import json
import re

from smsl_studio.smsl.json_form.tokens import JsonTokens

BALANCE = {"{": -1, "[": -1, "}": 1, "]": 1}

_PIECE = (
    r'"[^"\\\r\n]*+(?:\\[^\r\n][^"\\\r\n]*+)*+"'
    r"|'[^'\r\n]*'|(?://|#)[^\r\n]*|/\*.*?(?:\*/|\Z)"
)
_PIECES = re.compile(_PIECE, re.DOTALL)
_TO_A_LOST_QUOTE = re.compile(rf"(?>(?:[^\"'/#]++|{_PIECE}|['/])*)\"", re.DOTALL)
"""Matches up to the first quote that is not closed. The result is for the whole text, so that not
every later quote is tried.
"""
_BRACKET = re.compile(r"[{}\[\]]")
_NAME, _GAP = r'"[^"\\\x00-\x1f\ud800-\udfff]*"', r"[ \t\r\n]*"
_MEMBER = rf"{_NAME}{_GAP}:{_GAP}{_NAME}{_GAP}"
_FLAT = re.compile(rf"\{{{_GAP}(?:{_MEMBER}(?:,{_GAP}{_MEMBER})*)?\}}")


def balance_of(text: str) -> int:
    """Return how many more closing than opening brackets a text has, outside of texts."""
    if _TO_A_LOST_QUOTE.match(text) is None:
        return _balance(_PIECES.sub("", text))
    return sum(map(_line_balance, text.split("\n")))


def _line_balance(line: str) -> int:
    """Return the balance of one line. If a quote is missing in it, its tokens are read."""
    if _BRACKET.search(line) is None:
        return 0
    if _TO_A_LOST_QUOTE.match(line) is None:
        return _balance(_PIECES.sub("", line))
    tokens, total = JsonTokens(line, lambda _: None), 0
    while (token := tokens.take()).kind != "end":
        total += BALANCE.get(token.kind, 0)
    return total


def _balance(bare: str) -> int:
    return sum(bare.count(mark) * weight for mark, weight in BALANCE.items())


def flat_object(text: str, at: int) -> tuple[dict[str, str], int, int] | None:
    """Return the object at ``at`` if it is complete and has nothing but names, as nearly all states
    do.

    The result is its value, its end, and the indentation of its last brace (-1 if that is not the
    first on its line). None for any other text.
    """
    found = _FLAT.match(text, at)
    if found is None:
        return None
    end = found.end()
    line = text.rfind("\n", at, end) + 1
    blanks = text[line : end - 1] if line else "x"
    return json.loads(found[0]), end, -1 if blanks.strip(" \t") else len(blanks)
