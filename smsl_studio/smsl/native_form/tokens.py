"""The tokens of the native form, as regular expressions without backtracking (so: linear time).

A line ends with CR, LF or both. Between tokens are white space, comments and, in most places,
commas. Commas have no meaning: they can be left out or doubled.

What may begin in two ways is repeated in an atomic group, ``(?>(?:a|b)+)``, and not possessively,
``(?:a|b)++``: before Python 3.11.5 a possessive repeat keeps a part of what it tried in vain
(python/cpython#106052).
"""

from __future__ import annotations

import json
import re

BARE = r'(?>(?:[^\s{}\[\]:,#/"()>\-]++|-(?!>))+)'
QUOTED = r'"[^"\\\r\n]*+(?:\\[^\r\n][^"\\\r\n]*+)*+"'
NAME = rf"(?:{BARE}|{QUOTED})"
GAP = r"\s*+(?://[^\r\n]*+\s*+)*+"
SEPARATOR = r"[\s,]*+(?://[^\r\n]*+[\s,]*+)*+"
EDGE = rf"{NAME}{GAP}->{GAP}{NAME}"

name = re.compile(NAME)
bare = re.compile(BARE)
quoted = re.compile(QUOTED)
gap = re.compile(GAP)
separator = re.compile(SEPARATOR)
edge = re.compile(rf"({NAME}){GAP}->{GAP}({NAME})")
edges = re.compile(rf"{SEPARATOR}({NAME}){GAP}->{GAP}({NAME})")
state = re.compile(rf"({NAME}){GAP}:{GAP}\[((?>(?:{SEPARATOR}{EDGE})*)){SEPARATOR}\]")
"""A whole state with edges only. Group 2 ends with its last edge."""
opening = re.compile(rf"({NAME}){GAP}:{GAP}\[")
rest_of_line = re.compile(r"[^\r\n]*+")

NEEDS_QUOTES = 'A name with spaces or any of {}[]:,#/"()> is written in quotes.'
"""The advice for a name that needs quotes."""

NO_TEXT = (
    "what stands in the quotes is no text in JSON",
    r"Write a backslash as \\, a tab as \t, and no half surrogate pairs.",
)
"""The sentence and the advice for a name or text that ``decoded`` refuses."""

_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")


def skip_gap(text: str, at: int) -> int:
    """Return the offset after white space and comments."""
    match = gap.match(text, at)
    return match.end() if match else at


def skip_separator(text: str, at: int) -> int:
    """Return the offset after white space, comments and commas."""
    match = separator.match(text, at)
    return match.end() if match else at


def content_start(text: str) -> int:
    """Return the offset of the first character that is neither BOM nor white space."""
    start = 1 if text.startswith("\ufeff") else 0
    return start + len(text[start:]) - len(text[start:].lstrip())


def decoded(raw: str) -> str:
    """Return the name of a token. ValueError if its quotes contain an invalid JSON text."""
    if not raw.startswith('"'):
        return raw
    if "\\" not in raw and raw.isprintable():
        return raw[1:-1]
    found: str = json.loads(raw)
    if _SURROGATE.search(raw):
        found.encode("utf-8")
    return found


def is_bare(name: str) -> bool:
    """Return whether a name needs no quotes."""
    return bare.fullmatch(name) is not None and not name.startswith("\ufeff")


def spelled(name: str) -> str:
    """Return a name as it is written: without quotes if possible."""
    return name if is_bare(name) else json.dumps(name, ensure_ascii=False)
