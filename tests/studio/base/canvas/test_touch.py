"""Touchpad and pen: two fingers pan, a pinch zooms about its place, a pen is a pointer."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import (
    QInputDevice,
    QNativeGestureEvent,
    QPointingDevice,
    QTabletEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.wheel_habit import set_wheel_scrolls
from tests.stories.at_canvas import Drawer, sample

NONE, CTRL = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier
SHIFT, ALT = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.AltModifier
AT = QPointF(300.0, 200.0)


@pytest.fixture
def hfsm(qtbot: QtBot) -> Drawer:
    """A canvas on the paper's small hierarchy."""
    return Drawer(qtbot, sample("hfsm.json"))


def device(kind: QInputDevice.DeviceType, pointer: QPointingDevice.PointerType) -> QPointingDevice:
    ability = QInputDevice.Capability.Position | QInputDevice.Capability.PixelScroll
    return QPointingDevice("of a test", 7, kind, pointer, ability, 2, 3)


PAD = device(QInputDevice.DeviceType.TouchPad, QPointingDevice.PointerType.Finger)
MOUSE = device(QInputDevice.DeviceType.Mouse, QPointingDevice.PointerType.Generic)
PEN = device(QInputDevice.DeviceType.Stylus, QPointingDevice.PointerType.Pen)


def wheel(
    canvas: Canvas, source: QPointingDevice, pixels: QPoint, angle: QPoint,
    modifiers: Qt.KeyboardModifier = NONE,
) -> None:  # fmt: skip
    event = QWheelEvent(
        AT, QPointF(canvas.viewport().mapToGlobal(AT.toPoint())), pixels, angle,
        Qt.MouseButton.NoButton, modifiers, Qt.ScrollPhase.NoScrollPhase, False,
        Qt.MouseEventSource.MouseEventNotSynthesized, source,
    )  # fmt: skip
    QApplication.sendEvent(canvas.viewport(), event)


def below(canvas: Canvas) -> QPointF:
    """The scene point below the fingers."""
    inverse, _ = canvas.viewportTransform().inverted()
    return inverse.map(AT)


def ready(drawer: Drawer) -> Canvas:
    canvas = drawer.canvas
    canvas.camera.motion = False
    canvas.zoom_to(1.0)
    return canvas


def test_two_fingers_pan_in_both_directions(hfsm: Drawer) -> None:
    canvas = ready(hfsm)
    before = below(canvas)
    wheel(canvas, PAD, QPoint(30, -20), QPoint(60, -40))
    moved = below(canvas) - before
    assert (round(moved.x()), round(moved.y()), canvas.zoom) == (-30, 20, 1.0)
    # A touchpad that X11 calls a mouse tells pixels, too.
    wheel(canvas, MOUSE, QPoint(-30, 20), QPoint(-60, 40))
    assert (below(canvas) - before).manhattanLength() < 2
    # With Ctrl they zoom, about their place.
    wheel(canvas, PAD, QPoint(0, 60), QPoint(0, 120), CTRL)
    assert canvas.zoom > 1.0
    assert (below(canvas) - before).manhattanLength() < 3


def test_a_wheel_still_zooms(hfsm: Drawer) -> None:
    canvas = ready(hfsm)
    before = below(canvas)
    wheel(canvas, MOUSE, QPoint(), QPoint(0, 120))
    assert canvas.zoom == pytest.approx(1.2)
    assert (below(canvas) - before).manhattanLength() < 3
    wheel(canvas, MOUSE, QPoint(), QPoint(0, -120))
    assert canvas.zoom == pytest.approx(1.0)


@pytest.fixture
def scrolling() -> Iterator[None]:
    set_wheel_scrolls(True)
    yield
    set_wheel_scrolls(False)


@pytest.mark.usefixtures("scrolling")
def test_a_wheel_scrolls_if_it_is_set_so(hfsm: Drawer) -> None:
    canvas = ready(hfsm)
    before = below(canvas)
    wheel(canvas, MOUSE, QPoint(), QPoint(0, -120))
    down = below(canvas) - before
    assert (canvas.zoom, down.x()) == (1.0, 0.0)
    assert down.y() > 0
    wheel(canvas, MOUSE, QPoint(), QPoint(120, 0))
    assert below(canvas).x() < before.x()
    wheel(canvas, PAD, QPoint(30, -20), QPoint(60, -40))
    assert canvas.zoom == 1.0


@pytest.mark.parametrize("scrolls", [True, False])
def test_ctrl_always_zooms_and_shift_and_alt_scroll(hfsm: Drawer, scrolls: bool) -> None:
    canvas = ready(hfsm)
    set_wheel_scrolls(scrolls)
    try:
        before = below(canvas)
        wheel(canvas, MOUSE, QPoint(), QPoint(0, 120), SHIFT)
        assert (below(canvas).x() < before.x(), below(canvas).y()) == (True, before.y())
        before = below(canvas)
        wheel(canvas, MOUSE, QPoint(), QPoint(120, 0), ALT)
        assert (below(canvas).x(), below(canvas).y() < before.y()) == (before.x(), True)
        assert canvas.zoom == 1.0
        before = below(canvas)
        wheel(canvas, MOUSE, QPoint(), QPoint(0, 120), CTRL)
        assert canvas.zoom == pytest.approx(1.2)
        assert (below(canvas) - before).manhattanLength() < 3
    finally:
        set_wheel_scrolls(False)


def gesture(canvas: Canvas, kind: Qt.NativeGestureType, value: float) -> None:
    where = QPointF(canvas.viewport().mapToGlobal(AT.toPoint()))
    event = QNativeGestureEvent(kind, PAD, 2, AT, AT, where, value, QPointF(11.0, 7.0))
    QApplication.sendEvent(canvas.viewport(), event)


def test_a_pinch_zooms_about_the_place_between_the_fingers(hfsm: Drawer) -> None:
    canvas = ready(hfsm)
    before = below(canvas)
    gesture(canvas, Qt.NativeGestureType.BeginNativeGesture, 0.0)
    for _ in range(40):
        gesture(canvas, Qt.NativeGestureType.ZoomNativeGesture, 0.01)
    assert canvas.zoom == pytest.approx(1.01**40)
    assert (below(canvas) - before).manhattanLength() < 2, "many small steps do not drift"
    gesture(canvas, Qt.NativeGestureType.EndNativeGesture, 0.0)
    canvas.camera.pan(200.0, 0.0)
    before = below(canvas)
    gesture(canvas, Qt.NativeGestureType.ZoomNativeGesture, 0.01)
    assert (below(canvas) - before).manhattanLength() < 2, "no jump back"
    # A wild event moves it only so far, and never to nothing.
    gesture(canvas, Qt.NativeGestureType.ZoomNativeGesture, -50.0)
    assert canvas.zoom == pytest.approx(1.01**41 * 0.2)
    before = below(canvas)
    gesture(canvas, Qt.NativeGestureType.PanNativeGesture, 0.0)
    assert (below(canvas) - before).x() < 0
    gesture(canvas, Qt.NativeGestureType.SwipeNativeGesture, 90.0)


def test_a_pen_is_left_to_qt_which_makes_a_pointer_of_it(hfsm: Drawer) -> None:
    canvas, kind = ready(hfsm), QEvent.Type
    for event in (kind.TabletPress, kind.TabletMove, kind.TabletRelease):
        held = Qt.MouseButton.NoButton if event == kind.TabletRelease else Qt.MouseButton.LeftButton
        pen = QTabletEvent(
            event, PEN, AT, QPointF(canvas.viewport().mapToGlobal(AT.toPoint())), 0.5, 0.0, 0.0,
            0.0, 0.0, 0.0, NONE, Qt.MouseButton.LeftButton, held,
        )  # fmt: skip
        pen.ignore()
        QApplication.sendEvent(canvas.viewport(), pen)
        assert not pen.isAccepted()
