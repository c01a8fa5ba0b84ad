"""A person whose gestures are counted, by the rule of docs/gestures.md."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QDragEnterEvent, QDragMoveEvent, QDropEvent
from PySide6.QtWidgets import QAbstractItemView, QApplication, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.handles import tail_of
from smsl_studio.studio.features.draw.canvas.library_drop import library_data
from tests.stories.person import LEFT, Person

NONE = Qt.KeyboardModifier.NoModifier


class CountedHand:
    """Every click, double click, drag, key and typed text of a person adds one to ``count``."""

    def __init__(self, person: Person) -> None:
        self.person, self.count = person, 0

    def click(self, widget: QWidget, at: QPoint | None = None) -> None:
        """Click a widget."""
        self.count += 1
        self.person.click(widget, at)

    def double_click(self, at: QPoint) -> None:
        """Double-click the canvas."""
        self.count += 1
        self.person.move_to(at)
        self.person.double_click_canvas(at)

    def drag_arrowhead(self, operation: Address, end: QPoint) -> None:
        """Drag an operation by its end. The pointer comes along the line, which does not count."""
        self.count += 1
        tip = arrowhead(self.person, operation)
        self.person.move_to(self.person.place(str(operation)))
        self.person.move_to(tip)
        self.person.drag(tip, end)

    def drag_tail(self, operation: Address, end: QPoint) -> None:
        """Drag an operation by its beginning. The pointer comes along the line, which does not
        count."""
        self.count += 1
        sheet = self.person.window.canvas.sheet
        assert sheet is not None
        tail = tail_of(sheet, sheet.picture.edge(operation))
        assert tail is not None
        self.person.move_to(self.person.place(str(operation)))
        self.person.move_to(self.person.on_canvas(tail))
        self.person.drag(self.person.on_canvas(tail), end)

    def drag_from_edge(self, state: str, end: QPoint) -> None:
        """Drag from the handle of a state to a point of the canvas."""
        self.count += 1
        self.person.drag_from_handle(state, end)

    def drag_template(self, rows: QAbstractItemView, words: str, name: str, at: QPoint) -> None:
        """Drag a template that is in view in the library to a point of the canvas."""
        self.count += 1
        self.person.until(rows.isVisible)
        rect = rows.visualRect(self.person.row(rows, words))
        assert rows.viewport().rect().contains(rect), f"{words} is not in view"
        viewport = self.person.window.canvas.viewport()
        data, copy = library_data("template", name), Qt.DropAction.CopyAction
        QApplication.sendEvent(viewport, QDragEnterEvent(at, copy, data, LEFT, NONE))
        QApplication.sendEvent(viewport, QDragMoveEvent(at, copy, data, LEFT, NONE))
        QApplication.sendEvent(viewport, QDropEvent(QPointF(at), copy, data, LEFT, NONE))
        QApplication.processEvents()

    def press(self, key: Qt.Key, *modifiers: Qt.KeyboardModifier) -> None:
        """Press one key, with others held or not."""
        self.count += 1
        self.person.press(key, modifiers)

    def type(self, text: str) -> None:
        """Type a name, however long."""
        self.count += 1
        self.person.type(text)

    def names(self, names: Sequence[str], between: Qt.Key) -> None:
        """Type names with a key after each but the last."""
        for at, name in enumerate(names):
            if at:
                self.press(between)
            self.type(name)


def arrowhead(person: Person, operation: Address) -> QPoint:
    """Where the arrow of an operation ends, in the view's pixels."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    edge = sheet.picture.edge(operation)
    return person.on_canvas(QPointF(*sheet.geometry.shape(edge).tip))
