"""The accessible interface of a row of tabs, in place of Qt's.

Qt says of the chosen tab of each row that it has the keyboard focus, wherever the focus is. Here it
has the focus only if its row has it.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from PySide6.QtCore import QPoint, QRect
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAccessibleWidget, QApplication, QLabel, QTabBar
from shiboken6 import isValid

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.canvas.accessible_held import Children, kept
from smsl_studio.studio.base.canvas.accessible_leaf import PRESS, Acts, LeafAccessible


class TabsAccessible(QAccessibleWidget):
    """A row of tabs. Its children are the tabs, from the left."""

    def __init__(self, bar: QTabBar) -> None:
        super().__init__(bar, QAccessible.Role.PageTabList, "")
        self._tabs: Children[int, TabAccessible] = Children()

    @property
    def bar(self) -> QTabBar | None:
        """The row; None once it is gone."""
        # Qt deletes this interface with the row, but readers may still hold its tabs.
        found = self.object() if isValid(self) else None
        return found if isinstance(found, QTabBar) else None

    def text(self, kind: QAccessible.Text) -> str:
        """As of any widget; a row without a name is called as its chosen tab."""
        found, bar = super().text(kind), self.bar
        if kind != QAccessible.Text.Name or found or bar is None:
            return found
        return plain_text(bar.tabText(bar.currentIndex()))

    def childCount(self) -> int:
        """The number of tabs."""
        bar = self.bar
        return bar.count() if bar is not None else 0

    def child(self, index: int) -> Any:
        """The tab with this number; None if there is none."""
        if not 0 <= index < self.childCount():
            return None
        return kept(self._tabs, index, partial(TabAccessible, self, index))

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """The number of a tab; -1 for anything else."""
        return child.number if isinstance(child, TabAccessible) else -1

    def childAt(self, x: int, y: int) -> Any:
        """The tab at a point of the screen (pixels); None if there is none."""
        bar = self.bar
        return self.child(bar.tabAt(bar.mapFromGlobal(QPoint(x, y)))) if bar is not None else None

    def focusChild(self) -> Any:
        """The chosen tab, if the row has the keyboard focus."""
        bar = self.bar
        focused = bar is not None and QApplication.focusWidget() is bar
        return self.child(bar.currentIndex()) if bar is not None and focused else None

    def state(self) -> QAccessible.State:
        """As of any widget, but the chosen tab has the focus if there is one."""
        found = super().state()
        if self.childCount():
            found.focused = False
        return found


class TabAccessible(LeafAccessible):
    """One tab, with the number that is shown on it."""

    def __init__(self, above: TabsAccessible, number: int) -> None:
        bar = above.bar
        assert bar is not None
        super().__init__(above, bar)
        self._row, self.number = above, number

    @property
    def _bar(self) -> QTabBar | None:
        bar = self._row.bar
        return bar if bar is not None and self.number < bar.count() else None

    def isValid(self) -> bool:
        """Whether the row still has a tab with this number."""
        return self._bar is not None

    def text(self, kind: QAccessible.Text) -> str:
        """The name of the tab and the number on it; empty for other kinds of text."""
        bar = self._bar
        if bar is None or kind != QAccessible.Text.Name:
            return ""
        badge = bar.tabButton(self.number, QTabBar.ButtonPosition.RightSide)
        words = bar.tabText(self.number).replace("&&", "&")
        if isinstance(badge, QLabel) and not badge.isHidden():
            words = f"{words}, {badge.text()}"
        return plain_text(words)

    def role(self) -> QAccessible.Role:
        """A tab."""
        return QAccessible.Role.PageTab

    def rect(self) -> QRect:
        """Where it lies on the screen (pixels); empty if it is gone."""
        bar = self._bar
        if bar is None:
            return QRect()
        place = bar.tabRect(self.number)
        return QRect(bar.mapToGlobal(place.topLeft()), place.size())

    def acts(self) -> Acts:
        """Show its page."""
        bar = self._bar
        if bar is None:
            return {}
        return {PRESS: ("Show its page", partial(bar.setCurrentIndex, self.number))}

    def state(self) -> QAccessible.State:
        """The flags: whether it is chosen, has the focus, and is shown."""
        found, bar = QAccessible.State(), self._bar
        if bar is None:
            found.invisible = True
            return found
        found.invisible = not bar.isVisible() or not bar.isTabVisible(self.number)
        found.disabled = not bar.isTabEnabled(self.number)
        found.selectable = found.focusable = True
        found.selected = self.number == bar.currentIndex()
        found.focused = found.selected and QApplication.focusWidget() is bar
        return found
