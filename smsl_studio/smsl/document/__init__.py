"""What is written: a text, its values, and on demand the span of everything in it.

A Document knows spelling, not meaning. Its text is kept to the character (BOM, line ends, order,
indentation), so that writing back a document nobody edited gives the same bytes. Spans are worked
out when first asked for, by the form the text is written in, because most loads never ask.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple, Protocol

from smsl_studio.errors import Place, ReadError

Json = Any
Path = tuple[str, ...]
WORDS = {"json": "JSON", "smsl": "SMSL", "yaml": "YAML"}
"""What people call the forms."""

_LINE_END = re.compile("\r\n?|\n")


class Member(NamedTuple):
    """One key and its value, as offsets into the text (ends are exclusive).

    An element of a list has its index for a key, which takes no room.
    """

    key: str
    key_start: int
    key_end: int
    value_start: int
    value_end: int


class Spans(Protocol):
    """Where things stand in one text. Each form has its own, made for one valid text."""

    @property
    def root(self) -> int:
        """The offset at which the content begins."""

    def members(self, path: Path) -> tuple[Member, ...]:
        """The members of the map or list at ``path``, as written, doubles included.

        The path follows the values of the document; of a doubled key the last one counts.
        Raises KeyError where no map or list stands there.
        """

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """Every key written more than once in one map, with the offsets of all its places."""


@dataclass(frozen=True, eq=False)
class Document:
    """A text in one of the written forms, and the values it holds.

    ``values`` keeps the order of the keys; where a key is written twice the last one wins and
    ``doubled`` is true (see ``duplicates``). ``file`` is the name that messages show. ``form`` is
    the name of the form (``json``, ``smsl``, ``yaml``), ``spans_of`` finds where things stand.
    ``stands_in`` names the file in which this text was found, where that is not ``file``: the new
    text of a save that has not come to its end.
    """

    text: str
    file: str
    form: str
    values: Mapping[str, Json]
    spans_of: Callable[[str], Spans] = field(repr=False)
    doubled: bool = False
    stands_in: str = ""

    @cached_property
    def spans(self) -> Spans:
        """Where things stand; worked out now if nobody asked before."""
        return self.spans_of(self.text)

    @property
    def fields(self) -> dict[str, Json]:
        """The ``_`` fields of the file."""
        return {key: value for key, value in self.values.items() if key.startswith("_")}

    def members(self, path: Path = ()) -> tuple[Member, ...]:
        """The members of the map at ``path``, in order, doubles included.

        Raises KeyError where no map stands at ``path``.
        """
        return self.spans.members(path)

    def member(self, path: Path) -> Member:
        """The member at ``path`` (the last one, where its key is doubled); KeyError if none."""
        above = path[:-1]
        if above not in self._latest:
            self._latest[above] = {member.key: member for member in self.members(above)}
        return self._latest[above][path[-1]]

    def place(self, path: Path) -> Place:
        """Where the key at ``path`` stands, or the nearest one above it that exists."""
        while path:
            try:
                return self.place_at(self.member(path).key_start)
            except KeyError:
                path = path[:-1]
        return self.place_at(self.spans.root)

    def place_at(self, offset: int) -> Place:
        """Line and column of an offset; a BOM is no column."""
        starts = self._line_starts
        line = bisect_right(starts, offset) - 1
        column = offset - starts[line] + 1
        if line == 0 and self.text.startswith("\ufeff"):
            column = max(1, column - 1)
        return Place(self.file, line + 1, column)

    def duplicates(self) -> tuple[tuple[Path, tuple[Place, ...]], ...]:
        """Every key that is written more than once in one map, with all its places."""
        if not self.doubled:
            return ()
        return tuple(
            (path, tuple(map(self.place_at, offsets))) for path, offsets in self.spans.doubles()
        )

    def encoded(self) -> bytes:
        """The bytes of the file."""
        return self.text.encode("utf-8")

    @cached_property
    def newline(self) -> str:
        """The line end this text uses."""
        if "\r" not in self.text:
            return "\n"
        if "\r\n" in self.text:
            return "\r\n"
        return "\r" if "\n" not in self.text else "\n"

    @cached_property
    def _latest(self) -> dict[Path, dict[str, Member]]:
        """The members of every map that was asked about, by key: each map is read once."""
        return {}

    @cached_property
    def _line_starts(self) -> list[int]:
        return _line_starts(self.text)


def _line_starts(text: str) -> list[int]:
    """Where each line begins. A line ends with LF, CR or both."""
    if text.count("\r") != text.count("\r\n"):
        return [0, *(end.end() for end in _LINE_END.finditer(text))]
    starts, at = [0], text.find("\n")
    while at >= 0:
        starts.append(at + 1)
        at = text.find("\n", at + 1)
    return starts


def decode(raw: bytes, file: str) -> str:
    """The text of a file; ReadError with the place of the first byte that is no UTF-8."""
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode("utf-8").removeprefix("\ufeff")
        starts = _line_starts(before)
        line, column = len(starts), len(before) - starts[-1] + 1
        raise ReadError(
            f"byte 0x{raw[error.start]:02x} is no UTF-8",
            Place(file, line, column),
            "Save the file as UTF-8.",
        ) from None
