"""The answers of a task as rows; at most one is selected."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QButtonGroup, QVBoxLayout, QWidget

from smsl_studio.front.views.card_view import OptionView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.option_row import OptionRow


class Answers(QWidget):
    """The rows of options. Selecting one decides nothing yet.

    ``settled`` says that a key selected one, so the focus should go on to the button.
    """

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
        """Use the colours of another theme."""
        self._tokens = tokens
        for row in self.rows:
            row.set_tokens(tokens)

    @property
    def chosen(self) -> OptionView | None:
        """The selected option; None if there is none."""
        row = self._group.checkedButton()
        return row.option if isinstance(row, OptionRow) else None

    def put(self, options: tuple[OptionView, ...]) -> None:
        """Show these options with none selected."""
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
        """Select no option. The group must not be exclusive for that."""
        self._group.setExclusive(False)
        for row in self.rows:
            row.setChecked(False)
        self._group.setExclusive(True)

    def open(self, may_answer: bool) -> None:
        """Enable the options if the chosen person may answer."""
        for row in self.rows:
            row.setEnabled(may_answer)

    def take_focus(self) -> None:
        """Give the keyboard focus to the first row, without selecting it."""
        if self.rows:
            self.rows[0].setFocus()

    def press(self, letter: str) -> bool:
        """Select the option with this letter; returns whether there is one."""
        for row in self.rows:
            if letter and row.option.letter == letter.upper() and row.isEnabled():
                self._settle(row)
                return True
        return False

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Select a row on Enter; the next Enter decides."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
            if isinstance(watched, OptionRow) and enter and not event.isAutoRepeat():
                self._settle(watched)
                return True
        return super().eventFilter(watched, event)

    def _settle(self, row: OptionRow) -> None:
        # The focus goes along, so that Enter never selects another row than the one just chosen.
        row.setFocus()
        row.setChecked(True)
        self.settled.emit()
