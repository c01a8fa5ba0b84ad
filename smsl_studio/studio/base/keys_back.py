"""KeysBack: when a part with the keyboard focus hides, the focus returns to where it was."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QWidget
from shiboken6 import isValid


class KeysBack(QObject):
    """Watches one part that comes and goes, such as a bar with a question.

    Without it Qt moves the focus to the next widget in the order of Tab. A person who has answered
    a question would then type into a button.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self._part = part
        self._before: QWidget | None = None
        part.installEventFilter(self)
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._moved)

    def _moved(self, before: QWidget | None, now: QWidget | None) -> None:
        if before is None or now is None or not isValid(before) or not isValid(now):
            return
        if self._part.isAncestorOf(now) and not self._part.isAncestorOf(before):
            self._before = before

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Return the focus when the part hides."""
        if watched is self._part and event.type() == QEvent.Type.Hide:
            self._give_back()
        return super().eventFilter(watched, event)

    def _give_back(self) -> None:
        before, self._before = self._before, None
        focus = QApplication.focusWidget()
        if focus is None or not self._part.isAncestorOf(focus):
            return
        if before is not None and isValid(before) and before.isVisible() and before.isEnabled():
            before.setFocus()
