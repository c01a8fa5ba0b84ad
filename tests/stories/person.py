"""A person at the window: moves the pointer, clicks, drags, types and reads what is shown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QModelIndex, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QComboBox,
    QLineEdit,
    QMenu,
    QWidget,
)
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows

SAMPLES = Path(__file__).parents[2] / "samples"
LEFT = Qt.MouseButton.LeftButton


def sample(name: str) -> Blueprint:
    """The blueprint of a sample file."""
    return read_blueprint(read_document(SAMPLES / name))


class Person:
    """Knows what is on the screen and where; uses pointer and keys only."""

    def __init__(self, window: Window, qtbot: QtBot, windows: Windows) -> None:
        self.window, self.qtbot, self.windows = window, qtbot, windows

    @property
    def blueprint(self) -> Blueprint:
        return self.window.session.blueprint

    # Keys.

    def press(self, key: Qt.Key, modifiers: Sequence[Qt.KeyboardModifier] = ()) -> None:
        """Press a key on whatever has the focus."""
        held = Qt.KeyboardModifier.NoModifier
        for modifier in modifiers:
            held |= modifier
        QTest.keyClick(self._focus(), key, held)
        QApplication.processEvents()

    def ctrl(self, key: Qt.Key) -> None:
        self.press(key, [Qt.KeyboardModifier.ControlModifier])

    def type(self, text: str) -> None:
        """Type over what is marked, into whatever has the focus."""
        QTest.keyClicks(self._focus(), text)

    def write(self, field: QLineEdit, text: str) -> None:
        """Click into a field, replace its text, and press Enter."""
        self.click(field)
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)

    def _focus(self) -> QWidget:
        """What has the focus; after a menu has closed it comes back in a moment."""
        self.qtbot.waitUntil(lambda: QApplication.focusWidget() is not None)
        target = QApplication.focusWidget()
        assert target is not None
        return target

    # The pointer.

    def click(self, widget: QWidget, at: QPoint | None = None) -> None:
        self.qtbot.waitUntil(widget.isVisible)
        assert widget.isEnabled(), f"{widget.accessibleName()} is not enabled"
        QTest.mouseClick(widget, LEFT, pos=at if at is not None else widget.rect().center())

    def click_row(self, view: QAbstractItemView, text: str) -> None:
        """Click the row that shows a text."""
        rect = view.visualRect(self.row(view, text))
        QTest.mouseClick(view.viewport(), LEFT, pos=rect.center())

    def row(self, view: QAbstractItemView, text: str) -> QModelIndex:
        model = view.model()
        for at in range(model.rowCount()):
            index = model.index(at, 0)
            if text in str(index.data()):
                return index
        raise AssertionError(f"no row says {text!r}")

    def choose(self, combo: QComboBox, text: str) -> None:
        """Open a choice, go down to an entry by keys, and press Enter."""
        self.click(combo)
        view = combo.view()
        self.qtbot.waitUntil(view.isVisible)
        QTest.keyClick(view, Qt.Key.Key_Home)
        for _ in range(combo.findText(text)):
            QTest.keyClick(view, Qt.Key.Key_Down)
        QTest.keyClick(view, Qt.Key.Key_Return)
        self.qtbot.waitUntil(lambda: not view.isVisible())
        self.come_back()

    def choose_in_menu(self, words: str) -> None:
        """Click a row of the menu that is open."""
        self.qtbot.waitUntil(lambda: isinstance(QApplication.activePopupWidget(), QMenu))
        menu = QApplication.activePopupWidget()
        assert isinstance(menu, QMenu)
        entry = next(one for one in menu.actions() if words in one.text())
        QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(entry).center())
        self.come_back()

    def come_back(self) -> None:
        """Offscreen there is no window manager to give the focus back when a popup has closed."""
        self.window.activateWindow()
        self.qtbot.waitUntil(self.window.isActiveWindow)

    # The canvas.

    def on_canvas(self, at: QPointF | tuple[float, float]) -> QPoint:
        """A scene point in the view's pixels."""
        point = at if isinstance(at, QPointF) else QPointF(*at)
        return self.window.canvas.mapFromScene(point)

    def place(self, address: str) -> QPoint:
        """Where an element stands, in the view's pixels."""
        rect = self.window.canvas.rect_of(self.blueprint.resolve(address))
        assert rect is not None, f"{address} is not on the canvas"
        return self.on_canvas(rect.center())

    def move_to(self, at: QPoint) -> None:
        """Move the pointer, as a hand does: Qt's test helper leaves no move event offscreen."""
        self._mouse(QEvent.Type.MouseMove, at, Qt.MouseButton.NoButton)

    def click_canvas(self, at: QPoint) -> None:
        QTest.mouseClick(self.window.canvas.viewport(), LEFT, pos=at)

    def double_click_canvas(self, at: QPoint) -> None:
        viewport = self.window.canvas.viewport()
        QTest.mouseClick(viewport, LEFT, pos=at)
        QTest.mouseDClick(viewport, LEFT, pos=at)

    def drag(self, start: QPoint, end: QPoint) -> None:
        """Press, move and let go on the canvas."""
        kind = QEvent.Type
        self._mouse(kind.MouseButtonPress, start, LEFT)
        for step in range(1, 6):
            self._mouse(kind.MouseMove, start + (end - start) * step / 5, LEFT)
        self._mouse(kind.MouseButtonRelease, end, LEFT)

    def drag_from_handle(self, state: str, end: QPoint) -> None:
        """Point at a state, take the handle that shows, and drag it somewhere."""
        self.move_to(self.place(state))
        handle = self.window.canvas.gestures.handle
        assert handle is not None, f"{state} shows no handle"
        self.drag(self.on_canvas(handle), end)

    def _mouse(self, kind: QEvent.Type, at: QPoint, button: Qt.MouseButton) -> None:
        viewport = self.window.canvas.viewport()
        held = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseButtonRelease else button
        acting = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseMove else button
        point = QPointF(at)
        event = QMouseEvent(
            kind, point, QPointF(viewport.mapToGlobal(at)), acting, held,
            Qt.KeyboardModifier.NoModifier,
        )  # fmt: skip
        QApplication.sendEvent(viewport, event)

    # What is shown.

    def selected(self) -> list[str]:
        return [str(address) for address in self.window.session.selection]

    def until(self, condition: Callable[[], bool]) -> None:
        self.qtbot.waitUntil(condition)

    def until_inspected(self) -> None:
        """Until the findings are those of what is shown."""
        self.until(lambda: self.window.inspector.current)

    def select(self, *addresses: str) -> None:
        """Click elements on the canvas, all but the first with Shift."""
        for at, address in enumerate(addresses):
            shift = Qt.KeyboardModifier.ShiftModifier if at else Qt.KeyboardModifier.NoModifier
            viewport = self.window.canvas.viewport()
            QTest.mouseClick(viewport, LEFT, shift, self.place(address))

    def steps(self) -> list[str]:
        """The words of every step in the history."""
        history = self.window.session.history
        return [history.text(at) for at in range(history.count())]


def address(text: str) -> Address:
    return Address(*Address.split(text))
