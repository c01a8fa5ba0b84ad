"""Rows of facts with the values they must have, for ``requires``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import (
    QCompleter,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, NameDelegate, label, row
from smsl_studio.studio.base.lines.fact_completer import FactCompleter, fact_fault, fact_model
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text


@dataclass
class FactLine:
    """The widgets of one row; ``text`` is the fact as it was shown, empty for a new row."""

    text: str
    fact: Field
    value: Field
    gone: SmallButton
    layout: QHBoxLayout


class FactRows(QWidget):
    """Rows of facts and values.

    ``given`` carries all facts (``{"SB/digit": value}``) after any row was changed.
    """

    given = Signal(object)

    def __init__(self, tokens: Tokens, add: str) -> None:
        super().__init__()
        self._tokens = tokens
        self._blueprint: Blueprint | None = None
        self._facts: dict[str, str] = {}
        self._model: QStandardItemModel | None = None
        self.rows: list[FactLine] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(4)
        self.refusal: QLabel = label("", "refusal")
        self.refusal.hide()
        self.add = QPushButton(add)
        self.add.setProperty("role", "link")
        self.add.setToolTip("A fact of any State Branch, and the value it must have")
        self.add.clicked.connect(self.add_row)
        self._column.addWidget(self.refusal)
        self._column.addLayout(row(self.add, None))

    @property
    def facts(self) -> dict[str, str]:
        """The facts of all complete rows."""
        return dict(self._facts)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for one in self.rows:
            one.gone.set_tokens(tokens)

    def show_facts(self, blueprint: Blueprint, facts: Mapping[str, str]) -> None:
        """Show these facts, one in each row."""
        if blueprint is not self._blueprint:
            self._model = None
        self._blueprint, self._facts = blueprint, dict(facts)
        self.refuse("")
        while len(self.rows) > len(facts):
            self._drop(self.rows[-1])
        while len(self.rows) < len(facts):
            self._new_row()
        for one, (text, value) in zip(self.rows, facts.items(), strict=True):
            one.text = text
            one.fact.settle(text)
            one.value.settle(value)
            self._explain(one)

    def add_row(self) -> None:
        """Add an empty row. It counts when both fact and value are filled in."""
        empty = next((one for one in self.rows if not one.text), None) or self._new_row()
        empty.fact.setFocus()

    def refuse(self, sentence: str) -> None:
        """Show below the rows why a change was refused; empty hides the sentence."""
        self.refusal.setText(sentence)
        self.refusal.setVisible(bool(sentence))

    def _new_row(self) -> FactLine:
        fact, value = Field(), Field()
        gone = SmallButton("Remove this fact", "close", self._tokens)
        layout = row(fact, label("=", "second"), value, gone, spacing=4)
        one = FactLine("", fact, value, gone, layout)
        for field, words in ((fact, "Fact, as SB/digit"), (value, "Value of the fact")):
            field.setFont(mono_font(12))
            field.setAccessibleName(plain_text(words))
            field.setToolTip(tip_text(words))
        fact.setPlaceholderText("SB/digit")
        fact.textEdited.connect(lambda *_: self._complete(one))
        value.setPlaceholderText("value")
        value.setFixedWidth(58)
        gone.clicked.connect(lambda: self._remove(one))
        fact.editingFinished.connect(lambda: self._typed(one, fact))
        value.editingFinished.connect(lambda: self._typed(one, value))
        self._column.insertLayout(len(self.rows), layout)
        self.rows.append(one)
        return one

    def _drop(self, one: FactLine) -> None:
        self.rows.remove(one)
        self._column.removeItem(one.layout)
        while one.layout.count():
            item = one.layout.takeAt(0)
            widget = item.widget() if item is not None else None
            if widget is not None:
                widget.hide()
                widget.deleteLater()

    def _complete(self, one: FactLine) -> None:
        """Make the completion when the user types, not for every row that is shown."""
        if one.fact.completer() is None and self._blueprint is not None:
            if self._model is None:
                self._model = fact_model(self._blueprint, self)
            one.fact.setCompleter(FactCompleter(self._model, one.fact))

    def _remove(self, one: FactLine) -> None:
        if one.text:
            self.given.emit({k: v for k, v in self._facts.items() if k != one.text})
        else:
            self._drop(one)
            self.refuse("")

    def _typed(self, one: FactLine, field: Field) -> None:
        if not field.changed or self._blueprint is None:
            return
        text, value = one.fact.text().strip(), one.value.text().strip()
        sentence = fact_fault(self._blueprint, text) if text else ""
        if not sentence and text != one.text and text in self._facts:
            sentence = f"{text} stands here already. Change its value there."
        one.fact.set_refused(bool(sentence))
        self.refuse(sentence)
        self._explain(one)
        if sentence or not text or not value:
            return
        facts = {(text if k == one.text else k): v for k, v in self._facts.items()}
        self.given.emit({**facts, text: value})

    def _explain(self, one: FactLine) -> None:
        """Show the plain name of the fact and its values in tooltip and completion."""
        fact = split_fact(one.fact.text().strip())
        if fact is None or self._blueprint is None or fact_fault(self._blueprint, one.fact.text()):
            return
        branch, digit = self._blueprint[fact[0]], fact[1]
        values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
        one.fact.setToolTip(tip_text(f"{branch.fact_name(digit)}, digit {digit} of {branch.name}"))
        one.value.setToolTip(tip_text(f"{branch.fact_name(digit)} takes {', '.join(values[:24])}"))
        completer = QCompleter(list(values[:64]), one.value)
        completer.setCompletionMode(QCompleter.CompletionMode.UnfilteredPopupCompletion)
        one.value.setCompleter(completer)
        popup = completer.popup()
        if popup is not None:
            popup.setItemDelegate(NameDelegate(popup))
