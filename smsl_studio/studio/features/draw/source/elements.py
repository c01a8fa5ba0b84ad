"""Finds the lines of an element, and the element of a line, in the text that is shown.

If the text equals the text that was read, the spans of the document answer exactly. If it is being
typed or is broken, the names are searched in the text, and their surroundings decide.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.smsl.document import Document
from smsl_studio.studio.features.draw.source import regions
from smsl_studio.studio.features.draw.source.around import HEADER, around, key_at, path_at
from smsl_studio.studio.features.draw.source.sheet import TextSheet

MANY = 200
"""At most this many occurrences of a name are looked at."""


@dataclass(frozen=True)
class LineRange:
    """Shown lines, counted from 0; first and last are included."""

    first: int
    last: int


class Elements:
    """The elements in the text of a sheet. ``document`` is the text as it was last read."""

    def __init__(self, sheet: TextSheet, document: Document) -> None:
        self._sheet, self._document = sheet, document

    @property
    def exact(self) -> bool:
        """Whether the sheet shows exactly the text of the document."""
        return self._sheet.text == self._document.text

    def lines_of(self, address: Address) -> LineRange | None:
        """The lines in which an element is written; None if it is not found."""
        if not self.exact:
            return self._found(address.path)
        try:
            member = self._document.member(address.path)
        except KeyError:
            return None
        end = max(member.key_start, member.value_end - 1)
        if member.value_start <= member.key_start:
            # In native text an SB begins with its bracket, not with its name.
            return self._lines(member.value_start, end)
        return self._lines(member.key_start, end)

    def address_at(self, line: int, column: int) -> Address | None:
        """The SB, state or operation that is written at a place."""
        path = self._read_path(line, column) if self.exact else self._seen_path(line, column)
        found: list[str] = []
        for name in path[:3]:
            if name.startswith("_") or not name or (len(found) == 1 and name == HEADER):
                break
            found.append(name)
        return Address(*found) if found else None

    def definition(self, line: int, column: int) -> Address | None:
        """The element to which the name at a place refers: a target, a state in a header, a
        sub-SB."""
        here = around(self._sheet.pieces, line, column, self._document.form)
        if not here.word or not here.path:
            return None
        branch = here.path[0]
        if HEADER in here.path[1:2]:
            if here.is_value and here.key in ("INITIAL", "ACTIVATING"):
                return Address(branch, here.word)
            return Address(here.word) if here.path[2:3] == ("SUB_SBS",) else None
        if here.is_value and len(here.path) == 2:
            return Address(branch, here.word)
        return None

    def _lines(self, start: int, end: int) -> LineRange:
        return LineRange(self._sheet.where(start)[0], self._sheet.where(end)[0])

    def _read_path(self, line: int, column: int) -> tuple[str, ...]:
        offset = self._sheet.offset(line, column)
        path: tuple[str, ...] = ()
        while len(path) < 3 and (inner := self._key_at(path, offset)) is not None:
            path = (*path, inner)
        return path

    def _key_at(self, path: tuple[str, ...], offset: int) -> str | None:
        try:
            members = self._document.members(path)
        except KeyError:
            return None
        for member in members:
            if min(member.key_start, member.value_start) <= offset < member.value_end:
                return member.key
        return None

    def _seen_path(self, line: int, column: int) -> tuple[str, ...]:
        form = self._document.form
        path = path_at(self._sheet.pieces, line, column, form)
        key = key_at(self._sheet.shown_piece(line), column, form)
        if key is None:
            return path
        outer = path_at(self._sheet.pieces, line, key.start, form)
        return (*outer, key.name) if outer == path else path

    def _found(self, path: tuple[str, ...]) -> LineRange | None:
        """The lines of an element, found by searching for its name."""
        within = self._found(path[:-1]) if len(path) > 2 else None
        if len(path) > 2 and within is None:
            return None
        form, text = self._document.form, self._sheet.text
        name = re.escape(path[-1])
        mark = "->" if form == "smsl" and len(path) > 2 else ":"
        pattern = rf'(?<![^\s"\'{{\[,-])["\']?{name}["\']?\s*{mark}'
        if form == "smsl" and len(path) == 1:
            pattern = rf"#\s*NAME\s*:\s*\"?{name}\"?\s*$"
        start = self._sheet.offset(within.first, 0) if within else 0
        end = self._sheet.offset(within.last + 1, 0) if within else len(text)
        for count, match in enumerate(re.compile(pattern, re.MULTILINE).finditer(text, start, end)):
            line, column = self._sheet.where(match.start())
            if count > MANY:
                break
            if len(path) == 1 and form == "smsl":
                line = regions.enclosing(self._sheet.pieces, line) or line
            elif path_at(self._sheet.pieces, line, column, form) != path[:-1]:
                continue
            return LineRange(line, regions.extent(self._sheet.pieces, line))
        return None
