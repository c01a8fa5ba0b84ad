"""The docks around the canvas: left, right, bottom.

In a window that does not fill a screen 1280 wide the left one is a drawer. In one below 800 high
the bottom one is lower, and below 480 it is hidden until it is asked for, so that the drawing keeps
the room.
"""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QByteArray, QObject, QRect, Qt, Signal
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QSplitter, QWidget

from smsl_studio.studio.base.drawer import Drawer
from smsl_studio.studio.base.feature import DockPanel
from smsl_studio.studio.base.tabs import Tabs
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import series
from smsl_studio.studio.shell.frame.dock_fold import DockFold

LEFT, PROPERTIES, SOURCE = 232, 304, 364
NARROW = 1280 - 24
"""In a window narrower than this the left panel is a drawer (pixels). A window that fills a screen
1280 wide is narrower by the frame that the desktop draws around it, 24 pixels at most.
"""
CLOSE = 760
"""In a window narrower than this the lower tabs stand close together (pixels)."""
NARROWEST = 200
LOW = 480
FORM = 288
"""The width at which no form is cut, with its scroll bar (pixels)."""
NARROWEST_TABS = 240
"""The least width of the lower panel (pixels). All its tabs need more, but they must not squeeze
the panels beside them while a window is small."""
LAYOUT_VERSION = 1


class Docks(QObject):
    """The three docks with their panels. Their places are remembered."""

    changed = Signal()
    """A dock was shown or hidden."""

    def __init__(self, window: QMainWindow, panels: Sequence[DockPanel], tokens: Tokens) -> None:
        super().__init__(window)
        self._window, self.panels = window, _in_order(panels)
        self._sides = QSplitter(Qt.Orientation.Vertical)
        self._sides.setHandleWidth(1)
        self._sides.setChildrenCollapsible(False)
        # The first panel at the left is always shown; the others share the room below it.
        self.left_tabs, self.right_tabs, self.bottom_tabs = Tabs(), Tabs(), Tabs()
        first, *others = [panel for panel in self.panels if panel.side == "left"]
        self._sides.addWidget(first.widget)
        self._sides.addWidget(self.left_tabs)
        for panel in others:
            self.left_tabs.add(panel.name, panel.widget, panel.tools)
        self._sides.setSizes([300, 496])
        self._sides.setFocusProxy(first.focus or first.widget)
        corner, area = Qt.Corner, Qt.DockWidgetArea
        window.setCorner(corner.BottomLeftCorner, area.LeftDockWidgetArea)
        window.setCorner(corner.BottomRightCorner, area.RightDockWidgetArea)
        self.left = self._dock("left", self._sides, area.LeftDockWidgetArea)
        self.right = self._dock("right", self.right_tabs, area.RightDockWidgetArea)
        self.right.setMinimumWidth(FORM)
        self.bottom_tabs.setMinimumWidth(NARROWEST_TABS)
        self.bottom = self._dock("bottom", self.bottom_tabs, area.BottomDockWidgetArea)
        self.fold = DockFold(window, self.bottom, self.bottom_tabs, tokens)
        self.fold.changed.connect(self.changed)
        self.drawer = Drawer(window, self._drawer_area, self._page, self.words("left"))
        self._narrow = self._low = False
        self._bottom_when_high = True
        self._widths = {"Properties": PROPERTIES, "Source": SOURCE}
        self._tab = "Properties"
        self.right_tabs.changed.connect(self._resize_right)
        # The order of adding is the order in which Tab visits the panels.
        tabs = {"right": self.right_tabs, "bottom": self.bottom_tabs}
        for panel in self.panels:
            if panel.side in tabs:
                tabs[panel.side].add(panel.name, panel.widget, panel.tools)
        tall = {panel.name for panel in self.panels if panel.tall}
        self.bottom_tabs.changed.connect(lambda name: self.fold.put_tall(name in tall))

    def words(self, side: str) -> str:
        """The names of the panels at a side, in a row: ``Outline and library``."""
        return series([one.name for one in self.panels if one.side == side]).capitalize()

    def panel(self, name: str) -> QWidget:
        """The panel of this name."""
        return next(one.widget for one in self.panels if one.name == name)

    def set_first_sizes(self) -> None:
        """Set the sizes of the design, if none are remembered."""
        sideways = Qt.Orientation.Horizontal
        self._window.resizeDocks([self.left, self.right], [LEFT, self._widths[self._tab]], sideways)
        self.fold.fit()

    def show_mode(self, mode: str) -> None:
        """Show the docks in Draw mode and hide them in all others."""
        self.drawer.close_drawer()
        for dock in (self.left, self.right, self.bottom):
            waits = (dock is self.left and self._narrow) or (dock is self.bottom and self._low)
            dock.setVisible(mode == "draw" and not waits)

    def save(self) -> QByteArray:
        """The state of the docks to be remembered, as they are in a large window."""
        left, bottom = self.left.isVisible(), self.bottom.isVisible()
        if self._narrow:
            self.left.show()
        if self._low:
            self.bottom.setVisible(self._bottom_when_high)
        state = self._window.saveState(LAYOUT_VERSION)
        self.left.setVisible(not self._narrow and left)
        self.bottom.setVisible(bottom)
        return state

    def restore(self, state: QByteArray) -> bool:
        """Restore a remembered state; False if there is none."""
        done = not state.isEmpty() and self._window.restoreState(state, LAYOUT_VERSION)
        if self._narrow:
            self.left.hide()
        if self._low:
            self._bottom_when_high = not self.bottom.isHidden()
            self.bottom.hide()
        return done

    def fit_width(self, width: int) -> bool:
        """Turn the left dock into a drawer if the window is narrow.

        Returns whether it is narrow.
        """
        self.bottom_tabs.set_close(width < CLOSE)
        narrow = width < NARROW
        if narrow != self._narrow:
            self._narrow = narrow
            self.drawer.close_drawer()
            if narrow:
                self.left.hide()
                self.drawer.take(self._sides)
            else:
                self.left.setWidget(self._sides)
                self.left.show()
                self._window.resizeDocks([self.left], [LEFT], Qt.Orientation.Horizontal)
            self._sides.show()
        return narrow

    def fit_height(self, height: int) -> None:
        """Give the bottom dock the height for this window. Hide it when the window gets very low;
        show it again when it gets high."""
        low = height < LOW
        if low != self._low:
            self._low = low
            if low:
                self._bottom_when_high = not self.bottom.isHidden()
                self.bottom.hide()
            elif self._bottom_when_high:
                self.bottom.show()
            self.changed.emit()
        self.fold.fit()

    def _page(self) -> QWidget:
        body = self._window.centralWidget()
        assert body is not None
        return body

    def _drawer_area(self) -> QRect:
        top = self._page().geometry().top()
        return QRect(0, top, LEFT + 2, self._window.height() - top - 26)

    def left_shown(self) -> bool:
        """Whether the left panel is shown, as a dock or as a drawer."""
        return self.drawer.isVisible() if self._narrow else self.left.isVisible()

    def toggle_left(self) -> None:
        """Show or hide the left panel, as a dock or as a drawer."""
        if self._narrow:
            self.drawer.toggle()
        else:
            self.left.setVisible(not self.left.isVisible())
        self.changed.emit()

    def right_shown(self) -> bool:
        """Whether the right dock is shown."""
        return self.right.isVisible()

    def toggle_right(self) -> None:
        """Show or hide the right dock."""
        self._toggle(self.right)

    def bottom_shown(self) -> bool:
        """Whether the bottom dock is shown."""
        return self.bottom.isVisible()

    def toggle_bottom(self) -> None:
        """Show or hide the bottom dock."""
        self._toggle(self.bottom)

    def bottom_folded(self) -> bool:
        """Whether the bottom dock shows only its tabs."""
        return self.fold.folded

    def fold_bottom(self) -> None:
        """Fold the bottom dock to its tabs, or unfold it."""
        self.fold.toggle()

    def _toggle(self, dock: QDockWidget) -> None:
        dock.setVisible(not dock.isVisible())
        self.fold.fit()
        self.changed.emit()

    def show_tab(self, name: str) -> None:
        """Show the panel of this name."""
        if name in self.left_tabs.names:
            self.left_tabs.show_page(name)
            if not self.left_shown():
                self.toggle_left()
        for tabs, dock in ((self.right_tabs, self.right), (self.bottom_tabs, self.bottom)):
            if name in tabs.names:
                dock.show()
                tabs.show_page(name)
                if dock is self.bottom:
                    self.fold.put(False)
                    self.fold.fit()
        self.changed.emit()

    def enter_tab(self, name: str) -> bool:
        """Show a panel and give it the keyboard focus; False if it has the focus already."""
        self.show_tab(name)
        every = (self.left_tabs, self.right_tabs, self.bottom_tabs)
        page = next(tabs.page(name) for tabs in every if name in tabs.names)
        focus = QApplication.focusWidget()
        if focus is not None and (page is focus or page.isAncestorOf(focus)):
            return False
        page.setFocus(Qt.FocusReason.ShortcutFocusReason)
        return True

    def _resize_right(self, name: str) -> None:
        """Restore the width of the right dock for a tab, because the source is wider than a
        form."""
        if name != self._tab and self.right.isVisible():
            self._widths[self._tab] = self.right.width()
            self._window.resizeDocks(
                [self.right], [self._widths.get(name, PROPERTIES)], Qt.Orientation.Horizontal
            )
        self._tab = name

    def _dock(self, name: str, widget: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        dock = QDockWidget(name.capitalize())
        dock.setObjectName(f"{name}_dock")
        dock.setTitleBarWidget(QWidget())
        dock.setFeatures(QDockWidget.DockWidgetFeature.NoDockWidgetFeatures)
        dock.setWidget(widget)
        dock.setMinimumWidth(NARROWEST)
        self._window.addDockWidget(area, dock)
        return dock


def _in_order(panels: Sequence[DockPanel]) -> tuple[DockPanel, ...]:
    """The panels in the order of their tabs."""
    found = [panel for panel in panels if not panel.after]
    for panel in panels:
        if panel.after:
            names = [one.name for one in found]
            at = names.index(panel.after) + 1 if panel.after in names else len(names)
            found.insert(at, panel)
    return tuple(found)
