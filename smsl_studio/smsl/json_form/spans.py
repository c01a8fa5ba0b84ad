"""Where things stand in a JSON text that is known to be valid.

One object is walked at a time, and the C scanner jumps over each value, so that finding one element
in a megabyte costs milliseconds, and nothing is spent on the rest.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cached_property

from smsl_studio.smsl.document import Member, Path

STRING = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL)
_SPACE = re.compile(r"[ \t\n\r]*")
_SCALAR = re.compile(r"[^ \t\n\r,\]}]+")
_SKIP = json.JSONDecoder()


def skip_space(text: str, at: int) -> int:
    """The offset of the first character that is no white space."""
    match = _SPACE.match(text, at)
    return match.end() if match else at


class JsonSpans:
    """The spans of one valid JSON text, object by object as they are asked for."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._scanned: dict[int, tuple[Member, ...]] = {}
        self._latest: dict[int, dict[str, Member]] = {}

    @cached_property
    def root(self) -> int:
        """The offset at which the file's object opens."""
        return skip_space(self._text, 1 if self._text.startswith("\ufeff") else 0)

    def members(self, path: Path) -> tuple[Member, ...]:
        """See ``Spans``."""
        start = self.root
        for key in path:
            start = self._last(start, key).value_start
        return self.scan(start)

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """See ``Spans``."""
        return self._doubles((), self.root)

    def scan(self, start: int) -> tuple[Member, ...]:
        """The members of the object or list that opens at offset ``start``, doubles included.

        The elements of a list are members whose key is their index and takes no room. KeyError
        where neither opens.
        """
        if start not in self._scanned:
            self._scanned[start] = tuple(scan_container(self._text, start))
        return self._scanned[start]

    def end_of(self, start: int) -> int:
        """The offset behind the object or list that opens at ``start``."""
        members = self.scan(start)
        return skip_space(self._text, members[-1].value_end if members else start + 1) + 1

    def _last(self, start: int, key: str) -> Member:
        if start not in self._latest:
            self._latest[start] = {member.key: member for member in self.scan(start)}
        return self._latest[start][key]

    def _doubles(self, path: Path, start: int) -> Iterator[tuple[Path, tuple[int, ...]]]:
        places: dict[str, list[int]] = {}
        for member in self.scan(start):
            places.setdefault(member.key, []).append(member.key_start)
        for key, found in places.items():
            if len(found) > 1:
                yield (*path, key), tuple(found)
        for member in self.scan(start):
            if self._text[member.value_start] in "{[":
                yield from self._doubles((*path, member.key), member.value_start)


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
