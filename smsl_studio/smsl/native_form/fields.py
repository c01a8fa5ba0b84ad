"""What a ``#`` line says, or may have meant, kept in the map that it belongs to."""

from __future__ import annotations

from typing import Any

from smsl_studio.smsl.native_form.faults import Faults
from smsl_studio.smsl.native_form.lines import BadValue, HashLine, read_value

Json = Any


class HashFields:
    """Fills the maps of one text; ``doubled`` says whether a key came twice in one of them."""

    def __init__(self, text: str, faults: Faults) -> None:
        self._text, self._faults = text, faults
        self.doubled = False

    def keep(self, table: dict[str, Json], key: str, value: Json) -> None:
        """Keep a value under its key: the last one wins, in the place of the first."""
        if key in table:
            self.doubled = True
        table[key] = value

    def line(self, table: dict[str, Json], line: HashLine, depth: int) -> int:
        """Keep what a line says; where that cannot be read, tell it, and keep what it may have
        meant. The offset to go on at.
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
