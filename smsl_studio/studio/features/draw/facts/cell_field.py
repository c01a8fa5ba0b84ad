"""The field over a cell of the table of facts."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent

from smsl_studio.studio.base.controls import Field

Key = Qt.Key


class CellField(Field):
    """The field in which the text of a cell is typed.

    ``ended`` carries where the keys go then: -1 or 1 to the cell before or after, 0 to the list.
    """

    ended = Signal(int)
    given_up = Signal()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter takes the text, Escape gives it up."""
        if event.key() in (Key.Key_Return, Key.Key_Enter):
            self.ended.emit(0)
        elif event.key() == Key.Key_Escape:
            self.given_up.emit()
        else:
            super().keyPressEvent(event)

    def focusNextPrevChild(self, next_: bool) -> bool:
        """Tab and Shift+Tab go to the cells beside this one."""
        self.ended.emit(1 if next_ else -1)
        return True
