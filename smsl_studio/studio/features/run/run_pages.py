"""The pages of Run, with a row of tabs if there is more than one. Stop stays in the mode bar."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QStackedWidget, QVBoxLayout, QWidget

from smsl_studio.studio.base.controls import name_parts, row, rule
from smsl_studio.studio.base.tabs import HEIGHT, tab_bar

HOME = "One run"
HIGH = 600
"""A page of Run that is lower shows its tabs only beside a further page (pixels). Keys and menus
lead to those."""


class RunPages(QWidget):
    """The run itself, and further pages, each made when it is first shown.

    ``focus`` takes the keys of the run itself. The page that is shown takes those of the mode.
    """

    def __init__(self, home: QWidget, focus: QWidget) -> None:
        super().__init__()
        self._focus = focus
        self.setFocusProxy(focus)
        self._stack = QStackedWidget()
        self._stack.addWidget(home)
        self._make: dict[str, Callable[[], QWidget]] = {}
        self._pages = {HOME: home}
        self.bar = tab_bar()
        self.bar.setAccessibleName("Pages of Run")
        self.bar.addTab(HOME)
        self.bar.currentChanged.connect(self._show)
        self.top = QWidget()
        self.top.setProperty("role", "panel")
        across = row(self.bar)
        across.setContentsMargins(12, 0, 12, 0)
        across.addStretch(1)
        self.top.setLayout(across)
        self.top.setFixedHeight(HEIGHT)
        self._line = rule()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.top)
        column.addWidget(self._line)
        column.addWidget(self._stack, 1)
        name_parts(self)
        self._fit()

    @property
    def names(self) -> tuple[str, ...]:
        """The names on the tabs."""
        return tuple(self.bar.tabText(at) for at in range(self.bar.count()))

    @property
    def shown(self) -> str:
        """The name of the page that is shown."""
        return self.bar.tabText(self.bar.currentIndex())

    def offer(self, name: str, make: Callable[[], QWidget]) -> None:
        """Offer a page. ``make`` is called when it is first shown."""
        self._make[name] = make
        self.bar.addTab(name)
        self._fit()

    def show_page(self, name: str) -> None:
        """Show a page that is offered."""
        if name in self.names:
            self.bar.setCurrentIndex(self.names.index(name))

    def _show(self, at: int) -> None:
        name = self.bar.tabText(at) if at >= 0 else HOME
        page = self._pages.get(name)
        if page is None:
            page = self._pages[name] = self._make[name]()
            self._stack.addWidget(page)
        # A hidden page must not make the shown one larger than its room.
        for one in self._pages.values():
            policy = QSizePolicy.Policy.Preferred if one is page else QSizePolicy.Policy.Ignored
            one.setSizePolicy(policy, policy)
        self.setFocusProxy(self._focus if name == HOME else page)
        self._stack.setCurrentWidget(page)
        self._fit()

    def _fit(self) -> None:
        several = self.bar.count() > 1
        shown = several and (self.height() >= HIGH or self.shown != HOME)
        self.top.setVisible(shown)
        self._line.setVisible(shown)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the tabs out where the run needs their room."""
        super().resizeEvent(event)
        self._fit()
