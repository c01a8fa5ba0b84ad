"""The form of one hazard or property."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS
from smsl_studio.studio.base.controls import Combo, Label, label, row
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.inspection.claim_entry import FIELDS, ClaimEntry, EntryFault
from smsl_studio.studio.features.inspection.claim_model import PICTURES
from smsl_studio.studio.features.inspection.formula_field import FormulaField

KINDS = {
    "hazard": "Hazard: facts never together",
    "never": "Never: a condition",
    "before": "First this, only then that",
    "after": "After this, always that",
    "way_back": "There is a way back",
    "reachable": "It is possible",
    "at_most": "An operation at most n times",
    "cost": "A goal costs at most",
}
SEVERITIES = {"E": "Error", "W": "Warning"}
ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)


class ClaimForm(QWidget):
    """Writes a new hazard or property, or changes one. The sentence below says what it means."""

    written = Signal(object)
    """ClaimEntry: the person wants it so. It has no fault."""
    left = Signal()
    """The person leaves the form without a change."""
    typed = Signal(object)
    """ClaimEntry: what stands in the fields now, if it can be read; None if it cannot."""
    duplicated = Signal()
    deleted = Signal()

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._blueprint: Blueprint | None = None
        self._tokens = tokens
        self._begun = ClaimEntry()
        self.kind, self.severity = Combo(), Combo()
        self.kind.addItems(list(KINDS.values()))
        self.severity.addItems(list(SEVERITIES.values()))
        self.name, self.why, self.number = QLineEdit(), QLineEdit(), QLineEdit()
        self.first, self.second = FormulaField(tokens), FormulaField(tokens)
        self.title = label("", "heading")
        self.sentence, self.fault = label("", "strong"), label("", "refusal")
        self.sentence.setWordWrap(True)
        self.mark, self.verdict = Label(), label("", "second")
        self._verdict = ""
        self.apply = QPushButton("Add")
        self.apply.setProperty("role", "primary")
        self.cancel = QPushButton("Cancel")
        self.copy, self.delete = QPushButton("Duplicate"), QPushButton("Delete")
        self._labels: dict[str, Label] = {}
        self._build()
        self._connect()

    def _build(self) -> None:
        named = (
            ("kind", "Kind", self.kind), ("name", "Name", self.name),
            ("first", "", self.first), ("second", "", self.second),
            ("number", "", self.number), ("severity", "Severity", self.severity),
            ("why", "Why", self.why),
        )  # fmt: skip
        places = {"kind": (0, 0), "name": (0, 2), "first": (1, 0), "second": (2, 0),
                  "number": (3, 0), "severity": (3, 2), "why": (4, 0)}  # fmt: skip
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(6)
        grid.setColumnStretch(1, 2)
        grid.setColumnStretch(3, 3)
        for key, words, field in named:
            at, column = places[key]
            name = label(words, "label")
            name.setBuddy(field)
            field.setAccessibleName(words)
            self._labels[key] = name
            wide = key in ("first", "second", "why")
            grid.addWidget(name, at, column)
            grid.addWidget(field, at, column + 1, 1, 3 if wide else 1)
        self.name.setPlaceholderText("What must hold, in a few words")
        self.why.setPlaceholderText("For people: why it must hold (may stay empty)")
        inner = QWidget()
        inner.setProperty("role", "panel")
        column_layout = QVBoxLayout(inner)
        column_layout.setContentsMargins(14, 4, 14, 4)
        column_layout.setSpacing(6)
        head = row(self.title, None, self.copy, self.delete, self.cancel, self.apply, spacing=6)
        for button in (self.copy, self.delete, self.cancel):
            button.setProperty("role", "row")
        column_layout.addLayout(grid)
        column_layout.addStretch(1)
        area = QScrollArea()
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setWidget(inner)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setAccessibleName("Form of a hazard or property")
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        head.setContentsMargins(14, 8, 14, 4)
        whole.addLayout(head)
        whole.addWidget(area, 1)
        told = QVBoxLayout()
        told.setContentsMargins(14, 2, 14, 6)
        told.setSpacing(2)
        told.addWidget(self.sentence)
        told.addLayout(row(self.mark, self.verdict, None, spacing=6))
        told.addWidget(self.fault)
        whole.addLayout(told)

    def _connect(self) -> None:
        self.kind.activated.connect(lambda _: self._kind_chosen())
        self.severity.activated.connect(lambda _: self._look())
        for field in (self.name, self.why, self.number, self.first, self.second):
            field.textEdited.connect(lambda _: self._look())
            field.returnPressed.connect(self._write)
        self.apply.clicked.connect(self._write)
        self.cancel.clicked.connect(self.left)
        self.copy.clicked.connect(self.duplicated)
        self.delete.clicked.connect(self.deleted)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.first.set_tokens(tokens)
        self.second.set_tokens(tokens)
        self.tell(self._verdict, self.verdict.text())

    @property
    def entry(self) -> ClaimEntry:
        """What stands in the fields."""
        fields = FIELDS[self._kind]
        return ClaimEntry(
            self._kind,
            self.name.text(),
            list(SEVERITIES)[self.severity.currentIndex()],
            self.why.text(),
            self.first.text(),
            self.second.text() if fields.second else "",
            self.number.text() if fields.number else "",
        )

    @property
    def changed(self) -> bool:
        """Whether something was typed or chosen that is not written yet."""
        return self.entry != self._begun

    @property
    def is_empty(self) -> bool:
        """Whether it is a new entry in which nothing is typed yet."""
        entry = self.entry
        return self._begun == ClaimEntry() and entry == replace(
            ClaimEntry(), kind=entry.kind, severity=entry.severity
        )

    def show_entry(self, blueprint: Blueprint, entry: ClaimEntry, new: bool) -> None:
        """Show an entry; ``new`` says whether it is not written yet."""
        self._blueprint, self._begun = blueprint, entry
        self.title.setText("New" if new else "Change")
        self.apply.setText("Add" if new else "Change")
        self.copy.setVisible(not new)
        self.delete.setVisible(not new)
        self.kind.setCurrentIndex(list(KINDS).index(entry.kind))
        self.severity.setCurrentIndex(list(SEVERITIES).index(entry.severity))
        self.name.setText(entry.name)
        self.why.setText(entry.why)
        self.number.setText(entry.number)
        self.first.settle(entry.first)
        self.second.settle(entry.second)
        for field in (self.first, self.second):
            field.setCursorPosition(0)
        self.set_blueprint(blueprint)
        self._show_kind()

    def set_blueprint(self, blueprint: Blueprint) -> None:
        """Use the names of this blueprint, because the drawing has changed."""
        self._blueprint = blueprint
        self.first.set_blueprint(blueprint)
        self.second.set_blueprint(blueprint)
        self._look()

    def refuse(self, sentence: str) -> None:
        """Show why the edit was refused."""
        self.fault.setText(sentence)
        self.fault.setVisible(bool(sentence))

    def tell(self, verdict: str, words: str) -> None:
        """Show whether what stands in the fields holds. Both texts may be empty."""
        self._verdict = verdict
        tokens = self._tokens
        ink = {FAILS: tokens.bad, HOLDS: tokens.ok}.get(verdict, tokens.unk)
        self.mark.setVisible(bool(verdict))
        if verdict:
            ratio = self.devicePixelRatioF()
            self.mark.setPixmap(pixmap(PICTURES[verdict], ink, tokens.surf, 14, ratio))
        self.verdict.setText(words)
        self.verdict.setVisible(bool(words))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape leaves the form. If something was typed it goes to *Cancel*, so that one key does
        not lose it."""
        if event.key() == Qt.Key.Key_Escape and self.changed and not self.cancel.hasFocus():
            self.cancel.setFocus()
        elif event.key() == Qt.Key.Key_Escape:
            self.left.emit()
        else:
            super().keyPressEvent(event)

    @property
    def _kind(self) -> str:
        return list(KINDS)[max(self.kind.currentIndex(), 0)]

    def _kind_chosen(self) -> None:
        self._show_kind()
        self.first.setFocus()

    def _show_kind(self) -> None:
        fields, hazard = FIELDS[self._kind], self._kind == "hazard"
        self.first.formulas = fields.formulas
        for key, words in (
            ("first", fields.first), ("second", fields.second), ("number", fields.number),
            ("severity", "" if hazard else "Severity"), ("why", "" if hazard else "Why"),
        ):  # fmt: skip
            name = self._labels[key]
            name.setText(words)
            field = name.buddy()
            assert field is not None
            field.setAccessibleName(words)
            name.setVisible(bool(words))
            field.setVisible(bool(words))
        examples = {"at_most": "A name, such as Op_*", "cost": "SB/State"}
        self.first.setPlaceholderText(examples.get(self._kind, "SB/“fact” = 1 and …"))
        self.number.setPlaceholderText("any" if self._kind == "way_back" else "")
        self._look()

    def _look(self) -> None:
        """Show the sentence and the first fault of what stands in the fields."""
        if self._blueprint is None:
            return
        entry = self.entry
        fault = entry.fault(self._blueprint)
        said = entry.sentence(self._blueprint)
        self.sentence.setText(said)
        self.sentence.setVisible(bool(said))
        for key, field in (("first", self.first), ("second", self.second)):
            field.mark(fault.at if fault is not None and fault.field == key else -1)
        self.refuse(self._told(entry, fault))
        self.apply.setEnabled(fault is None)
        self.tell("", "")
        self.typed.emit(entry if fault is None or fault.field == "name" else None)

    def _told(self, entry: ClaimEntry, fault: EntryFault | None) -> str:
        """The sentence about a fault. What is only missing yet in a new entry is no fault."""
        if fault is None or entry == replace(ClaimEntry(), kind=entry.kind):
            return ""
        return fault.sentence

    def _write(self) -> None:
        if self._blueprint is not None and self.entry.fault(self._blueprint) is None:
            self.written.emit(self.entry)
