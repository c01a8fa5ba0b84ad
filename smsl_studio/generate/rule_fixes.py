"""Repairs of a text of rules: one wrong word is replaced."""

from __future__ import annotations

import re

from smsl_studio.errors import TextFix

_FAR = 400
"""A wrong word is looked for in so many characters."""


def word_fix(text: str, at: int, wrong: str, right: str) -> TextFix | None:
    """Return the repair that writes ``right`` for the first ``wrong`` from offset ``at`` on. None
    if there is none near, or if the right word would need other quotes."""
    if not wrong or not right or not right.isprintable() or set(right) & set("\"'\\"):
        return None
    part = text[at : at + _FAR]
    found = re.search(rf"(?<![\w-]){re.escape(wrong)}(?![\w-])", part)
    plain = re.fullmatch(r"[\w-]+", right)
    if found is None or (not plain and part[found.start() - 1 : found.start()] not in ("'", '"')):
        return None
    begin = at + found.start()
    return TextFix(f"Write “{right}”", begin, begin + len(wrong), right)
