"""A person at a canvas without a window: moves the mouse, presses, drags and types."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import new_blueprint
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor

SAMPLES = Path(__file__).parents[2] / "samples"
LEFT = Qt.MouseButton.LeftButton
NONE = Qt.KeyboardModifier.NoModifier


def sample(name: str) -> Blueprint:
    """A sample blueprint."""
    path = SAMPLES / name
    return read_blueprint(parse_json(path.read_text(encoding="utf-8"), name))


class Drawer:
    """Sits before a canvas of 1000 by 700 with a session and its editor."""

    def __init__(self, qtbot: QtBot, blueprint: Blueprint | None = None) -> None:
        self.session = Session(blueprint or new_blueprint())
        self.canvas = Canvas(LIGHT)
        self.canvas.camera.motion = False
        self.editor = CanvasEditor(self.session, self.canvas)
        qtbot.addWidget(self.canvas)
        self.canvas.resize(1000, 700)
        self.canvas.show()
        qtbot.waitExposed(self.canvas)
        self.canvas.activateWindow()
        self.canvas.setFocus()
        QApplication.processEvents()

    @property
    def hands_on(self) -> QWidget:
        return self.canvas.viewport()

    @property
    def sheet(self) -> Sheet:
        assert self.canvas.sheet is not None
        return self.canvas.sheet

    # Where things are

    def at(self, scene: QPointF | tuple[float, float]) -> QPoint:
        """A scene point in the viewport's pixels."""
        point = scene if isinstance(scene, QPointF) else QPointF(*scene)
        return self.canvas.mapFromScene(point)

    def place(self, state: str) -> QPoint:
        return self.at(self.canvas.positions[state])

    def label_of(self, state: str, operation: str) -> QPoint:
        rect = self.canvas.rect_of(Address(self.session.branch, state, operation))
        assert rect is not None
        return self.at(rect.center())

    def tip_of(self, state: str, operation: str) -> QPoint:
        edge = self.sheet.picture.edge(Address(self.session.branch, state, operation))
        return self.at(QPointF(*self.sheet.geometry.shape(edge).tip))

    def handle_of(self, state: str, side: str = "right") -> QPoint:
        """The handle of a state; it appears when the pointer is at that side."""
        return self.at(self.canvas.hand.hover.handles(self.sheet.picture.index[state])[side])

    # What a hand does

    def hover(self, point: QPoint) -> None:
        # A hand is never quite still; a pointer that is there already tells nothing.
        QTest.mouseMove(self.hands_on, point + QPoint(1, 1))
        QTest.mouseMove(self.hands_on, point)
        QApplication.processEvents()

    def click(
        self, point: QPoint, modifiers: Qt.KeyboardModifier = NONE, button: Qt.MouseButton = LEFT
    ) -> None:
        self.hover(point)
        QTest.mouseClick(self.hands_on, button, modifiers, point)
        QApplication.processEvents()

    def double_click(self, point: QPoint) -> None:
        self.hover(point)
        QTest.mouseClick(self.hands_on, LEFT, NONE, point)
        QTest.mouseDClick(self.hands_on, LEFT, NONE, point)
        QApplication.processEvents()

    def press(
        self, point: QPoint, button: Qt.MouseButton = LEFT, modifiers: Qt.KeyboardModifier = NONE
    ) -> None:
        self.hover(point)
        QTest.mousePress(self.hands_on, button, modifiers, point)

    def drag(
        self,
        start: QPoint,
        end: QPoint,
        button: Qt.MouseButton = LEFT,
        modifiers: Qt.KeyboardModifier = NONE,
    ) -> None:
        """Press, move in steps as a hand does, let go."""
        self.press(start, button, modifiers)
        for share in (0.05, 0.3, 0.6, 0.9, 1.0):
            step = QPointF(start) + (QPointF(end) - QPointF(start)) * share
            QTest.mouseMove(self.hands_on, step.toPoint())
            QApplication.processEvents()
        QTest.mouseRelease(self.hands_on, button, modifiers, end)
        QApplication.processEvents()

    def connect(self, source: str, target: str, name: str) -> None:
        """Drag from a handle to a state, with a pointer that comes from its state, and name the
        operation."""
        self.hover(self.place(source))
        side = "right" if self.place(target).x() >= self.place(source).x() else "left"
        handle = self.handle_of(source, side)
        self.hover(handle)
        self.drag(handle, self.place(target))
        self.write(name)

    # What fingers do

    def write(self, text: str, finish: Qt.Key | None = Qt.Key.Key_Return) -> None:
        """Type into the field that is open; all of it is selected at first."""
        field = QApplication.focusWidget()
        assert field is not None, "nothing has the focus"
        assert field is not self.canvas, "no field is open"
        QTest.keyClicks(field, text)
        if finish is not None:
            QTest.keyClick(field, finish)
        QApplication.processEvents()

    def key(self, key: Qt.Key, modifiers: Qt.KeyboardModifier = NONE) -> None:
        QTest.keyClick(QApplication.focusWidget() or self.canvas, key, modifiers)
        QApplication.processEvents()

    # What is there now

    def table(self, branch: str | None = None) -> dict[str, dict[str, str]]:
        shown = self.session.blueprint[branch or self.session.branch]
        return {name: dict(operations) for name, operations in shown.table.items()}

    def steps(self) -> int:
        return self.session.history.index()

    def selected(self) -> list[str]:
        return ["/".join(a.path[1:]) for a in self.session.selection]
