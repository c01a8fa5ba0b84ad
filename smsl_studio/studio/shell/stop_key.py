"""F8 stops a run from anywhere in the program, also where a dialog holds the keys."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication


class StopKey(QObject):
    """Sees every key of the application while a run exists, and none otherwise."""

    def __init__(
        self, application: QApplication, stop: Callable[[], object], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._application, self._stop = application, stop

    def listen(self, wanted: bool) -> None:
        """Listen while a run exists."""
        self._application.removeEventFilter(self)
        if wanted:
            self._application.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """F8 stops the run, and nobody else hears of that key."""
        pressed = event.type() == QEvent.Type.KeyPress
        if pressed and isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_F8:
            self._stop()
            return True
        return super().eventFilter(watched, event)
