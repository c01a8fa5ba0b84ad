"""Looks at the user's store beside the window, and tells its lines whenever they change."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from smsl_studio.front.stored_lines import StoredLine, store_stamps, stored_lines
from smsl_studio.studio.base.beside import Beside

WATCH = 2000
"""The time between two looks at the folder of the store (milliseconds)."""
NO_STORE = (None, None, None)


class StoreWatch(QObject):
    """The lines of the store, verified in a second thread.

    ``told`` hears them: first soon after the window stands, then after somebody has added,
    signed or revoked something. Without a store nothing is read, and nothing is told.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.told: Callable[[tuple[StoredLine, ...]], object] = lambda lines: None
        self._beside = Beside(self)
        self._seen: tuple[object, ...] = NO_STORE
        self._timer = QTimer(self)
        self._timer.setInterval(WATCH)
        self._timer.timeout.connect(self.look)
        self._timer.start()

    def look(self) -> None:
        """Read the store again if it has changed."""
        seen = store_stamps()
        if seen != self._seen:
            self._seen = seen
            self._beside.drop()
            self._beside.do(stored_lines, lambda lines: self.told(lines))

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._timer.stop()
        self._beside.stop()
