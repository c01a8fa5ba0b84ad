"""The document: a text, its values, and on demand the places of all its parts.

A Document knows spelling and not meaning. It keeps every character of its text (BOM, line ends,
order, indentation). So writing an unchanged document gives the same bytes. Places are computed by
the form of the text when they are first asked for, because usually nobody asks.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from typing import Any, NamedTuple, Protocol

from smsl_studio.errors import Place, ReadError

Json = Any
Path = tuple[str, ...]
WORDS = {"json": "JSON", "smsl": "SMSL", "yaml": "YAML"}
"""The names of the forms in messages."""

_LONE_CR = re.compile("\r(?!\n)")
_BLOCK = 2048


class Member(NamedTuple):
    """One key and its value, as offsets into the text (ends are exclusive).

    The key of a list element is its index. It has no length in the text.
    """

    key: str
    key_start: int
    key_end: int
    value_start: int
    value_end: int


class Spans(Protocol):
    """The places in one valid text. Each form has its own class."""

    @property
    def root(self) -> int:
        """The offset at which the content begins."""

    def members(self, path: Path) -> tuple[Member, ...]:
        """Return the members of the map or list at ``path``, as written, with doubled keys.

        The path follows the values of the document. Of a doubled key the last one counts. KeyError
        if there is no map or list at the path.
        """

    def member(self, path: Path) -> Member:
        """The member at ``path``, of a doubled key the last one; KeyError where there is none."""

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """Yield the path of every key that is doubled in one map, with the offsets of all its
        places.
        """


class LatestMembers:
    """By their keys the members of every map of one text that was asked about: each is listed
    once."""

    def __init__(self, members: Callable[[Path], tuple[Member, ...]]) -> None:
        self._members = members
        self._latest: dict[Path, dict[str, Member]] = {}

    def member(self, path: Path) -> Member:
        """The member at ``path``, of a doubled key the last one; KeyError where there is none."""
        above = path[:-1]
        if above not in self._latest:
            self._latest[above] = {member.key: member for member in self._members(above)}
        return self._latest[above][path[-1]]


@dataclass(frozen=True, eq=False)
class Document:
    """A text in one of the written forms, and its values.

    ``values`` keeps the order of the keys. If a key is doubled, the last value counts and
    ``doubled`` is true (see ``duplicates``). ``file`` is the name in messages. ``form`` is the name
    of the form (``json``, ``smsl`` or ``yaml``), and ``spans_of`` finds the places. ``stands_in``
    is the file with this text, if it is not ``file``: the new text of a save that is not finished.
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
        """The places in the text. They are computed at the first use."""
        return self.spans_of(self.text)

    @property
    def fields(self) -> dict[str, Json]:
        """The ``_`` fields of the file."""
        return {key: value for key, value in self.values.items() if key.startswith("_")}

    def members(self, path: Path = ()) -> tuple[Member, ...]:
        """Return the members of the map at ``path``, in order, with doubled keys.

        KeyError if there is no map at ``path``.
        """
        return self.spans.members(path)

    def member(self, path: Path) -> Member:
        """Return the member at ``path``, the last one of a doubled key. KeyError if there is
        none.
        """
        return self.spans.member(path)

    def place(self, path: Path) -> Place:
        """Return the place of the key at ``path``, or of the nearest existing key above it."""
        while path:
            try:
                return self.place_at(self.member(path).key_start)
            except KeyError:
                path = path[:-1]
        return self.place_at(self.spans.root)

    def place_at(self, offset: int) -> Place:
        """Return line and column of an offset. A BOM has no column."""
        line, column = self._lines.at(offset)
        if line == 1 and self.text.startswith("\ufeff"):
            column = max(1, column - 1)
        return Place(self.file, line, column)

    def duplicates(self) -> tuple[tuple[Path, tuple[Place, ...]], ...]:
        """Return every key that is doubled in one map, with all its places."""
        if not self.doubled:
            return ()
        return tuple(
            (path, tuple(map(self.place_at, offsets))) for path, offsets in self.spans.doubles()
        )

    def encoded(self) -> bytes:
        """Return the bytes of the file."""
        return self.text.encode("utf-8")

    @cached_property
    def newline(self) -> str:
        """The line end of this text."""
        if "\r" not in self.text:
            return "\n"
        if "\r\n" in self.text:
            return "\r\n"
        return "\r" if "\n" not in self.text else "\n"

    @cached_property
    def _lines(self) -> _Lines:
        return _Lines(self.text)


class _Lines:
    """Finds lines and columns in a text. Line ends are counted by block, not listed one by one."""

    def __init__(self, text: str) -> None:
        self._text = _LONE_CR.sub("\n", text) if "\r" in text else text
        counts = (self._text.count("\n", at, at + _BLOCK) for at in range(0, len(text), _BLOCK))
        self._before = list(accumulate(counts, initial=0))

    def at(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both from 1."""
        block = min(offset // _BLOCK, len(self._before) - 1)
        before = self._before[block] + self._text.count("\n", block * _BLOCK, offset)
        return before + 1, offset - self._text.rfind("\n", 0, offset)


def decode(raw: bytes, file: str) -> str:
    """Return the text of a file. ReadError, with the place of the first wrong byte, if it is not
    UTF-8.
    """
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode("utf-8").removeprefix("\ufeff")
        line, column = _Lines(before).at(len(before))
        raise ReadError(
            f"byte 0x{raw[error.start]:02x} is no UTF-8",
            Place(file, line, column),
            "Save the file as UTF-8.",
        ) from None
