"""What decides a fact from measures: its sources and its predicates, to read and to edit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.editing import fact_entry as entry
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.features.draw.panels.note_form import misfits_of
from smsl_studio.studio.features.draw.panels.predicate_table import PredicateTable
from smsl_studio.studio.features.draw.panels.source_table import SourceTable

DECIDE, LEAVE = "Decide it from what is measured", "Let sensors say the value"
UNSAID = "The fact is unknown in every run. Write a condition for each value."


class SensePart(QWidget):
    """The sources and predicates of one fact, and a button that begins or ends with them."""

    given = Signal(object, str)
    """(the keys of the entry that change, the words of the step)."""
    opened = Signal()
    """The person wants to write the first source."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._note, self._who = FactNote(), ""
        self._open = False
        self.button = QPushButton(DECIDE)
        self.button.setProperty("role", "link")
        self.button.clicked.connect(self._press)
        self.sources, self.predicates = SourceTable(tokens), PredicateTable(tokens)
        self.fault = Sentence("refusal")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        for part in (self.sources, self.predicates, self.fault):
            column.addWidget(part)
        column.addWidget(self.button)
        self._connect()

    def _connect(self) -> None:
        sources = self.sources
        sources.added.connect(
            lambda name: self._give(entry.with_unit(self._note, name, "1"), f"Add source {name}")
        )
        sources.renamed.connect(
            lambda old, new: self._give(
                entry.renamed_source(self._note, old, new), f"Rename source {old} to {new}"
            )
        )
        sources.measured_in.connect(
            lambda name, unit: self._give(
                entry.with_unit(self._note, name, unit), f"Set unit of {name} to {unit}"
            )
        )
        sources.ranged.connect(
            lambda name, pair: self._give(
                entry.with_range(self._note, name, pair), f"Set range of {name}"
            )
        )
        sources.removed.connect(
            lambda name: self._give(
                entry.without_source(self._note, name), f"Take source {name} away"
            )
        )
        self.predicates.given.connect(
            lambda value, text: self._give(
                entry.with_predicate(self._note, value, text), f"Set the condition for {value}"
            )
        )

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.sources.set_tokens(tokens)
        self.predicates.set_tokens(tokens)

    def show_fact(self, blueprint: Blueprint, branch: StateBranch, digit: int, who: str) -> bool:
        """Show a fact, and return whether measures decide it. ``who`` are its words in a step."""
        note = branch.fact_note(digit) or FactNote()
        if who != self._who:
            self._open = False
        self._note, self._who = note, who
        sense = branch.notes.senses.get(digit)
        measured = sense is not None or bool(note.sources)
        self._open &= not measured
        shown = measured or self._open
        self.button.setText(LEAVE if measured else DECIDE)
        self.button.setVisible(measured or not self._open)
        faults = {
            name: f"{capital(error.sentence.partition(': ')[2])} {error.advice}"
            for name, error in entry.unit_faults(note.sources).items()
        }
        rest: list[str] = []
        for one in sense.faults if sense is not None else ():
            words = f"{capital(one.sentence)} {one.advice}"
            if len(one.path) == 2 and one.path[0] in ("sources", "range"):
                faults.setdefault(one.path[1], words)
            elif len(one.path) != 2 or one.path[1] not in branch.alphabet[digit]:
                rest.append(words)
        for part in (self.sources, self.predicates):
            part.setVisible(shown)
        if shown:
            self.sources.known = _names(blueprint)
            self.sources.show_sources(note, faults)
            values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
            self.predicates.show_predicates(values, note)
        if not note.predicate and "predicate" not in _misfit(branch, digit):
            rest = [UNSAID]
        self.fault.say(" ".join(rest) if measured else "")
        return measured

    def _press(self) -> None:
        if self.button.text() == LEAVE:
            self._give(entry.without_predicates(), "Take sources and predicates away")
            return
        self._open = True
        self.opened.emit()
        self.sources.rows[""].name.setFocus()

    def _give(self, changed: Mapping[str, Any], step: str) -> None:
        self.given.emit(changed, f"{step} in {self._who}")


def _misfit(branch: StateBranch, digit: int) -> frozenset[str]:
    """The keys of the entry that cannot be read."""
    return frozenset(misfits_of(branch, "_facts").get(str(digit), {}))


def _names(blueprint: Blueprint) -> tuple[str, ...]:
    """The sources of all facts, each once, in the order of their names."""
    found = {
        name
        for branch in blueprint
        for note in branch.notes.facts.values()
        for name in note.sources
    }
    return tuple(sorted(found))
