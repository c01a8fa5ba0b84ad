"""Questions about a broken JSON text that need no look at every token."""

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
_TO_A_LOST_QUOTE = re.compile(rf"(?:[^\"'/#]++|{_PIECE}|['/])*+\"", re.DOTALL)
"""Up to the first quote that is not closed: asked once, it is not asked of every quote behind."""
_BRACKET = re.compile(r"[{}\[\]]")
_NAME, _GAP = r'"[^"\\\x00-\x1f\ud800-\udfff]*"', r"[ \t\r\n]*"
_MEMBER = rf"{_NAME}{_GAP}:{_GAP}{_NAME}{_GAP}"
_FLAT = re.compile(rf"\{{{_GAP}(?:{_MEMBER}(?:,{_GAP}{_MEMBER})*)?\}}")


def balance_of(text: str) -> int:
    """How many closing brackets a text has beyond the opening ones, outside of texts."""
    if _TO_A_LOST_QUOTE.match(text) is None:
        return _balance(_PIECES.sub("", text))
    return sum(map(_line_balance, text.split("\n")))


def _line_balance(line: str) -> int:
    """The balance of one line; where a quote is missing in it, token by token."""
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
    """The object at ``at`` if it is whole and holds nothing but names, as nearly all states do:
    its value, where it ends, and how far its last brace is indented (-1: not first on its line).
    """
    found = _FLAT.match(text, at)
    if found is None:
        return None
    end = found.end()
    line = text.rfind("\n", at, end) + 1
    blanks = text[line : end - 1] if line else "x"
    return json.loads(found[0]), end, -1 if blanks.strip(" \t") else len(blanks)
