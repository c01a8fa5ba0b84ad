"""The middle of the window: one page for each mode, of which only the shown one asks for room."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QStackedWidget, QWidget


class Body(QStackedWidget):
    """A stack whose hidden pages do not keep the window wide."""

    def show_page(self, page: QWidget) -> None:
        """Show a page; the panels around it take the room it does not need."""
        self.setCurrentWidget(page)
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        page = self.currentWidget()
        return page.sizeHint() if page is not None else super().sizeHint()

    def minimumSizeHint(self) -> QSize:
        page = self.currentWidget()
        return page.minimumSizeHint() if page is not None else super().minimumSizeHint()
