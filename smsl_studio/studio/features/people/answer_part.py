"""The lower part of a task card: who answers, what is missing, and the button that decides."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.front.views.card_view import CardView, OptionView
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.theme import CONTROL_DECISION
from smsl_studio.studio.features.people.who import Who
from smsl_studio.studio.running.persons import Persons

CHOOSE, WHO, PIN = "Choose an answer", "Say who you are", "Type your PIN"


class Decide(QPushButton):
    """A button that Enter presses, but only once while the key is held."""

    def sizeHint(self) -> QSize:
        """The usual width, and the height of a decision button."""
        return QSize(super().sizeHint().width(), CONTROL_DECISION)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press the button on Enter, but not again while the key is held."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            if not event.isAutoRepeat():
                self.click()
            return
        super().keyPressEvent(event)


class AnswerPart(QWidget):
    """Says what is missing for an answer, and emits ``decided`` when nothing is."""

    decided = Signal()

    def __init__(self, persons: Persons) -> None:
        super().__init__()
        self.who = Who(persons)
        self.objection = Sentence("hint")
        self.refusal = Sentence("refusal")
        self.button = Decide(CHOOSE)
        self.button.setProperty("role", "primary")
        self.button.setEnabled(False)
        self._persons = persons
        self.enter = QPushButton("Enter who works here…")
        self.enter.setToolTip("No person is entered yet: add the name, role and PIN of who answers")
        self.enter.clicked.connect(self.who.edit_wanted)
        column = self._column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        for part in (
            self.who,
            self.objection,
            self.enter,
            self.refusal,
            self.button,
        ):
            column.addWidget(part)
        self.button.clicked.connect(self.decided)
        self.who.pin.returnPressed.connect(self._pin_typed)

    def put_who(self, place: QVBoxLayout | None) -> None:
        """Put what says who answers into another layout. None puts it back at the top here."""
        for at, part in enumerate((self.who, self.objection, self.enter)):
            (place or self._column).insertWidget(at, part)

    def show_card(self, card: CardView, chosen: OptionView | None, refusal: str) -> None:
        """Show this card's lower part; ``chosen`` is the selected option."""
        self.objection.say(card.objection)
        self.enter.setVisible(not self._persons.all)
        self.refusal.say(refusal)
        ready, words = self._state(card, chosen)
        self.button.setEnabled(ready)
        self.button.setText(words)
        self.button.setAccessibleName(plain_text(words))

    def _state(self, card: CardView, chosen: OptionView | None) -> tuple[bool, str]:
        if self.who.person is None or card.objection:
            return False, WHO
        if chosen is None:
            return False, CHOOSE
        if not self.who.opens():
            return False, PIN
        return True, f"{_short(chosen.words)}: press Enter"

    def _pin_typed(self) -> None:
        """After Enter in the PIN field move the focus to the button; the next Enter decides."""
        if self.button.isEnabled():
            self.button.setFocus()


def _short(words: str) -> str:
    return words if len(words) <= 28 else f"{words[:27].rstrip()}…"
