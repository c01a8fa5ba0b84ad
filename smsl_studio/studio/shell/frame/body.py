"""The middle of the window: one page for each mode. Only the visible page asks for room."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QStackedWidget, QWidget

LEAST = QSize(120, 80)
"""The size of a page in the smallest window."""


class PageBody(QScrollArea):
    """Shows one page. If the window is too small for it, the page scrolls."""

    def __init__(self) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName("Page")
        self.pages = _Pages()
        self.setWidget(self.pages)

    def add_page(self, page: QWidget) -> None:
        """Add a page. The first one is shown."""
        self.pages.addWidget(page)

    def show_page(self, page: QWidget) -> None:
        """Show a page. The panels around it take the room that it does not need."""
        self.pages.setCurrentWidget(page)
        self.pages.updateGeometry()
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        """The size of the visible page."""
        return self.pages.sizeHint()

    def minimumSizeHint(self) -> QSize:
        """The smallest size of the visible page, limited to ``LEAST``, because a page can
        scroll."""
        return self.pages.minimumSizeHint().boundedTo(LEAST)


class _Pages(QStackedWidget):
    """A stack in which hidden pages do not keep the window wide."""

    def sizeHint(self) -> QSize:
        """The size of the visible page."""
        page = self.currentWidget()
        return page.sizeHint() if page is not None else super().sizeHint()

    def minimumSizeHint(self) -> QSize:
        """The smallest size of the visible page."""
        page = self.currentWidget()
        return page.minimumSizeHint() if page is not None else super().minimumSizeHint()
