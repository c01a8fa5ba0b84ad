"""The row of pages below the mode bar. It is there while a mode has more than one page."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QTabBar, QToolBar, QWidget

from smsl_studio.studio.base.controls import name_parts, row
from smsl_studio.studio.base.feature import ModePage
from smsl_studio.studio.base.tabs import HEIGHT, Tabs

HOME = "Drawing"
"""The first page of the mode Draw."""


class PageRow(QToolBar):
    """The names of the pages of the mode Draw, with a number on some of them."""

    page_wanted = Signal(str)
    """str: the id of the page to show, such as "draw" or "merge"."""

    def __init__(self, pages: Sequence[ModePage]) -> None:
        super().__init__("Pages")
        self.setObjectName("page_row")
        self.setMovable(False)
        self.setFloatable(False)
        self._known = {page.id: page for page in pages}
        self._shown: dict[str, int] = {}
        self._current = "draw"
        self.tabs = Tabs()
        self.tabs.show_pages(False)
        self.tabs.bar.setAccessibleName("Pages")
        self.tabs.add(HOME, QWidget())
        self.tabs.bar.tabBarClicked.connect(self._clicked)
        self.tabs.bar.currentChanged.connect(self._clicked)
        inner = QWidget()
        layout = row(self.tabs)
        layout.setContentsMargins(0, 0, 0, 0)
        inner.setLayout(layout)
        self.addWidget(inner)
        name_parts(self)
        self.setFixedHeight(HEIGHT + 1)
        self.hide()

    @property
    def bar(self) -> QTabBar:
        """The tabs themselves."""
        return self.tabs.bar

    def owns(self, mode: str) -> bool:
        """Whether a mode is one of these pages."""
        return mode == "draw" or mode in self._known

    def show_page(self, page: str, count: int | None) -> None:
        """Offer a page with a number on its tab, or None to take it away."""
        words = self._known[page].words
        if count is None:
            if self._shown.pop(page, None) is not None:
                self.tabs.remove(words)
        else:
            if page not in self._shown:
                self.tabs.add(words, QWidget())
            self._shown[page] = count
            self.tabs.set_count(words, count)
        self._show()

    def show_mode(self, mode: str) -> None:
        """Mark the page that is shown."""
        self._current = mode
        self._show()

    def _show(self) -> None:
        here = self.owns(self._current)
        self.setVisible(here and bool(self._shown))
        if here and (self._current == "draw" or self._current in self._shown):
            name = HOME if self._current == "draw" else self._known[self._current].words
            blocked = self.bar.blockSignals(True)
            self.tabs.show_page(name)
            self.bar.blockSignals(blocked)

    def _clicked(self, at: int) -> None:
        if 0 <= at < len(self.tabs.names):
            name = self.tabs.names[at]
            page = next((one for one in self._shown if self._known[one].words == name), "draw")
            if page != self._current:
                self.page_wanted.emit(page)
