"""The places in a JSON text that is known to be valid.

One object is scanned at a time, and the C scanner skips its values. So finding one element in a
megabyte takes milliseconds.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from itertools import accumulate, count, islice
from types import MappingProxyType
from typing import NamedTuple

from smsl_studio.smsl.document import Member, Path

STRING = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL)
_SPACE = re.compile(r"[ \t\n\r]*")
_SCALAR = re.compile(r"[^ \t\n\r,\]}]+")
_SKIP = json.JSONDecoder()


def skip_space(text: str, at: int) -> int:
    """Return the offset of the first character that is no white space."""
    match = _SPACE.match(text, at)
    return match.end() if match else at


class SpanPart(NamedTuple):
    """One member as four lengths: the text before its key, the key, the text between key and value,
    and the value.
    """

    before: int
    key: int
    middle: int
    value: int


LONG = 4096
"""A shorter row is found again quickly, so it is not kept for the next text."""


class MemberRow:
    """The members of one object or list as lengths, so that the row is valid wherever the object
    is.

    A row never changes. After an edit the new text gets new rows for the changed objects.
    """

    def __init__(self, keys: list[str], parts: list[SpanPart], lengths: list[int]) -> None:
        self.keys, self.parts, self.lengths = keys, parts, lengths

    @classmethod
    def of(cls, members: Iterable[Member], start: int) -> MemberRow:
        """Return the row of the members of the object or list that opens at ``start``."""
        keys, parts, lengths, at = [], [], [], start + 1
        for key, key_start, key_end, value_start, value_end in members:
            keys.append(key)
            parts.append(
                SpanPart(key_start - at, key_end - key_start, value_start - key_end,
                     value_end - value_start)
            )  # fmt: skip
            lengths.append(value_end - at)
            at = value_end
        return cls(keys, parts, lengths)

    def __len__(self) -> int:
        return len(self.keys)

    @property
    def is_long(self) -> bool:
        """Whether the row is long enough to be kept for the next text."""
        return sum(self.lengths) >= LONG

    @cached_property
    def _offsets(self) -> list[int]:
        """For each member the end of the one before it, from the opening bracket. The last entry is
        the end of the last member.
        """
        return list(accumulate(self.lengths, initial=1))

    @cached_property
    def _last(self) -> dict[str, int]:
        """The index of each key, the last index of a doubled key."""
        return dict(zip(self.keys, count(), strict=False))

    def index(self, key: str) -> int:
        """Return the index of the last member with this key. KeyError if there is none."""
        return self._last[key]

    def end(self, start: int) -> int:
        """Return the offset after the last member, or after the bracket that opens at ``start``."""
        return start + self._offsets[-1]

    def member(self, index: int, start: int) -> Member:
        """Return one member of the object or list that opens at ``start``."""
        before, key, middle, value = self.parts[index]
        at = start + self._offsets[index] + before
        value_start = at + key + middle
        return Member(self.keys[index], at, at + key, value_start, value_start + value)

    def members(self, start: int) -> tuple[Member, ...]:
        """Return all members of the object or list that opens at ``start``."""
        return tuple(self.member(index, start) for index in range(len(self.keys)))


NO_ROWS: Mapping[Path, MemberRow] = MappingProxyType({})


class JsonSpans:
    """The places in one valid JSON text. Each object is scanned when it is first asked for.

    ``rows`` are the rows that are known already, by their paths.
    """

    def __init__(self, text: str, rows: Mapping[Path, MemberRow] = NO_ROWS) -> None:
        self._text = text
        self._rows = dict(rows)
        self._starts: dict[Path, int] = {}

    @cached_property
    def root(self) -> int:
        """The offset at which the file's object opens."""
        return skip_space(self._text, 1 if self._text.startswith("\ufeff") else 0)

    @property
    def long_rows(self) -> dict[Path, MemberRow]:
        """The long rows that are known so far, by their paths."""
        return {path: row for path, row in self._rows.items() if row.is_long}

    def members(self, path: Path) -> tuple[Member, ...]:
        """Return the members at a path (see ``Spans``)."""
        start = self._start(path)
        return self.row(path, start).members(start)

    def member(self, path: Path) -> Member:
        """See ``Spans``. The others of its object are not made for it."""
        start = self._start(path[:-1])
        row = self.row(path[:-1], start)
        return row.member(row.index(path[-1]), start)

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """Yield the doubled keys (see ``Spans``)."""
        return self._doubles((), self.root)

    def row(self, path: Path, start: int) -> MemberRow:
        """Return the row of the object or list at ``path``, which opens at offset ``start``.

        The key of a list element is its index. It has no length. KeyError if no object or list
        opens there.
        """
        found = self._rows.get(path)
        if found is None:
            found = self._rows[path] = MemberRow.of(scan_container(self._text, start), start)
        return found

    def first(self, path: Path, start: int, most: int) -> list[Member]:
        """Return the first members, at most ``most``, of the object or list that opens at
        ``start``.
        """
        row = self._rows.get(path)
        if row is None:
            return list(islice(scan_container(self._text, start), most))
        return [row.member(index, start) for index in range(min(most, len(row)))]

    def end_of(self, row: MemberRow, start: int) -> int:
        """Return the offset after the object or list with this row that opens at ``start``."""
        return skip_space(self._text, row.end(start)) + 1

    def _start(self, path: Path) -> int:
        if not path:
            return self.root
        start = self._starts.get(path)
        if start is None:
            above = path[:-1]
            at = self._start(above)
            row = self.row(above, at)
            start = self._starts[path] = row.member(row.index(path[-1]), at).value_start
        return start

    def _doubles(self, path: Path, start: int) -> Iterator[tuple[Path, tuple[int, ...]]]:
        members = tuple(scan_container(self._text, start))
        places: dict[str, list[int]] = {}
        for member in members:
            places.setdefault(member.key, []).append(member.key_start)
        for key, found in places.items():
            if len(found) > 1:
                yield (*path, key), tuple(found)
        for member in members:
            if self._text[member.value_start] in "{[":
                yield from self._doubles((*path, member.key), member.value_start)


def scan_container(text: str, start: int) -> Iterator[Member]:
    """Yield the members of the object or list that opens at ``start`` in a valid JSON text.

    The key of a list element is its index. It has no length in the text. KeyError if nothing opens
    there.
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
