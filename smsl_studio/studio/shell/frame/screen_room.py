"""How large a window may be on its screen, with the frame that the desktop draws around it."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, QObject, QPoint, QRect, QSize, QTimer
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.screens import room

SIZE, SMALLEST = QSize(1440, 900), QSize(900, 560)
FRAME_MS = 200
"""After how long a desktop has drawn the frame around a window that it shows."""


class ScreenRoom(QObject):
    """Keeps a window, frame and all, on the screen that it is on."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window, self._shown = window, False
        self._first = QSize()
        """The size that was chosen before the frame was known."""
        self.limit()

    def shown(self) -> None:
        """The window is on a screen: follow it to others, and look at the frame it gets."""
        handle = self._window.windowHandle()
        if not self._shown and handle is not None:
            self._shown = True
            handle.screenChanged.connect(self.limit)
            QTimer.singleShot(FRAME_MS, self, self.fit)

    def limit(self) -> None:
        """Let the window be as small as the screen, where that is smaller than we wish."""
        self._window.setMinimumSize(SMALLEST.boundedTo(self._inner()))

    def restore(self, remembered: QByteArray) -> None:
        """Give the window the size and place it had, else its first size."""
        self._window.resize(SIZE.boundedTo(self._inner()))
        self._window.restoreGeometry(remembered)
        self._first = self._window.size()

    def fit(self) -> None:
        """Once the frame is known: take back what lies beyond the screen.

        A window that was sized since, by a person or a desktop, stays as it is.
        """
        window = self._window
        sized = window.size() != self._first
        # A frame that is smaller than it was taken for may let the least size grow.
        self.limit()
        if sized or window.isMaximized() or window.isFullScreen():
            return
        screen, frame = self._screen(), window.frameGeometry()
        if not screen.intersects(frame):
            return
        wanted = window.size().boundedTo(self._inner())
        if wanted != window.size():
            window.resize(wanted)
        corner = QPoint(
            _inside(
                frame.left(), wanted.width() + self._frame().width(), screen.x(), screen.width()
            ),
            _inside(
                frame.top(), wanted.height() + self._frame().height(), screen.y(), screen.height()
            ),
        )
        if corner != frame.topLeft():
            window.move(corner)

    def _screen(self) -> QRect:
        return self._window.screen().availableGeometry()

    def _inner(self) -> QSize:
        return room(self._window)

    def _frame(self) -> QSize:
        return self._screen().size() - self._inner()


def _inside(at: int, wide: int, start: int, room: int) -> int:
    """Where something so wide begins, moved as little as needed to lie in the room."""
    return max(start, min(at, start + room - wide))
