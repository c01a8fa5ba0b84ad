"""F8 stops a run from anywhere in the program, even while a dialog has the keyboard focus."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication


class StopKey(QObject):
    """Filters all keys of the application while a run exists."""

    def __init__(
        self, application: QApplication, stop: Callable[[], object], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._application, self._stop = application, stop

    def listen(self, wanted: bool) -> None:
        """Begin or end filtering."""
        self._application.removeEventFilter(self)
        if wanted:
            self._application.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Stop the run on F8; nobody else receives that key."""
        pressed = event.type() == QEvent.Type.KeyPress
        if pressed and isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_F8:
            self._stop()
            return True
        # PySide may take what is watched for something else, because another object was there
        # before. Stop must not fail for that, so nothing is asked of it.
        return False
