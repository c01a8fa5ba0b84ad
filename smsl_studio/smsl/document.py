"""What is written: a text, its values, and on demand the span of everything in it.

A Document knows spelling, not meaning. Its text is kept to the character (BOM, line ends, order,
indentation), so that writing back a document nobody edited gives the same bytes. Spans are worked
out object by object when first asked for, because most loads never ask.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.scanning import Member, scan_container, skip_space

Json = Any
Path = tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Document:
    """A text in one of the written forms, and the values it holds.

    ``values`` keeps the order of the keys; where a key is written twice the last one wins and
    ``doubled`` is true (see ``duplicates``). ``file`` is the name that messages show.
    """

    text: str
    file: str
    form: str
    values: Mapping[str, Json]
    doubled: bool = False
    _members: dict[int, tuple[Member, ...]] = field(default_factory=dict, repr=False)

    def members(self, path: Path = ()) -> tuple[Member, ...]:
        """The members of the object at ``path``, in order, doubles included.

        Raises KeyError where no object stands at ``path``.
        """
        start = self.root
        for key in path:
            start = self._last(start, key).value_start
        return self.scan(start)

    def member(self, path: Path) -> Member:
        """The member at ``path`` (the last one, where its key is doubled); KeyError if none."""
        for member in reversed(self.members(path[:-1])):
            if member.key == path[-1]:
                return member
        raise KeyError(path)

    def place(self, path: Path) -> Place:
        """Where the key at ``path`` stands, or the nearest object above it that exists."""
        while path:
            try:
                return self.place_at(self.member(path).key_start)
            except KeyError:
                path = path[:-1]
        return self.place_at(self.root)

    def place_at(self, offset: int) -> Place:
        """Line and column of an offset; a BOM is no column."""
        starts = self._line_starts
        line = _bisect(starts, offset)
        column = offset - starts[line] + 1
        if line == 0 and self.text.startswith("\ufeff"):
            column = max(1, column - 1)
        return Place(self.file, line + 1, column)

    def scan(self, start: int) -> tuple[Member, ...]:
        """The members of the object that opens at offset ``start``, doubles included.

        The elements of a list are members whose key is their index and takes no room. KeyError
        where neither opens.
        """
        if start not in self._members:
            self._members[start] = tuple(scan_container(self.text, start))
        return self._members[start]

    def end_of(self, start: int) -> int:
        """The offset behind the object or list that opens at ``start``."""
        members = self.scan(start)
        return skip_space(self.text, members[-1].value_end if members else start + 1) + 1

    def duplicates(self) -> tuple[tuple[Path, tuple[Place, ...]], ...]:
        """Every key that is written more than once in one object, with all its places."""
        return tuple(self._doubles((), self.root)) if self.doubled else ()

    def encoded(self) -> bytes:
        """The bytes of the file."""
        return self.text.encode("utf-8")

    @cached_property
    def newline(self) -> str:
        """The line end this text uses."""
        if "\r\n" in self.text:
            return "\r\n"
        return "\r" if "\r" in self.text and "\n" not in self.text else "\n"

    @cached_property
    def root(self) -> int:
        """The offset at which the file's object opens."""
        return skip_space(self.text, 1 if self.text.startswith("\ufeff") else 0)

    @cached_property
    def _line_starts(self) -> list[int]:
        starts, at = [0], self.text.find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = self.text.find("\n", at + 1)
        return starts

    def _last(self, start: int, key: str) -> Member:
        for member in reversed(self.scan(start)):
            if member.key == key:
                return member
        raise KeyError(key)

    def _doubles(self, path: Path, start: int) -> Iterator[tuple[Path, tuple[Place, ...]]]:
        places: dict[str, list[Place]] = {}
        for member in self.scan(start):
            places.setdefault(member.key, []).append(self.place_at(member.key_start))
        for key, found in places.items():
            if len(found) > 1:
                yield (*path, key), tuple(found)
        for member in self.scan(start):
            if self.text[member.value_start] in "{[":
                yield from self._doubles((*path, member.key), member.value_start)


def _bisect(starts: list[int], offset: int) -> int:
    from bisect import bisect_right

    return bisect_right(starts, offset) - 1


def decode(raw: bytes, file: str) -> str:
    """The text of a file; ReadError with the place of the first byte that is no UTF-8."""
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        before = raw[: error.start]
        line = before.count(b"\n") + 1
        column = len(before[before.rfind(b"\n") + 1 :].decode("utf-8", "replace")) + 1
        raise ReadError(
            f"byte 0x{raw[error.start]:02x} is no UTF-8",
            Place(file, line, column),
            "Save the file as UTF-8.",
        ) from None
