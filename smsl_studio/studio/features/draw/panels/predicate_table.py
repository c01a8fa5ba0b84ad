"""The predicates of a fact: for each value the condition under which the fact has it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.editing.fact_entry import predicate_fault
from smsl_studio.blueprint.predicates.fact_sense import MOST
from smsl_studio.blueprint.properties.completion import Offers
from smsl_studio.blueprint.properties.predicate_offers import predicate_offers
from smsl_studio.errors import FormulaError
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.lines.offer_field import OfferField
from smsl_studio.studio.base.tag import Tag
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital


class PredicateRow(QWidget):
    """A value, and its condition."""

    def __init__(self, tokens: Tokens, table: PredicateTable, value: str) -> None:
        super().__init__()
        self.value = value
        self.chip = Tag(tokens)
        self.chip.fit(value)
        self.chip.show_tag(value, "value", False)
        self.condition = OfferField(tokens, table.offers_at)
        self.condition.setAccessibleName(plain_text(f"Condition for {value}"))
        self.condition.setToolTip(tip_text(
            "When the fact has this value, such as: force > 2 N for 0.5 s and not gap > 3 mm. "
            "Ctrl+Space shows what may stand at the caret"
        ))  # fmt: skip
        self.fault = Sentence("refusal")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(row(self.chip, label("if", "second"), self.condition, spacing=6))
        column.addWidget(self.fault)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.chip.set_tokens(tokens)
        self.condition.set_tokens(tokens)

    def say(self, fault: FormulaError | None) -> None:
        """Show why the condition cannot be read, and where; None takes it back."""
        self.condition.mark(-1 if fault is None else fault.at)
        self.fault.say("" if fault is None else f"{capital(fault.sentence)} {fault.advice}")


class PredicateTable(QWidget):
    """A row for each value. It tells what the person wrote and changes nothing itself."""

    given = Signal(str, str)
    """(value, condition): an empty condition takes it away."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._sources: Mapping[str, str] = {}
        self.rows: dict[str, PredicateRow] = {}
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 4, 0, 0)
        self._column.setSpacing(4)

    def offers_at(self, text: str, caret: int) -> Offers:
        """Offer what may stand at a place of a condition."""
        return predicate_offers(text, caret, self._sources)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for one in self.rows.values():
            one.set_tokens(tokens)

    def show_predicates(self, values: Sequence[str], note: FactNote) -> None:
        """Show the conditions of a fact with these values."""
        said = note.predicate if isinstance(note.predicate, dict) else {}
        self._sources = note.sources
        wanted = list(dict.fromkeys((*values, *said)))[:MOST]
        if list(self.rows) != wanted:
            self._build(wanted)
        for value, one in self.rows.items():
            one.condition.settle(said.get(value, ""))
            self._judge(one, one.condition.text())

    def _build(self, values: Sequence[str]) -> None:
        for one in self.rows.values():
            self._column.removeWidget(one)
            one.hide()
            one.deleteLater()
        self.rows = {value: self._new_row(value) for value in values}

    def _new_row(self, value: str) -> PredicateRow:
        one = PredicateRow(self._tokens, self, value)
        one.condition.textEdited.connect(partial(self._judge, one))
        one.condition.editingFinished.connect(partial(self._typed, one))
        self._column.addWidget(one)
        return one

    def _judge(self, one: PredicateRow, text: str) -> None:
        one.say(predicate_fault(text, self._sources) if text.strip() else None)

    def _typed(self, one: PredicateRow) -> None:
        if one.condition.changed:
            self.given.emit(one.value, one.condition.text().strip())
