"""The table of what measures a fact: a row for each source with its unit and its range."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.predicates.fact_sense import MOST
from smsl_studio.blueprint.properties.completion import Offers
from smsl_studio.blueprint.properties.predicate_offers import unit_offers
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, label, row
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.lines.offer_field import OfferField
from smsl_studio.studio.base.lines.text import number_text
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text

UNIT, RANGE = 56, 82
ADD = "Add a source"
_PAIR = re.compile(r"\s*(\S+?)\s*(?:to|\.\.|;|\s)\s*(\S+)\s*")


class SourceRow(QWidget):
    """The fields of one source. The last row, which has no name, adds one."""

    def __init__(self, tokens: Tokens, table: SourceTable, name: str) -> None:
        super().__init__()
        self.source = name
        self.name = OfferField(tokens, table.names_at)
        self.unit = OfferField(tokens, unit_offers)
        self.range = Field()
        self.range.setFont(mono_font(12, 400))
        self.remove = SmallButton("Take this source away", "close", tokens)
        self.fault = Sentence("refusal")
        self.name.setPlaceholderText("" if name else ADD)
        self.unit.setFixedWidth(UNIT)
        self.range.setFixedWidth(RANGE)
        self.range.setPlaceholderText("any")
        about = plain_text(name) if name else "the new source"
        for field, what, tip in (
            (self.name, f"Name of {about}", "What measures it, as a plugin or a node calls it"),
            (self.unit, f"Unit of {about}", "Such as N, mm or deg; 1 is a plain number"),
            (self.range, f"Range of {about}", "The least and the largest number that it can "
             "measure, such as 0 to 50. Anything else is a fault of the source"),
        ):  # fmt: skip
            field.setAccessibleName(what)
            field.setToolTip(tip_text(tip))
        for widget in (self.unit, self.range, self.remove):
            widget.setVisible(bool(name))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        across = row(self.name, self.unit, self.range, self.remove, spacing=4)
        column.addLayout(across)
        column.addWidget(self.fault)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.name, self.unit, self.remove):
            part.set_tokens(tokens)


class SourceTable(QWidget):
    """A row for each source, and one to add another. It tells what the person wants and changes
    nothing itself."""

    added = Signal(str)
    renamed = Signal(str, str)
    """(old, new)."""
    measured_in = Signal(str, str)
    """(source, unit)."""
    ranged = Signal(str, object)
    """(source, pair of numbers | None)."""
    removed = Signal(str)

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.known: tuple[str, ...] = ()
        """Names of sources that the blueprint has elsewhere."""
        self.rows: dict[str, SourceRow] = {}
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 4, 0, 0)
        self._column.setSpacing(4)
        unit, bounds = label("Unit", "small"), label("Range", "small")
        unit.setFixedWidth(UNIT)
        bounds.setFixedWidth(RANGE)
        head = row(label("Measured by", "small"), None, unit, bounds, spacing=4)
        head.addSpacing(28)
        self._column.addLayout(head)

    def names_at(self, text: str, caret: int) -> Offers:
        """Offer names of sources that contain what is typed, but none that the fact has."""
        typed = text[:caret].casefold()
        free = [one for one in self.known if one not in self.rows]
        found = tuple(one for one in free if typed in one.casefold())
        return Offers(0, () if text in self.known else found, more=False)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for one in self.rows.values():
            one.set_tokens(tokens)

    def show_sources(self, note: FactNote, faults: Mapping[str, str]) -> None:
        """Show the sources of a fact. ``faults`` has a sentence for each that does not fit."""
        wanted = [*list(note.sources)[:MOST], ""]
        if list(self.rows) != wanted:
            self._build(wanted)
        for name, one in self.rows.items():
            one.name.settle(name)
            one.unit.settle(note.sources.get(name, ""))
            pair = note.range.get(name)
            words = f"{number_text(pair[0])} to {number_text(pair[1])}" if pair else ""
            one.range.settle(words)
            one.fault.say(faults.get(name, ""))

    def _build(self, names: list[str]) -> None:
        """Make the rows anew. The row that had the keys keeps them."""
        held = [name for name, one in self.rows.items() if one.isAncestorOf(self.focusWidget())]
        for one in self.rows.values():
            self._column.removeWidget(one)
            one.hide()
            one.deleteLater()
        was = list(self.rows)
        self.rows = {name: self._new_row(name) for name in names}
        fresh = [name for name in names if name and name not in was]
        if held == [""] and fresh:
            self.rows[fresh[0]].unit.setFocus()
            self.rows[fresh[0]].unit.selectAll()

    def _new_row(self, name: str) -> SourceRow:
        one = SourceRow(self._tokens, self, name)
        one.name.editingFinished.connect(partial(self._named, one))
        one.unit.editingFinished.connect(partial(self._measured, one))
        one.range.editingFinished.connect(partial(self._bounded, one))
        one.remove.clicked.connect(partial(self.removed.emit, name))
        self._column.addWidget(one)
        return one

    def _named(self, one: SourceRow) -> None:
        if not one.name.changed:
            return
        text = one.name.text().strip()
        if text == one.source:
            one.name.settle(text)
        elif not text:
            one.fault.say("A source needs a name. The cross takes it away.")
        elif text in self.rows:
            one.fault.say(f"There is a source {text} already.")
        elif one.source:
            self.renamed.emit(one.source, text)
        else:
            self.added.emit(text)

    def _measured(self, one: SourceRow) -> None:
        if one.source and one.unit.changed:
            self.measured_in.emit(one.source, one.unit.text().strip() or "1")

    def _bounded(self, one: SourceRow) -> None:
        if not one.source or not one.range.changed:
            return
        text = one.range.text().strip()
        if not text:
            self.ranged.emit(one.source, None)
            return
        pair = _pair_of(text)
        if pair is None:
            one.range.set_refused(True)
            one.fault.say(f"“{text[:40]}” is no range. Write the lower number first: 0 to 50.")
            return
        self.ranged.emit(one.source, pair)


def _pair_of(text: str) -> tuple[float, float] | None:
    match = _PAIR.fullmatch(text.replace(",", "."))
    if match is None:
        return None
    try:
        low, high = float(match[1]), float(match[2])
    except ValueError:
        return None
    return (low, high) if -1e15 <= low <= high <= 1e15 else None
