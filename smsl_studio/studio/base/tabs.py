"""Tabs of panels, with numbers on the tabs and tools at their right."""

from __future__ import annotations

from functools import partial
from weakref import ref

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtWidgets import (
    QApplication,
    QHBoxLayout,
    QLabel,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.studio.base.announcement import tell_name
from smsl_studio.studio.base.controls import label, rule

HEIGHT = 36
MARGIN = 12
"""Pixels between two tabs; the style sheet has the same number."""


def tab_bar() -> QTabBar:
    """A bar of tabs that are as wide as their names, with no line below them."""
    bar = QTabBar()
    bar.setDrawBase(False)
    bar.setExpanding(False)
    bar.setUsesScrollButtons(False)
    bar.setElideMode(Qt.TextElideMode.ElideNone)
    bar.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    # A bar without a name of its own is called as its chosen tab.
    bar.currentChanged.connect(partial(_renamed, ref(bar)))
    return bar


def _renamed(bar: ref[QTabBar], _: int) -> None:
    shown = bar()
    if shown is not None:
        tell_name(shown)


class Tabs(QWidget):
    """A stack of panels with tabs. Tools belong to a panel and are visible with it."""

    changed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.bar = tab_bar()
        self._pages = QStackedWidget()
        self._tools: dict[int, QWidget] = {}
        self._names: list[str] = []
        self._bare = False
        self._top = QHBoxLayout()
        self._top.setContentsMargins(10, 0, 4, 0)
        self._top.setSpacing(0)
        self._top.addWidget(self.bar, 0, Qt.AlignmentFlag.AlignBottom)
        self._top.addStretch(1)
        head = QWidget()
        head.setLayout(self._top)
        head.setFixedHeight(HEIGHT)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(head)
        self._rule = rule()
        layout.addWidget(self._rule)
        layout.addWidget(self._pages, 1)
        self.bar.currentChanged.connect(self._show)

    def add(self, name: str, page: QWidget, tools: QWidget | None = None) -> None:
        """Add a panel under a tab."""
        at = self._pages.addWidget(page)
        self._names.append(name)
        if tools is not None:
            self._tools[at] = tools
            self._top.insertWidget(1 + len(self._tools), tools)
        self.bar.addTab(name)
        self._show(self.bar.currentIndex())

    def remove(self, name: str) -> None:
        """Remove a panel and its tab."""
        at = self._names.index(name)
        self.set_count(name, 0)
        page = self.page(name)
        self._names.pop(at)
        self.bar.removeTab(at)
        self._pages.removeWidget(page)
        page.deleteLater()

    def leave_out_tools(self, left_out: bool) -> None:
        """Hide the tools if the tabs need all the space, or show them again."""
        self._bare = left_out
        self._show(self.bar.currentIndex())

    def set_close(self, close: bool) -> None:
        """Put the tabs close together if there is little space, or at their usual distance."""
        if close == (self.bar.property("role") == "close"):
            return
        self.bar.setProperty("role", "close" if close else "")
        self.bar.style().unpolish(self.bar)
        self.bar.style().polish(self.bar)

    def add_button(self, button: QWidget) -> None:
        """Add a button at the right end that is visible with every panel."""
        self._top.addWidget(button)

    def show_pages(self, shown: bool) -> None:
        """Show the panels below the tabs, or the tabs alone. Tabs alone get the focus."""
        focus = QApplication.focusWidget()
        if not shown and focus is not None and self._pages.isAncestorOf(focus):
            self.bar.setFocus()
        self._pages.setVisible(shown)
        self._rule.setVisible(shown)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the panels, from the left."""
        return tuple(self._names)

    @property
    def current(self) -> str:
        """The name of the panel that is shown."""
        return self._names[self.bar.currentIndex()]

    def page(self, name: str) -> QWidget:
        """The panel of this name."""
        found = self._pages.widget(self._names.index(name))
        assert found is not None
        return found

    def show_page(self, name: str) -> None:
        """Show the panel of this name; raises ``ValueError`` if there is none."""
        self.bar.setCurrentIndex(self._names.index(name))

    def set_count(self, name: str, count: int) -> None:
        """Show a number beside the name on a tab; 0 hides it."""
        at = self._names.index(name)
        badge = self.bar.tabButton(at, QTabBar.ButtonPosition.RightSide)
        if badge is None and not count:
            return
        if not isinstance(badge, QLabel):
            badge = label("", "count")
            badge.installEventFilter(self)
            self.bar.setTabButton(at, QTabBar.ButtonPosition.RightSide, badge)
        badge.setText(f"{count:,}")
        badge.setVisible(count > 0)
        badge.adjustSize()
        # A badge that became wider would cover the name until the tabs are laid out again.
        self.bar.setTabText(at, name)
        if not count:
            self.bar.setTabButton(at, QTabBar.ButtonPosition.RightSide, None)
            badge.deleteLater()
        # A hidden bar does not report that its width has changed, and its last tab would be cut
        # off.
        self.bar.updateGeometry()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Move the number back into its tab; Qt puts it into the gap between two tabs."""
        if event.type() == QEvent.Type.Move and isinstance(watched, QLabel):
            for at in range(self.bar.count()):
                if self.bar.tabButton(at, QTabBar.ButtonPosition.RightSide) is watched:
                    left = self.bar.tabRect(at).right() + 1 - MARGIN - watched.width()
                    if watched.x() != left:
                        watched.move(left, watched.y())
        return super().eventFilter(watched, event)

    def _show(self, at: int) -> None:
        self._pages.setCurrentIndex(at)
        for place, tools in self._tools.items():
            tools.setVisible(place == at and not self._bare)
        if 0 <= at < len(self._names):
            self.changed.emit(self._names[at])
