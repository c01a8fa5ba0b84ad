"""The accessible interfaces of a canvas: the view, and one child for every state.

QGraphicsObjects have none of their own. States are children by number, also those far off: what
is read out does not depend on what is near enough to be an item.
"""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QCoreApplication, QObject, QRect
from PySide6.QtGui import QAccessible, QAccessibleInterface
from shiboken6 import isValid

from smsl_studio.studio.canvas.accessible import state_words
from smsl_studio.studio.canvas.canvas import Canvas


class CanvasAccessible(QAccessibleInterface):
    """The canvas: a graphic whose children are the states of the SB that is shown."""

    def __init__(self, canvas: Canvas) -> None:
        super().__init__()
        self._canvas = canvas
        self._children: dict[int, StateAccessible] = {}

    def isValid(self) -> bool:
        return isValid(self._canvas)

    def object(self) -> QObject:
        return self._canvas

    def window(self) -> Any:
        return self._canvas.window().windowHandle()

    def parent(self) -> Any:
        parent = self._canvas.parentWidget()
        return QAccessible.queryAccessibleInterface(parent) if parent is not None else None

    def childCount(self) -> int:
        sheet = self._canvas.sheet if self.isValid() else None
        return len(sheet.picture) if sheet is not None else 0

    def child(self, index: int) -> Any:
        if not 0 <= index < self.childCount():
            return None
        if index not in self._children:
            self._children[index] = StateAccessible(self._canvas, self, index)
        return self._children[index]

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        return child.index if isinstance(child, StateAccessible) else -1

    def childAt(self, x: int, y: int) -> Any:
        sheet = self._canvas.sheet
        if sheet is None:
            return None
        at = self._canvas.mapToScene(self._canvas.viewport().mapFromGlobal(QRect(x, y, 1, 1)
                                                                           .topLeft()))  # fmt: skip
        return self.child(sheet.state_at(at.x(), at.y()))

    def focusChild(self) -> Any:
        """The state that is selected last."""
        sheet = self._canvas.sheet
        for address in reversed(self._canvas.marks.selection):
            state = sheet.picture.node(address) if sheet is not None else -1
            if state >= 0:
                return self.child(state)
        return None

    def text(self, kind: QAccessible.Text) -> str:
        if kind == QAccessible.Text.Name:
            return self._canvas.accessibleName()
        if kind == QAccessible.Text.Description:
            return self._canvas.accessibleDescription()
        return ""

    def setText(self, kind: QAccessible.Text, text: str) -> None:
        """Names follow the blueprint; they are not set from outside."""

    def rect(self) -> QRect:
        canvas = self._canvas
        return QRect(canvas.mapToGlobal(canvas.rect().topLeft()), canvas.size())

    def role(self) -> QAccessible.Role:
        return QAccessible.Role.Graphic

    def state(self) -> QAccessible.State:
        found = QAccessible.State()
        found.focusable = True
        found.focused = self._canvas.hasFocus()
        found.invisible = not self._canvas.isVisible()
        return found

    def interface_cast(self, kind: QAccessible.InterfaceType) -> Any:
        return None


class StateAccessible(QAccessibleInterface):
    """One state, read as "State_1100, active, 7 operations out"."""

    def __init__(self, canvas: Canvas, parent: CanvasAccessible, index: int) -> None:
        super().__init__()
        self._canvas, self._parent, self.index = canvas, parent, index

    def isValid(self) -> bool:
        return self._parent.isValid() and self.index < self._parent.childCount()

    def object(self) -> Any:
        return None

    def window(self) -> Any:
        return self._parent.window()

    def parent(self) -> QAccessibleInterface:
        return self._parent

    def childCount(self) -> int:
        return 0

    def child(self, index: int) -> Any:
        return None

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        return -1

    def childAt(self, x: int, y: int) -> Any:
        return None

    def text(self, kind: QAccessible.Text) -> str:
        if kind == QAccessible.Text.Name and self.isValid():
            return state_words(self._canvas, self.index)
        return ""

    def setText(self, kind: QAccessible.Text, text: str) -> None:
        """Names follow the blueprint; they are not set from outside."""

    def rect(self) -> QRect:
        sheet = self._canvas.sheet
        if sheet is None or not self.isValid():
            return QRect()
        rect = self._canvas.rect_of(sheet.address_of_state(self.index))
        if rect is None:
            return QRect()
        shown = self._canvas.mapFromScene(rect).boundingRect()
        return QRect(self._canvas.viewport().mapToGlobal(shown.topLeft()), shown.size())

    def role(self) -> QAccessible.Role:
        return QAccessible.Role.ListItem

    def state(self) -> QAccessible.State:
        found = QAccessible.State()
        found.selectable = True
        sheet = self._canvas.sheet
        if sheet is not None and self.isValid():
            found.selected = sheet.looks.node(self.index).selected
        return found

    def interface_cast(self, kind: QAccessible.InterfaceType) -> Any:
        return None


class Factory:
    """Makes the interface of a canvas when an assistive tool asks, and keeps it alive."""

    def __init__(self) -> None:
        self._kept: dict[int, CanvasAccessible] = {}

    def __call__(self, key: str, thing: QObject) -> QAccessibleInterface | None:
        if not isinstance(thing, Canvas):
            return None
        self._kept = {k: i for k, i in self._kept.items() if i.isValid()}
        made = CanvasAccessible(thing)
        self._kept[id(thing)] = made
        return made


INSTALLED = "smsl canvas accessible"


def install(application: QCoreApplication) -> None:
    """Let assistive tools see the states of every canvas; once an application."""
    if not application.property(INSTALLED):
        application.setProperty(INSTALLED, True)
        QAccessible.installFactory(Factory())
