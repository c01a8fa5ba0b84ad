"""The size of a window on its screen, including the frame that the desktop draws around it."""

from __future__ import annotations

from PySide6.QtCore import QByteArray, QObject, QPoint, QRect, QSize, QTimer
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.screens import room

SIZE, SMALLEST = QSize(1440, 900), QSize(900, 560)
FRAME_MS, TRIES = 200, 12
"""How long to wait for the desktop to draw the frame around a new window (milliseconds), and how
often to try. A busy desktop takes longer."""


class ScreenRoom(QObject):
    """Keeps a window with its frame on its screen."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window, self._shown = window, False
        self._tries = TRIES
        self._first = QSize()
        """The size of the window before its frame was known."""
        self.limit()

    def shown(self) -> None:
        """The window was shown: follow it to other screens, and fit it when its frame is known."""
        handle = self._window.windowHandle()
        if not self._shown and handle is not None:
            self._shown = True
            handle.screenChanged.connect(self.limit)
            QTimer.singleShot(FRAME_MS, self, self._look)

    def _look(self) -> None:
        """Fit the window into the screen. Try again later if its frame is not known yet."""
        self.fit()
        self._tries -= 1
        if self._tries and self._window.frameGeometry() == self._window.geometry():
            QTimer.singleShot(FRAME_MS, self, self._look)

    def limit(self) -> None:
        """Set the smallest size of the window, limited to its screen."""
        self._window.setMinimumSize(SMALLEST.boundedTo(self._inner()))

    def restore(self, remembered: QByteArray) -> None:
        """Restore the remembered size and place, else use the first size."""
        self._window.resize(SIZE.boundedTo(self._inner()))
        self._window.restoreGeometry(remembered)
        self._first = self._window.size()

    def fit(self) -> None:
        """Move and shrink the window into the screen, now that its frame is known.

        A window that a person or the desktop has resized meanwhile stays as it is.
        """
        window = self._window
        sized = window.size() != self._first
        # The real frame may be smaller than estimated, so the limit may grow.
        self.limit()
        if sized or window.isMaximized() or window.isFullScreen():
            return
        screen, frame = self._screen(), window.frameGeometry()
        if not screen.intersects(frame):
            return
        wanted = window.size().boundedTo(self._inner())
        if wanted != window.size():
            window.resize(wanted)
            self._first = wanted
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
    """The start nearest to ``at`` with which a length fits between ``start`` and ``start +
    room``."""
    return max(start, min(at, start + room - wide))
