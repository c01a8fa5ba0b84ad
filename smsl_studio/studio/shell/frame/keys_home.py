"""Where the keys of a window are at home: they come back there from what is gone, and act there.

Qt hands the focus of a widget that hides or is disabled on to the next one in its chain. That may
be a mode button at the other end of the window, and a key for the run would do nothing then, or
leave the mode.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget
from shiboken6 import isValid

from smsl_studio.studio.shell.frame.modes import DRAW, Modes

HEARD = "supervise"
"""In this mode letters and digits are commands, except while somebody types text."""


class KeysHome(QObject):
    """Gives the keys of a window to what takes them in its mode.

    ``bars`` are around the page. In Draw the keys may go on to the next field of a form, but not
    from one that is gone to a bar.
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
        """A letter or digit that no widget used goes to the page, also if a button of a bar has the
        focus."""
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
        # What the page does not take comes up to the window, and is heard once only.
        self._heard = True
        QApplication.sendEvent(self._modes.home, event)
        self._heard = False
        return True
