"""Reads the native form: from text to Document. It finds all faults of a text in one pass.

One regular expression reads a well-formed state, which nearly every state is. Everything else is
read slowly (``states``, ``strays``): every fault is reported, and reading goes on after it.
``spans`` finds the places later.
"""

from __future__ import annotations

from typing import Any

from smsl_studio.errors import TextFix
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.budget import over_budget
from smsl_studio.smsl.json_form.characters import HALF_PAIR
from smsl_studio.smsl.native_form import strays
from smsl_studio.smsl.native_form.count import beyond_budget
from smsl_studio.smsl.native_form.faults import Faults, NativeFaultLimit
from smsl_studio.smsl.native_form.fields import HashFields
from smsl_studio.smsl.native_form.lines import HashLine, line_at
from smsl_studio.smsl.native_form.refusals import misnamed
from smsl_studio.smsl.native_form.spans import NativeSpans
from smsl_studio.smsl.native_form.states import StateReader
from smsl_studio.smsl.native_form.tokens import skip_separator

Json = Any


def parse(text: str, file: str) -> Document:
    """Read a native text. ReadError, with all its faults, if it is not one.

    A doubled key is no error: the last value counts, in the place of the first.
    """
    parser = NativeParser(text, file)
    error = parser.faults.error()
    if error:
        raise misnamed(text, file) or error
    return Document(text, file, "smsl", parser.values, NativeSpans, parser.doubled)


class NativeParser:
    """Reads one text: its values and its faults."""

    def __init__(self, text: str, file: str) -> None:
        self.text = text
        self.values: dict[str, Json] = {}
        blank = Document(text, file, "smsl", {}, NativeSpans)
        self.faults = Faults(blank.place_at)
        self._keeping = HashFields(text, self.faults)
        self._states = StateReader(text, self.faults, self._keeping)
        try:
            if self._is_sound():
                self._file()
        except NativeFaultLimit:
            pass

    @property
    def doubled(self) -> bool:
        """Whether a key occurs twice in one map."""
        return self._keeping.doubled

    def _is_sound(self) -> bool:
        text = self.text
        over = beyond_budget(text)
        if over is not None:
            self.faults.add(over, over + 1, *over_budget(text))
            return False
        try:
            text.encode("utf-8")
        except UnicodeEncodeError as error:
            self.faults.add(error.start, error.end, *HALF_PAIR)
            return False
        return True

    def _file(self) -> None:
        text = self.text
        at = skip_separator(text, 1 if text.startswith("\ufeff") else 0)
        while at < len(text):
            mark = text[at]
            if mark == "{":
                at = self._branch(at, at + 1)
            elif mark == "#":
                at = self._line_outside(at)
            elif strays.begins_state(text, at):
                at = self._branch_without_brace(at)
            else:
                at = strays.outside(text, at, self.faults)
            at = skip_separator(text, at)

    def _line_outside(self, at: int) -> int:
        """Read a ``#`` line between branches. Return the offset after it."""
        line = line_at(self.text, at)
        if line is None:
            return strays.broken_line(self.text, at, self.faults)
        if line.level == "field":
            return self._keeping.line(self.values, line, 1)
        return self._branch_without_brace(at)

    def _branch_without_brace(self, at: int) -> int:
        fix = TextFix("Put { before it", at, at, "{\n")
        sentence = "this stands in no State Branch: { is missing before it"
        self.faults.add(at, at + 1, sentence, "A State Branch is { # NAME: SB1 ... }.", fix)
        return self._branch(at, at, braced=False)

    def _branch(self, start: int, at: int, braced: bool = True) -> int:
        """Read the State Branch whose brace is at ``start``. Return the offset after it."""
        text = self.text
        name: str | None = None
        header: dict[str, Json] = {}
        members: dict[str, Json] = {}
        while True:
            at = skip_separator(text, at)
            state = self._states.whole(at)
            if state is not None:
                key, value, at = state
                self._keeping.keep(members, key, value)
                continue
            mark = text[at : at + 1]
            if mark == "}":
                at += 1
                break
            if mark == "#":
                line = line_at(text, at)
                if line is None:
                    name = name or strays.meant_name(text, at)
                    at = strays.broken_line(text, at, self.faults)
                elif line.level == "field":
                    at = self._keeping.line(members, line, 2)
                elif line.level == "header":
                    at = self._keeping.line(header, line, 3)
                elif name is None:
                    name = self._name(line)
                    at = line.end
                else:
                    strays.second_name(text, at, line, self.faults)
                    break
            elif mark in ("", "{"):
                strays.not_closed(text, start, at, name, self.faults)
                break
            else:
                odd = self._states.odd(at)
                if odd.key is not None:
                    self._keeping.keep(members, odd.key, odd.value)
                at = odd.end
        if name is None:
            name = strays.no_name(text, start, self.values, self.faults if braced else None)
        self._keeping.keep(self.values, name, {"HEADER": header, **members} if header else members)
        return at

    def _name(self, line: HashLine) -> str:
        found: dict[str, Json] = {}
        self._keeping.line(found, line, 1)
        name: str = found.get(line.key) or strays.free_name(self.values)
        return name
