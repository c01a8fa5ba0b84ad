"""The tokens of the native form, as regular expressions that never go back (so: linear time).

A line ends with CR, LF or both. Between tokens stand white space, comments and, in most places,
commas, which part nothing and may be left out or doubled.
"""

from __future__ import annotations

import json
import re

BARE = r'(?:[^\s{}\[\]:,#/"()>\-]|-(?!>))++'
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
state = re.compile(rf"({NAME}){GAP}:{GAP}\[((?:{SEPARATOR}{EDGE})*+){SEPARATOR}\]")
"""A whole state that holds nothing but edges; group 2 ends with its last edge."""
opening = re.compile(rf"({NAME}){GAP}:{GAP}\[")
rest_of_line = re.compile(r"[^\r\n]*+")

NEEDS_QUOTES = 'A name with spaces or any of {}[]:,#/"()> is written in quotes.'
"""What is advised where a name has none."""

NO_TEXT = (
    "what stands in the quotes is no text in JSON",
    r"Write a backslash as \\, a tab as \t, and no half surrogate pairs.",
)
"""What is told of a name or text that ``decoded`` refuses, and what to do."""

_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")


def skip_gap(text: str, at: int) -> int:
    """The offset behind white space and comments."""
    match = gap.match(text, at)
    return match.end() if match else at


def skip_separator(text: str, at: int) -> int:
    """The offset behind white space, comments and commas."""
    match = separator.match(text, at)
    return match.end() if match else at


def content_start(text: str) -> int:
    """The offset of the first character that is neither BOM nor white space."""
    start = 1 if text.startswith("\ufeff") else 0
    return start + len(text[start:]) - len(text[start:].lstrip())


def decoded(raw: str) -> str:
    """The name a token spells; ValueError where its quotes hold what is no text in JSON."""
    if not raw.startswith('"'):
        return raw
    if "\\" not in raw and raw.isprintable():
        return raw[1:-1]
    found: str = json.loads(raw)
    if _SURROGATE.search(raw):
        found.encode("utf-8")
    return found


def is_bare(name: str) -> bool:
    """Whether a name needs no quotes."""
    return bare.fullmatch(name) is not None and not name.startswith("\ufeff")


def spelled(name: str) -> str:
    """A name as it is written: bare where that is possible, else in quotes."""
    return name if is_bare(name) else json.dumps(name, ensure_ascii=False)
