"""The button Stop takes the place of Run, so the second half of a double click may land on it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.key_button import KeyButton, command_button
from smsl_studio.studio.base.theme import LIGHT

LEFT = Qt.MouseButton.LeftButton


def clicks(button: KeyButton) -> list[bool]:
    found: list[bool] = []
    button.clicked.connect(lambda: found.append(True))
    return found


def end_of_a_double_click(button: KeyButton) -> None:
    """A press that Qt calls a double click, because the first click was at this place."""
    at = QPointF(button.rect().center())
    event = QMouseEvent(
        QEvent.Type.MouseButtonDblClick, at, button.mapToGlobal(at), LEFT, LEFT,
        Qt.KeyboardModifier.NoModifier,
    )  # fmt: skip
    QApplication.sendEvent(button, event)
    QTest.mouseRelease(button, LEFT)


def test_a_double_click_that_began_on_run_stops_nothing(qtbot: QtBot) -> None:
    stop, step = command_button("stop", "stop", LIGHT), command_button("step", "", LIGHT)
    for button in (stop, step):
        qtbot.addWidget(button)
    counted = clicks(stop), clicks(step)
    for button in (stop, step):
        end_of_a_double_click(button)
    assert [len(one) for one in counted] == [0, 1]


def test_a_double_click_on_stop_stops_with_its_first_click(qtbot: QtBot) -> None:
    stop = command_button("stop", "stop", LIGHT)
    qtbot.addWidget(stop)
    counted = clicks(stop)
    QTest.mouseClick(stop, LEFT)
    end_of_a_double_click(stop)
    assert len(counted) == 1
