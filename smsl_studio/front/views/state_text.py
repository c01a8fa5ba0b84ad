"""The text of one state: its lines as they are written, and which operation stands on which."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ConvertError
from smsl_studio.smsl.conversion import converted
from smsl_studio.smsl.document import WORDS, Document

SMSL = "smsl"
MOST = 400
"""So many lines of a state are shown."""


@dataclass(frozen=True)
class StateLine:
    """One line with its number in the text, from 1. ``operation`` is the name of the operation that
    begins on it, empty for none."""

    number: int
    text: str
    operation: str = ""


@dataclass(frozen=True)
class StateText:
    """The lines of a state in a form of the text; ``lines`` are at most ``MOST`` of all ``count``.
    ``total`` counts the lines of the whole text. ``why`` says why there are none.
    """

    lines: tuple[StateLine, ...] = ()
    count: int = 0
    total: int = 0
    why: str = ""

    @property
    def words(self) -> str:
        """Where the lines stand in the text."""
        if not self.lines:
            return self.why
        first = self.lines[0].number
        return f"lines {first} to {first + self.count - 1} of {self.total}"


class StateTexts:
    """The texts of one blueprint, each converted once."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._converted: dict[tuple[int, str], Document | str] = {}

    def forms(self, branch: str) -> tuple[str, ...]:
        """Return SMSL, and the form in which the SB is written; of an SMSL text JSON as well."""
        own = self._blueprint.home(branch).form
        return (SMSL, "json" if own == SMSL else own)

    def lines(self, branch: str, state: str, form: str) -> StateText:
        """Return the lines of a state."""
        home = self._blueprint.home(branch)
        key = id(home), form
        if key not in self._converted:
            try:
                self._converted[key] = converted(home, form, home.file).document
            except ConvertError as error:
                self._converted[key] = error.sentence
        found = self._converted[key]
        if isinstance(found, str):
            return StateText(why=f"It cannot be written as {WORDS[form]}: {found}")
        try:
            own = found.member((branch, state))
            members = found.members((branch, state))
        except KeyError:
            return StateText(why="The text has no such state")
        first = found.place_at(own.key_start).line or 1
        last = found.place_at(max(own.value_end - 1, own.key_start)).line or first
        begins = {found.place_at(one.key_start).line: one.key for one in members}
        every = found.text.splitlines()
        shown = every[first - 1 : last][:MOST]
        lines = tuple(
            StateLine(number, text, begins.get(number, ""))
            for number, text in enumerate(shown, first)
        )
        return StateText(lines, last - first + 1, len(every))
