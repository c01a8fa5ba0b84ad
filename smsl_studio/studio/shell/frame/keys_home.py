"""The keyboard focus of a window returns to the page of its mode.

Qt gives the focus of a hidden or disabled widget to the next one in its chain. That may be a mode
button at the other end of the window. A key for the run would then do nothing, or change the mode.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget
from shiboken6 import isValid

from smsl_studio.studio.shell.frame.modes import DRAW, Modes

HEARD = "supervise"
"""In this mode letters and digits are commands, unless somebody types text."""


class KeysHome(QObject):
    """Returns the keyboard focus to the widget that takes the keys of the mode.

    ``bars`` are the bars around the page. In Draw mode the focus may go on to the next field of a
    form, but not from a vanished widget to a bar.
    """

    def __init__(self, modes: Modes, bars: tuple[QWidget, ...], window: QWidget) -> None:
        super().__init__(window)
        self._modes, self._bars, self._window = modes, bars, window
        self._heard = False
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._moved)
        window.installEventFilter(self)

    def _moved(self, before: QWidget | None, now: QWidget | None) -> None:
        if before is None or not isValid(before) or before.window() is not self._window:
            return
        if before.isVisible() and before.isEnabled():
            return
        if now is not None and now.window() is not self._window:
            return
        in_bar = any(bar.isAncestorOf(now) for bar in self._bars) if now is not None else True
        if self._window.isVisible() and (in_bar or self._modes.shown != DRAW):
            self._modes.take_focus()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Send a letter or digit that no widget used to the page, even if a button in a bar has
        the focus."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            return self._hear(event)
        return super().eventFilter(watched, event)

    def _hear(self, event: QKeyEvent) -> bool:
        text, typing = event.text().strip(), isinstance(QApplication.focusWidget(), QLineEdit)
        if (
            self._heard
            or typing
            or self._modes.shown != HEARD
            or not text.isprintable()
            or not text
        ):
            return False
        # A key that the page ignores comes back to the window, and must not be sent again.
        self._heard = True
        QApplication.sendEvent(self._modes.home, event)
        self._heard = False
        return True
