"""The docks around the canvas: left, right, bottom; below 1280 pixels the left one is a drawer."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QByteArray, QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QApplication,
    QDockWidget,
    QFrame,
    QMainWindow,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.studio.base.feature import DockPanel
from smsl_studio.studio.base.tabs import Tabs

LEFT, PROPERTIES, SOURCE, BOTTOM = 232, 304, 364, 196
NARROW = 1280
NARROWEST = 200
FORM = 288
"""The width that no form is cut in, with its scroll bar."""
LAYOUT_VERSION = 1


class Docks(QObject):
    """Three docks with panels of their own; they remember their places."""

    changed = Signal()
    """A dock was shown or hidden."""

    def __init__(self, window: QMainWindow, panels: Sequence[DockPanel]) -> None:
        super().__init__(window)
        self._window = window
        self._sides = QSplitter(Qt.Orientation.Vertical)
        self._sides.setHandleWidth(1)
        self._sides.setChildrenCollapsible(False)
        left = [panel for panel in panels if panel.side == "left"]
        for panel in left:
            self._sides.addWidget(panel.widget)
        self._sides.setSizes([394, 402])
        for panel in left:
            if panel.focus is not None:
                self._sides.setFocusProxy(panel.focus)
        self.right_tabs, self.bottom_tabs = Tabs(), Tabs()
        corner, area = Qt.Corner, Qt.DockWidgetArea
        window.setCorner(corner.BottomLeftCorner, area.LeftDockWidgetArea)
        window.setCorner(corner.BottomRightCorner, area.RightDockWidgetArea)
        self.left = self._dock("left", self._sides, area.LeftDockWidgetArea)
        self.right = self._dock("right", self.right_tabs, area.RightDockWidgetArea)
        self.right.setMinimumWidth(FORM)
        self.bottom = self._dock("bottom", self.bottom_tabs, area.BottomDockWidgetArea)
        self.drawer = Drawer(window)
        self._narrow = False
        self._widths = {"Properties": PROPERTIES, "Source": SOURCE}
        self._tab = "Properties"
        self.right_tabs.changed.connect(self._resize_right)
        # Tab goes through the panels in the order in which they come into the window.
        tabs = {"right": self.right_tabs, "bottom": self.bottom_tabs}
        for panel in panels:
            if panel.side in tabs:
                tabs[panel.side].add(panel.name, panel.widget, panel.tools)

    def set_first_sizes(self) -> None:
        """The sizes of the design, where nothing is remembered."""
        sideways, upright = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
        self._window.resizeDocks([self.left, self.right], [LEFT, self._widths[self._tab]], sideways)
        self._window.resizeDocks([self.bottom], [BOTTOM], upright)

    def show_mode(self, mode: str) -> None:
        """The docks belong to Draw mode."""
        self.drawer.close_drawer()
        for dock in (self.left, self.right, self.bottom):
            dock.setVisible(mode == "draw" and not (dock is self.left and self._narrow))

    def save(self) -> QByteArray:
        """The places of the docks; a drawer is remembered as the dock it stands for."""
        if self._narrow:
            self.left.show()
        state = self._window.saveState(LAYOUT_VERSION)
        self.left.setVisible(not self._narrow and self.left.isVisible())
        return state

    def restore(self, state: QByteArray) -> bool:
        """Put the docks where they were; False where that was not remembered."""
        done = not state.isEmpty() and self._window.restoreState(state, LAYOUT_VERSION)
        if self._narrow:
            self.left.hide()
        return done

    def fit_width(self, width: int) -> bool:
        """Turn the left dock into a drawer where the window is narrow; True where it is."""
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

    def _toggle(self, dock: QDockWidget) -> None:
        dock.setVisible(not dock.isVisible())
        self.changed.emit()

    def show_tab(self, name: str) -> None:
        """Bring a panel to the front, wherever it is."""
        for tabs, dock in ((self.right_tabs, self.right), (self.bottom_tabs, self.bottom)):
            if name in tabs.names:
                dock.show()
                tabs.show_page(name)
        self.changed.emit()

    def enter_tab(self, name: str) -> bool:
        """Bring a panel to the front with the keys in it; False where they are there already."""
        self.show_tab(name)
        tabs = self.right_tabs if name in self.right_tabs.names else self.bottom_tabs
        page, focus = tabs.page(name), QApplication.focusWidget()
        if focus is not None and (page is focus or page.isAncestorOf(focus)):
            return False
        page.setFocus(Qt.FocusReason.ShortcutFocusReason)
        return True

    def _resize_right(self, name: str) -> None:
        """The source is wider than a form; each keeps the width it was given."""
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


class Drawer(QFrame):
    """The left panel laid over the canvas of a narrow window; it goes when the focus leaves it."""

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self._window = window
        self._content: QWidget | None = None
        self.setProperty("role", "float")
        self.setAccessibleName("Outline and library")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 1, 1, 1)
        self.hide()
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._focus_moved)
        window.installEventFilter(self)

    def take(self, widget: QWidget) -> None:
        """Hold this widget from now on."""
        layout = self.layout()
        assert layout is not None
        layout.addWidget(widget)
        self._content = widget

    def toggle(self) -> None:
        """Open the drawer and give the keys to what is in it, or close it."""
        if self.isVisible():
            self.close_drawer()
        else:
            self._place()
            self.show()
            self.raise_()
            if self._content is not None:
                self._content.setFocus()

    def close_drawer(self) -> None:
        """Close the drawer."""
        self.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep its place when the window changes its size."""
        if event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return super().eventFilter(watched, event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape closes the drawer and gives the keys to the body."""
        if event.key() == Qt.Key.Key_Escape:
            self.close_drawer()
            self._body().setFocus()
            return
        super().keyPressEvent(event)

    def _body(self) -> QWidget:
        body = self._window.centralWidget()
        assert body is not None
        return body

    def _place(self) -> None:
        body = self._body().geometry()
        high = self._window.height() - body.top() - 26
        self.setGeometry(0, body.top(), LEFT + 2, high)

    def _focus_moved(self, _: QWidget | None, now: QWidget | None) -> None:
        if self.isVisible() and now is not None and now is not self and not self.isAncestorOf(now):
            self.close_drawer()
