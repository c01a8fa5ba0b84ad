"""The answers of a task as rows, of which none or one is chosen."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QButtonGroup, QVBoxLayout, QWidget

from smsl_studio.front.views.card_view import OptionView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.option_row import OptionRow


class Answers(QWidget):
    """A choice is no decision yet: ``settled`` says that a key leads on to the button."""

    changed = Signal()
    settled = Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.rows: list[OptionRow] = []
        self._group = QButtonGroup(self)
        self._group.buttonToggled.connect(lambda *_: self.changed.emit())
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(8)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take the colours of another theme."""
        self._tokens = tokens
        for row in self.rows:
            row.set_tokens(tokens)

    @property
    def chosen(self) -> OptionView | None:
        """The option that is chosen; None while none is."""
        row = self._group.checkedButton()
        return row.option if isinstance(row, OptionRow) else None

    def put(self, options: tuple[OptionView, ...]) -> None:
        """Show these, none of them chosen."""
        for row in self.rows:
            self._group.removeButton(row)
            row.hide()
            row.deleteLater()
        self.rows = [OptionRow(option, self._tokens) for option in options]
        for row in self.rows:
            self._group.addButton(row)
            self._column.addWidget(row)
            row.installEventFilter(self)

    def clear(self) -> None:
        """No answer is chosen any more; a group of one choice keeps its last one otherwise."""
        self._group.setExclusive(False)
        for row in self.rows:
            row.setChecked(False)
        self._group.setExclusive(True)

    def open(self, may_answer: bool) -> None:
        """Whether the person who is chosen may choose anything."""
        for row in self.rows:
            row.setEnabled(may_answer)

    def take_focus(self) -> None:
        """Lead the keys to the first row, with nothing chosen."""
        if self.rows:
            self.rows[0].setFocus()

    def press(self, letter: str) -> bool:
        """Choose the answer of a letter; whether there is one."""
        for row in self.rows:
            if letter and row.option.letter == letter.upper() and row.isEnabled():
                self._settle(row)
                return True
        return False

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Enter on a row chooses it; one Enter more decides."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
            if isinstance(watched, OptionRow) and enter and not event.isAutoRepeat():
                self._settle(watched)
                return True
        return super().eventFilter(watched, event)

    def _settle(self, row: OptionRow) -> None:
        row.setChecked(True)
        self.settled.emit()
