"""Between a document's text and what the source view shows: lines, spans, addresses."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint

_BREAK = re.compile("[\u2028\u2029\x0b\x0c\x1c-\x1e\x85]")


@dataclass(frozen=True)
class Lines:
    """Lines of a text, both counted from 0, first and last included."""

    first: int
    last: int


class SourceText:
    """One blueprint's text as lines that a text widget counts in the same way."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._text = blueprint.document.text

    @cached_property
    def shown(self) -> str:
        """The text with plain line ends; every other character keeps its line and column."""
        plain = self._text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", " ")
        return _BREAK.sub("\ufffd", plain)

    def lines_of(self, address: Address) -> Lines | None:
        """The lines in which an element is written; None where it is not written."""
        document = self._blueprint.document
        try:
            member = document.member(address.path)
        except KeyError:
            return None
        first = document.place_at(member.key_start).line - 1
        return Lines(first, document.place_at(max(member.key_start, member.value_end - 1)).line - 1)

    def address_at(self, line: int, column: int) -> Address | None:
        """The element at a line and column (from 0): the SB, state or operation written there."""
        offset = self._offset(line, column)
        path: tuple[str, ...] = ()
        while len(path) < 3:
            inner = self._key_at(path, offset)
            if inner is None or inner.startswith("_") or (len(path) == 1 and inner == "HEADER"):
                break
            path = (*path, inner)
        return Address(*path) if path else None

    def _key_at(self, path: tuple[str, ...], offset: int) -> str | None:
        try:
            members = self._blueprint.document.members(path)
        except KeyError:
            return None
        for member in members:
            if member.key_start <= offset < member.value_end:
                return member.key
        return None

    def _offset(self, line: int, column: int) -> int:
        line = min(line, len(self._starts) - 1)
        bom = 1 if line == 0 and self._text.startswith("\ufeff") else 0
        return self._starts[line] + column + bom

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(match.end() for match in re.finditer("\n", self._text))]


Patch = tuple[int, int, str]


def patches(old: str, new: str) -> list[Patch]:
    """What to replace to turn ``old`` into ``new``: start, end (in ``old``) and the new part.

    The last one comes first, so that each can be applied without moving the others. Where only
    single lines differ (a state renamed wherever it is a target), only these are replaced.
    """
    start = _common_prefix(old, new)
    most = min(len(old), len(new)) - start
    tail = _common_suffix(old, new, most)
    before, after = old[start : len(old) - tail], new[start : len(new) - tail]
    if not before and not after:
        return []
    lines, fresh = before.split("\n"), after.split("\n")
    if len(lines) != len(fresh) or len(lines) < 3:
        return [(start, len(old) - tail, after)]
    found: list[Patch] = []
    at = start
    for line, other in zip(lines, fresh, strict=True):
        if line != other:
            found.append((at, at + len(line), other))
        at += len(line) + 1
    return found[::-1]


def _common_prefix(a: str, b: str) -> int:
    low, high = 0, min(len(a), len(b))
    while low < high:
        middle = (low + high + 1) // 2
        if a[low:middle] == b[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def _common_suffix(a: str, b: str, most: int) -> int:
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if a[len(a) - middle : len(a) - low] == b[len(b) - middle : len(b) - low]:
            low = middle
        else:
            high = middle - 1
    return low
