"""The card that tells what a change of the facts does to the states, and asks for a yes."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, Field, label, row
from smsl_studio.studio.base.theme import mono_font
from smsl_studio.studio.features.draw.facts.proposals import FactChange

SHOWN = 4
"""So many states are named; the number of the others follows."""


class ChangeCard(QFrame):
    """A proposal with its effect on the states. Enter agrees, Escape gives it up."""

    agreed = Signal(object)
    """FactChange: the person wants it."""
    closed = Signal()
    shown = Signal(bool)
    """Whether the card is there now."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "float")
        self.setAccessibleName("Change of the facts")
        self._proposal: FactChange | None = None
        self._again: Callable[[str], FactChange] | None = None
        self.words = label("", "second")
        self.words.setWordWrap(True)
        self.names = [Elided() for _ in range(SHOWN)]
        self.rest = label("", "hint")
        self._value_words = label("Its value in them", "small")
        self.value = Field()
        self.value.setAccessibleName("Value of the new fact in all states")
        self.value.setFixedWidth(64)
        self.agree, self.cancel = QPushButton("Agree"), QPushButton("Cancel")
        self.agree.setProperty("role", "primary")
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 10, 12, 10)
        column.setSpacing(4)
        column.addWidget(self.words)
        for one in self.names:
            one.setFont(mono_font(12))
            column.addWidget(one)
        column.addWidget(self.rest)
        column.addLayout(row(self._value_words, self.value, None))
        column.addSpacing(4)
        column.addLayout(row(self.agree, self.cancel, None))
        self.agree.clicked.connect(self._agree)
        self.cancel.clicked.connect(self.close_card)
        self.value.textEdited.connect(self._value_typed)
        self.hide()

    @property
    def proposal(self) -> FactChange | None:
        """What is proposed now; None if the card is closed."""
        return self._proposal

    def propose(
        self, proposal: FactChange, again: Callable[[str], FactChange] | None = None
    ) -> None:
        """Show a proposal. ``again`` gives the proposal with another value of the new fact."""
        self._again = again
        for widget in (self._value_words, self.value):
            widget.setVisible(again is not None)
        self.value.settle("")
        self.value.setPlaceholderText("0")
        self._show(proposal)
        self.show()
        self.shown.emit(True)
        (self.agree if self.agree.isEnabled() else self.cancel).setFocus()

    def close_card(self) -> None:
        """Give the proposal up."""
        if self._proposal is not None:
            self._proposal = None
            self.hide()
            self.shown.emit(False)
            self.closed.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter agrees, Escape gives up."""
        if event.key() == Qt.Key.Key_Escape:
            self.close_card()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            (self.close_card if self.cancel.hasFocus() else self._agree)()
        else:
            super().keyPressEvent(event)

    def _show(self, proposal: FactChange) -> None:
        self._proposal = proposal
        self.words.setText(proposal.sentence)
        self.words.setProperty("role", "refusal" if proposal.fault else "second")
        self.words.style().unpolish(self.words)
        self.words.style().polish(self.words)
        for at, one in enumerate(self.names):
            shown = at < len(proposal.names)
            one.setVisible(shown)
            if shown:
                one.setText("{} → {}".format(*proposal.names[at]))
        rest = len(proposal.names) - SHOWN
        self.rest.setText(f"and {rest:,} more")
        self.rest.setVisible(rest > 0)
        self.agree.setText(plain_text(proposal.verb))
        self.agree.setEnabled(not proposal.fault)

    def _value_typed(self, text: str) -> None:
        if self._again is not None:
            self._show(self._again(text))

    def _agree(self) -> None:
        proposal = self._proposal
        if proposal is not None and not proposal.fault:
            self._proposal = None
            self.hide()
            self.shown.emit(False)
            self.agreed.emit(proposal)
