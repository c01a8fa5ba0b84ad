"""What stands below a table: one of several pages, as high as it needs."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QSplitter, QStackedWidget, QWidget

TABLE = 90
"""The height that the table keeps for its head and two rows (pixels)."""


class LowerPart(QObject):
    """Shows a page below a table, and gives the rest of the height to the table.

    Both keep the heights that a person has given them.
    """

    def __init__(self, parts: QSplitter, pages: QStackedWidget, most: int) -> None:
        """``most`` is the greatest height of the pages (pixels)."""
        super().__init__(parts)
        self._parts, self._pages, self._most = parts, pages, most
        self._wanted, self._by_hand = most, False
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self._settle)
        parts.installEventFilter(self)
        parts.splitterMoved.connect(self._moved)

    def show(self, page: QWidget, height: int) -> None:
        """Show a page that needs a height (pixels)."""
        self._pages.setCurrentWidget(page)
        self._wanted = min(height, self._most)
        self._settle()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Divide another height anew."""
        if event.type() == QEvent.Type.Resize:
            self._later.start(0)
        return False

    def _moved(self) -> None:
        self._by_hand = True

    def _settle(self) -> None:
        whole = sum(self._parts.sizes())
        low = min(self._wanted, max(whole - TABLE, whole * 6 // 11))
        if whole and not self._by_hand and self._parts.sizes()[1] != low:
            self._parts.setSizes([whole - low, low])
