"""Keeps the value of a ``#`` line, or its probable value, in the map that it belongs to."""

from __future__ import annotations

from typing import Any

from smsl_studio.smsl.native_form.faults import Faults
from smsl_studio.smsl.native_form.lines import BadValue, HashLine, read_value

Json = Any


class HashFields:
    """Fills the maps of one text. ``doubled`` is true if a key occurs twice in one of them."""

    def __init__(self, text: str, faults: Faults) -> None:
        self._text, self._faults = text, faults
        self.doubled = False

    def keep(self, table: dict[str, Json], key: str, value: Json) -> None:
        """Keep a value under its key. The last value counts, in the place of the first."""
        if key in table:
            self.doubled = True
        table[key] = value

    def line(self, table: dict[str, Json], line: HashLine, depth: int) -> int:
        """Keep the value of a line. Return the offset at which reading goes on.

        If the value cannot be read, a fault is reported, and the probable value is kept.
        """
        try:
            value, _, doubled = read_value(self._text, line, depth)
        except BadValue as error:
            self._faults.add(error.at, error.end, error.sentence, error.advice, error.fix)
            if error.guess is not None:
                self.keep(table, line.key, error.guess)
            return error.resume or line.end
        self.doubled = self.doubled or doubled
        self.keep(table, line.key, value)
        return line.end
