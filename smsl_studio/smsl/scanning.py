"""Where things stand in a JSON text that is known to be valid.

One object is walked at a time, and the C scanner jumps over each value, so that finding one element
in a megabyte costs milliseconds, and nothing is spent on the rest.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import NamedTuple

STRING = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL)
_SPACE = re.compile(r"[ \t\n\r]*")
_SCALAR = re.compile(r"[^ \t\n\r,\]}]+")
_SKIP = json.JSONDecoder()


class Member(NamedTuple):
    """One ``key: value`` of an object, as offsets into the text (ends are exclusive)."""

    key: str
    key_start: int
    key_end: int
    value_start: int
    value_end: int


def skip_space(text: str, at: int) -> int:
    """The offset of the first character that is no white space."""
    match = _SPACE.match(text, at)
    return match.end() if match else at


def scan_container(text: str, start: int) -> Iterator[Member]:
    """The members of the object or list that opens at ``start`` in a text known to be valid JSON.

    The elements of a list have their index for a key, which takes no room in the text.
    """
    mark = text[start : start + 1]
    if mark not in ("{", "["):
        raise KeyError(start)
    at = skip_space(text, start + 1)
    if mark == "[":
        yield from _elements(text, at)
        return
    while text[at] != "}":
        key, key_end = json.decoder.scanstring(text, at + 1)  # type: ignore[attr-defined]
        value = skip_space(text, skip_space(text, key_end) + 1)
        end = _value_end(text, value)
        yield Member(key, at, key_end, value, end)
        at = skip_space(text, end)
        if text[at] == ",":
            at = skip_space(text, at + 1)


def _elements(text: str, at: int) -> Iterator[Member]:
    index = 0
    while text[at] != "]":
        end = _value_end(text, at)
        yield Member(str(index), at, at, at, end)
        index += 1
        at = skip_space(text, end)
        if text[at] == ",":
            at = skip_space(text, at + 1)


def _value_end(text: str, at: int) -> int:
    char = text[at]
    if char in "{[":
        return _SKIP.raw_decode(text, at)[1]
    match = (STRING if char == '"' else _SCALAR).match(text, at)
    assert match is not None, "the text was parsed before it is scanned"
    return match.end()
