"""The middle of the window: one page for each mode, of which only the shown one asks for room."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QStackedWidget, QWidget

LEAST = QSize(120, 80)
"""What stays of a page in the smallest window."""


class PageBody(QScrollArea):
    """Shows one page. In a window that is too small for the page it is scrolled, never cut."""

    def __init__(self) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName("Page")
        self.pages = _Pages()
        self.setWidget(self.pages)

    def add_page(self, page: QWidget) -> None:
        """A page more; the first one is shown."""
        self.pages.addWidget(page)

    def show_page(self, page: QWidget) -> None:
        """Show a page; the panels around it take the room it does not need."""
        self.pages.setCurrentWidget(page)
        self.pages.updateGeometry()
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        """As large as the page that is shown."""
        return self.pages.sizeHint()

    def minimumSizeHint(self) -> QSize:
        """The least size of the page that is shown; a larger one is scrolled."""
        return self.pages.minimumSizeHint().boundedTo(LEAST)


class _Pages(QStackedWidget):
    """A stack whose hidden pages do not keep the window wide."""

    def sizeHint(self) -> QSize:
        """As large as the page that is shown."""
        page = self.currentWidget()
        return page.sizeHint() if page is not None else super().sizeHint()

    def minimumSizeHint(self) -> QSize:
        """The least size of the page that is shown."""
        page = self.currentWidget()
        return page.minimumSizeHint() if page is not None else super().minimumSizeHint()
