"""ChoiceButton: a button whose press makes something move, so a double click counts once."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPointF
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QApplication, QPushButton

from smsl_studio.studio.base.tips import tip_text


class DoublePress:
    """Knows the second press of a double click, also where it meets another button.

    In a list that changes after a choice, the next operation can come below the pointer before the
    second press. Qt calls that press a new one, so its time and place are compared here.
    """

    def __init__(self) -> None:
        self._last: tuple[int, QPointF] | None = None

    def is_second(self, event: QMouseEvent) -> bool:
        """Whether this press follows another one as in a double click. Called for each press."""
        before, now, at = self._last, event.timestamp(), event.globalPosition()
        self._last = now, at
        if event.type() == QEvent.Type.MouseButtonDblClick:
            return True
        if before is None or now - before[0] >= QApplication.doubleClickInterval():
            return False
        return (at - before[1]).manhattanLength() < QApplication.startDragDistance()


class ChoiceButton(QPushButton):
    """A low button for one operation. ``presses`` is shared by the buttons of a list."""

    def __init__(self, words: str, tip: str, presses: DoublePress) -> None:
        super().__init__(words)
        self._presses = presses
        self.setProperty("role", "row")
        self.setToolTip(tip_text(tip))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Press the button, but not by the second press of a double click."""
        if self._presses.is_second(event):
            event.accept()
        else:
            super().mousePressEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press the button, but not again while the key is held."""
        if event.isAutoRepeat():
            event.accept()
        else:
            super().keyPressEvent(event)
