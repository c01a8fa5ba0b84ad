"""The form of one fact: its name, the meaning of its values, and where its value comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QPushButton, QWidget

from smsl_studio.blueprint.address import fact_text
from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.predicates.fact_sense import HIGHEST
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.lines.choice import ChoiceLine, SwitchLine
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.lines.text import ListLine, NumberBounds, NumberLine, TextLine
from smsl_studio.studio.base.notation_part import NotationPart
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.tag import Tag
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.asking_lines import AskingLines
from smsl_studio.studio.features.draw.panels.note_form import (
    NoteEntry,
    NoteForm,
    misfits_of,
    short_step,
    written_words,
)
from smsl_studio.studio.features.draw.panels.sense_part import SensePart
from smsl_studio.studio.features.draw.panels.value_table import ValueTable

PLAIN = FactNote()
AGGREGATIONS = (
    ("Only one", "single"),
    ("All of them", "all"),
    ("Any of them", "any"),
    ("At least k of them", "k_of_n"),
    ("The first that is valid", "priority"),
    ("A person says it", "human"),
)
TABLED = ("values", "on", "failure")
"""Keys of a fact note that the table of values shows."""
SENSED = ("sensors", "unit", "predicate", "aggregation", "k", "max_age", "conflict_after")
"""Keys of a sensed fact. A fact that a sub-SB expands uses none of them."""
SAID = frozenset(SENSED) - {"max_age"}
"""Keys of sensors that say a value. A fact that is decided from measures uses none of them."""


class FactForm(NoteForm):
    """Edits the entry of one digit in ``_facts``."""

    left = Signal()
    """The person closed the form; the panel shows the selection again."""
    sub_wanted = Signal(str)

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Fact", "_facts", session, parent)
        self._branch, self._digit = "", 0
        self.chip = Tag(tokens)
        self._place: QLabel = label("", "second")
        self.close_button = SmallButton("Back to what is selected", "close", tokens)
        self.close_button.clicked.connect(self.left)
        heading = row(label("Fact", "heading"), self.chip, self._place, None, self.close_button)
        self.column.addLayout(heading)
        self._values = ValueTable(tokens)
        self._sensed: QLabel = label("Where it comes from", "heading")
        self._sensed.setContentsMargins(0, 6, 0, 0)
        self.expanded: QLabel = label("", "hint")
        self.enter = QPushButton("Show the sub-SB")
        self.enter.setProperty("role", "link")
        self.enter.clicked.connect(lambda: self.sub_wanted.emit(self._sub or ""))
        self._sub: str | None = None
        self._build(tokens)
        self.set_tokens(tokens)

    @property
    def values(self) -> ValueTable:
        """The table of the fact's values."""
        return self._values

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.chip.set_tokens(tokens)
        self._values.set_tokens(tokens)
        self.sensed.set_tokens(tokens)
        self.close_button.set_tokens(tokens)

    def _build(self, tokens: Tokens) -> None:
        self.name = self.add("name", TextLine("Name", "A plain name of the fact, for people")).field
        self.column.addWidget(self._values)
        self._said = Sentence("refusal")
        self.column.addWidget(self._said)
        self._values.meant.connect(self._mean)
        self._values.turned_on.connect(self._turn_on)
        self._values.failed.connect(lambda values: self._word("failure", values))
        self.add("critical", SwitchLine("Critical", "Whether people may be harmed if it is wrong"))
        for widget in (self._sensed, self.expanded):
            self.column.addWidget(widget)
        self.column.addLayout(row(self.enter, None))
        self.add("sensors", ListLine("Sensors", "The sensors that read it, with commas between",
                                     "none named"))  # fmt: skip
        self.add("aggregation", ChoiceLine(
            "Together", "How sensors make one value, or whether a person says it", AGGREGATIONS
        ))  # fmt: skip
        self.add("k", NumberLine("k", "How many sensors must agree", NumberBounds(1, whole=True),
                                 "sensors"))  # fmt: skip
        self.add("predicate", TextLine("Predicate", "The threshold or condition that is read, "
                                       "such as distance < 2", "such as distance < 2"))  # fmt: skip
        self.sensed = SensePart(tokens)
        self.column.addWidget(self.sensed)
        self.sensed.given.connect(self._write_sense)
        self.sensed.opened.connect(lambda: self.show_fact(self._session.blueprint, self._branch,
                                                          self._digit))  # fmt: skip
        self.add("log_rate", NumberLine(
            "Log rate", "How often the log of a run keeps what its sources measure",
            NumberBounds(0, open=True, most=HIGHEST), "Hz"))  # fmt: skip
        self.add("unit", TextLine("Unit", "The unit of what the sensors read, such as mm"))
        self.add("max_age", NumberLine(
            "Max. age", "A reading older than this counts as unknown",
            NumberBounds(0, open=True), "s", "sensor's own"))  # fmt: skip
        self.add("conflict_after", NumberLine(
            "Conflict after", "How long its sensors may disagree before it is unknown",
            NumberBounds(0, most=60), "s", "at once"))  # fmt: skip
        self.asking = AskingLines(self, "What the person who says it is asked", "What is it?")
        self.column.addWidget(self.odd)
        self.notation = NotationPart()
        self.column.addWidget(self.notation)

    def unknown(self, misfits: Mapping[str, str]) -> dict[str, str]:
        """The keys that neither a line of this form nor the table of values shows."""
        return {k: v for k, v in super().unknown(misfits).items() if k not in TABLED}

    def show_fact(self, blueprint: Blueprint, name: str, digit: int) -> None:
        """Show a fact as it is now."""
        branch = blueprint[name]
        self._branch, self._digit, self._sub = name, digit, branch.subs.get(digit)
        key = str(digit)
        note = branch.fact_note(digit) or PLAIN
        misfits = misfits_of(branch, "_facts").get(key, {})
        written = written_words(branch, "_facts", key) - set(misfits)
        self.chip.show_tag(key, "value", self._sub is not None)
        self._place.setText(f"of {name}")
        measured = self.sensed.show_fact(blueprint, branch, digit, self.who())
        if isinstance(note.predicate, dict):
            # Predicates are a map, which a line cannot show. It would write a text over them.
            note, written = replace(note, predicate=""), written - {"predicate"}
        self.show_entries([NoteEntry(name, key, note, PLAIN, written, misfits=misfits)])
        values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
        self._values.show_values(values, note, branch.on_value(digit))
        self._values.setVisible(bool(self._values.rows))
        self._said.say(_value_misfits(misfits))
        self.name.setPlaceholderText(f"Fact {digit + 1}")
        self._show_source(blueprint, branch, note, written, measured)
        self.notation.show_element(blueprint, fact_text(name, digit))

    def who(self) -> str:
        """The fact in the words of an undo step."""
        return f"digit {self._digit} of {self._branch}"

    def _show_source(
        self,
        blueprint: Blueprint,
        branch: StateBranch,
        note: FactNote,
        written: frozenset[str],
        measured: bool,
    ) -> None:
        sub = self._sub
        for word in SENSED:
            # A written key that has no effect is shown, so that it can be removed.
            useful = sub is None and not (measured and word in SAID)
            self._lines[word].setVisible(useful or word in written)
        self.sensed.setVisible(sub is None or measured)
        self._lines["log_rate"].setVisible(measured or "log_rate" in written)
        if sub is None and not measured:
            several = len(note.sensors) > 1 or "conflict_after" in written
            self._lines["conflict_after"].setVisible(several)
            self._lines["k"].setVisible(note.aggregation == "k_of_n" or "k" in written)
        asked = sub is None and Levels(blueprint).fact(branch.name, self._digit) != AUTOMATIC
        self.asking.show(asked, written)
        self.expanded.setVisible(sub is not None)
        self.enter.setVisible(sub in blueprint.branches)
        if sub is not None:
            self.expanded.setText(expansion(blueprint, branch, self._digit, sub))
            self.enter.setText(as_it_is(f"Show {sub}"))

    def _mean(self, value: str, meaning: str | None) -> None:
        note = self._entries[0].note
        values: Mapping[str, str] = {k: v for k, v in note.values.items() if k != value}
        if meaning is not None:
            values = {k: (meaning if k == value else v) for k, v in note.values.items()}
            values = {**values, value: meaning}
        words = f"to “{meaning}”" if meaning else "away"
        step = f"Set the meaning of {value} in {self.who()} {words}"
        self._write({"values": dict(values) or None}, step)

    def _turn_on(self, value: str | None) -> None:
        default = self._session.blueprint[self._branch].default_on_value(self._digit)
        self._word("on", None if value == default else value)

    def _word(self, word: str, value: Any) -> None:
        said = {"on": "on", "failure": "failure"}[word]
        words = ", ".join(value) if isinstance(value, list) else value
        step = f"Set that {words} means {said} in {self.who()}" if value else (
            f"Use the default for {said} in {self.who()}")  # fmt: skip
        self._write({word: value}, step)

    def _write_sense(self, words: Mapping[str, Any], step: str) -> None:
        changes = {(self._branch, str(self._digit)): words}
        self.edit(short_step(step), lambda bp: change_notes(bp, "_facts", changes),
                  self.sensed.fault.say)  # fmt: skip

    def _write(self, words: Mapping[str, Any], step: str) -> None:
        changes = {(self._branch, str(self._digit)): words}
        self.edit(step, lambda bp: change_notes(bp, "_facts", changes), self._said.say)


def expansion(blueprint: Blueprint, branch: StateBranch, digit: int, sub: str) -> str:
    """A sentence that explains when the fact is on, if a sub-SB expands it."""
    if sub not in blueprint.branches:
        return f"{sub} is no State Branch of this blueprint."
    state = blueprint[sub].activating or "not drawn yet"
    return (
        f"“{branch.fact_name(digit)}” is on exactly while {sub} stands in its "
        f"activating state, {state}."
    )


def _value_misfits(misfits: Mapping[str, str]) -> str:
    odd = [f"{word}: {misfits[word]}" for word in TABLED if word in misfits]
    return f"What is written does not fit ({'; '.join(odd)}). It is kept." if odd else ""
