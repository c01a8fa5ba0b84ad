"""F1 in the dialogs and other windows that stand beside a window of the program."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QWidget


class HelpKey(QObject):
    """Lends the action of F1 to each window below ``window`` that gets the keyboard focus."""

    def __init__(self, action: QAction, window: QWidget) -> None:
        super().__init__(window)
        self._action, self._window = action, window
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._moved)

    def _moved(self, _: QWidget | None, now: QWidget | None) -> None:
        if now is None:
            return
        page = now.window()
        if page is not self._window and self._action not in page.actions() and self._owns(page):
            page.addAction(self._action)

    def _owns(self, page: QWidget) -> bool:
        owner = page.parentWidget()
        while owner is not None and owner is not self._window:
            owner = owner.parentWidget()
        return owner is self._window
