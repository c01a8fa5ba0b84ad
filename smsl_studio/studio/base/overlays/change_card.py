"""The card that tells what a change does to many places, and asks for a yes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, Field, label, row
from smsl_studio.studio.base.theme import mono_font

SHOWN = 4
"""So many lines are shown; the number of the others follows."""


class ProposedChange(Protocol):
    """A change that waits for a yes."""

    @property
    def sentence(self) -> str:
        """What it does, with numbers; or why it cannot be done."""

    @property
    def lines(self) -> Sequence[str]:
        """What becomes of each place, such as ``State_0 → State_00``."""

    @property
    def verb(self) -> str:
        """The word on the button."""

    @property
    def fault(self) -> str:
        """Why it cannot be done; empty if it can."""

    @property
    def ready(self) -> bool:
        """Whether it can be done as it is: without a fault, and with all that is asked for."""


@dataclass(frozen=True)
class AskedValue:
    """The field of a card: its words, its name for screen readers, and what it shows if empty."""

    words: str
    name: str
    hint: str = ""


NOTHING_ASKED = AskedValue("", "")


class ChangeCard(QFrame):
    """A proposal with its effect on each place. Enter agrees, Escape gives it up."""

    agreed = Signal(object)
    """ProposedChange: the person wants it."""
    closed = Signal()
    shown = Signal(bool)
    """Whether the card is there now."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "float")
        self.setAccessibleName(plain_text(name))
        self._proposal: ProposedChange | None = None
        self._again: Callable[[str], ProposedChange] | None = None
        self.words = label("", "second")
        self.words.setWordWrap(True)
        self.names = [Elided() for _ in range(SHOWN)]
        self.rest = label("", "hint")
        self._value_words = label("", "small")
        self.value = Field()
        self.value.setAccessibleName(plain_text(name))
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
    def proposal(self) -> ProposedChange | None:
        """What is proposed now; None if the card is closed."""
        return self._proposal

    def propose(
        self,
        proposal: ProposedChange,
        again: Callable[[str], ProposedChange] | None = None,
        asked: AskedValue = NOTHING_ASKED,
    ) -> None:
        """Show a proposal. ``again`` gives the proposal with another text in the field ``asked``,
        which has the keys if the first proposal cannot be done.
        """
        self._again = again
        for widget in (self._value_words, self.value):
            widget.setVisible(again is not None)
        self._value_words.setText(asked.words)
        self.value.settle("")
        self.value.setAccessibleName(plain_text(asked.name))
        self.value.setPlaceholderText(asked.hint)
        self._show(proposal)
        self.show()
        self.shown.emit(True)
        first = self.value if again is not None else self.cancel
        (self.agree if proposal.ready else first).setFocus()

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

    def _show(self, proposal: ProposedChange) -> None:
        self._proposal = proposal
        self.words.setText(proposal.sentence)
        self.words.setProperty("role", "refusal" if proposal.fault else "second")
        self.words.style().unpolish(self.words)
        self.words.style().polish(self.words)
        for at, one in enumerate(self.names):
            shown = at < len(proposal.lines)
            one.setVisible(shown)
            if shown:
                one.setText(proposal.lines[at])
        rest = len(proposal.lines) - SHOWN
        self.rest.setText(f"and {rest:,} more")
        self.rest.setVisible(rest > 0)
        self.agree.setText(plain_text(proposal.verb))
        self.agree.setEnabled(proposal.ready)

    def _value_typed(self, text: str) -> None:
        if self._again is not None:
            self._show(self._again(text))

    def _agree(self) -> None:
        proposal = self._proposal
        if proposal is not None and proposal.ready:
            self._proposal = None
            self.hide()
            self.shown.emit(False)
            self.agreed.emit(proposal)
