"""The box in which a decision is asked once more: Enter does it, Escape lets it be."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QLineEdit, QPushButton, QVBoxLayout

from smsl_studio.studio.controls import label
from smsl_studio.studio.supervise.decisions import Decision
from smsl_studio.studio.words import as_it_is, capital


class Asking(QFrame):
    """Takes no room while nothing is to be decided."""

    confirmed = Signal(object, str)
    """(the decision, the reason that was given)."""
    dropped = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("asking")
        self.setAccessibleName("Decision")
        self.decision: Decision | None = None
        self._sentence, self._detail = label("", "strong"), label("", "hint")
        self._sentence.setWordWrap(True)
        self.reason = QLineEdit()
        self.reason.setPlaceholderText("Why, for the record")
        self.reason.setAccessibleName("Reason")
        self.reason.textEdited.connect(lambda _: self.refuse(""))
        self._refusal = label("", "refusal")
        self.do = QPushButton("Do it")
        self.do.setProperty("role", "primary")
        self.do.clicked.connect(self.confirm)
        self.leave = QPushButton("Let it be")
        self.leave.clicked.connect(self.drop)
        self._keys = (_key("Enter"), _key("Esc"))
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 10, 12, 12)
        column.setSpacing(6)
        for part in (self._sentence, self._detail, self.reason, self._refusal):
            column.addWidget(part)
        across = QHBoxLayout()
        across.setSpacing(6)
        for button, key in ((self.do, self._keys[0]), (self.leave, self._keys[1])):
            across.addWidget(button)
            across.addWidget(key)
        across.addStretch(1)
        column.addSpacing(2)
        column.addLayout(across)
        self.hide()

    @property
    def words(self) -> str:
        """Everything that is said, in one line."""
        parts = (self._sentence, self._detail, self._refusal)
        return " ".join(part.text() for part in parts if not part.isHidden() and part.text())

    def show_decision(self, decision: Decision | None) -> None:
        """Ask for one decision, or for none."""
        if decision == self.decision:
            return
        anew = decision is None or self.decision is None or (
            decision.command, decision.address
        ) != (self.decision.command, self.decision.address)  # fmt: skip
        self.decision = decision
        self.setVisible(decision is not None)
        if decision is None:
            return
        _say(self._sentence, decision.sentence)
        _say(self._detail, decision.detail)
        self.reason.setVisible(decision.reasoned)
        self.do.setText(as_it_is(decision.verb))
        for part in (self.do, self._keys[0]):
            part.setVisible(bool(decision.verb))
        self.leave.setText("Let it be" if decision.verb else "Close")
        if anew:
            self.refuse("")
            self.reason.clear()

    def take_focus(self) -> None:
        """Lead the keys here: to the reason where one is needed, else to what Enter does."""
        decision = self.decision
        if decision is not None:
            part = self.reason if decision.reasoned else self.do if decision.verb else self.leave
            part.setFocus()

    def refuse(self, why: str) -> None:
        """Say why it was not done; the decision stays open."""
        _say(self._refusal, capital(why))

    def confirm(self) -> None:
        """Do it, if it can be done and its reason is given."""
        decision = self.decision
        if decision is None or not decision.verb:
            return
        reason = self.reason.text().strip()
        if decision.reasoned and not reason:
            self.refuse("A reason is needed: it stands in the record")
            self.reason.setFocus()
            return
        self.confirmed.emit(decision, reason)

    def drop(self) -> None:
        self.show_decision(None)
        self.dropped.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter in it does it, or leaves where that button has the focus; Escape leaves."""
        enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if event.key() == Qt.Key.Key_Escape or (enter and self.leave.hasFocus()):
            self.drop()
        elif enter:
            self.confirm()
        else:
            super().keyPressEvent(event)


def _say(part: QLabel, words: str) -> None:
    part.setText(words)
    part.setVisible(bool(words))


def _key(words: str) -> QLabel:
    made = label(words, "key")
    made.setAlignment(Qt.AlignmentFlag.AlignCenter)
    return made
