"""The lower panel is low in a low window, until a person drags its edge."""

from __future__ import annotations

from functools import partial

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.shell.frame.docks import Docks
from smsl_studio.studio.shell.window import Window
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

HFSM = SAMPLES / "hfsm.json"


@pytest.mark.parametrize(
    ("width", "height", "lower"),
    [(1280, 720, 154), (1280, 800, 196), (1920, 1080, 196), (900, 600, 112)],
)
def test_its_height_follows_the_window(sit: Sit, width: int, height: int, lower: int) -> None:
    person = sit(HFSM, (width, height))
    docks, body = person.window.docks, person.window.body
    person.until(lambda: docks.bottom.height() == lower)
    assert docks.left.isVisible() is (width >= 1280), "docked from 1280 on, a drawer below"
    status = person.window.status_line.geometry()
    assert docks.bottom.geometry().bottom() + 1 == status.top()
    assert body.height() + lower + 1 == status.top() - body.y(), "the drawing has the rest"


def has_height(docks: Docks, height: int) -> bool:
    return docks.bottom.height() == height


def test_it_follows_while_the_window_changes(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    docks = person.window.docks
    for height, lower in ((720, 154), (1000, 196), (640, 112), (800, 196)):
        person.window.resize(1280, height)
        person.until(partial(has_height, docks, lower))


def drag_edge(person: Person, by: int) -> None:
    window, bottom = person.window, person.window.docks.bottom.geometry()
    edge = QPoint(bottom.center().x(), bottom.top() - 1)
    left = Qt.MouseButton.LeftButton
    QTest.mousePress(window, left, pos=edge)
    for way in (by // 2, by):
        at = edge + QPoint(0, way)
        move = QMouseEvent(
            QEvent.Type.MouseMove, QPointF(at), QPointF(at), QPointF(window.mapToGlobal(at)),
            Qt.MouseButton.NoButton, left, Qt.KeyboardModifier.NoModifier,
        )  # fmt: skip
        QApplication.sendEvent(window, move)
        QApplication.processEvents()
    person.until(lambda: window.docks.bottom.height() == bottom.height() - by)
    QTest.mouseRelease(window, left, pos=edge + QPoint(0, by))


@pytest.mark.parametrize(
    ("height", "lower"), [(1080, 603), (900, 502), (800, 406), (720, 326), (600, 270)]
)
def test_beside_a_tall_page_the_drawing_keeps_its_room(sit: Sit, height: int, lower: int) -> None:
    person = sit(SAMPLES / "registration-drilling.json", (1280, height))
    docks, canvas = person.window.docks, person.window.canvas
    person.ctrl(Qt.Key.Key_I)
    person.until(lambda: docks.bottom.height() == lower)
    assert canvas.height() >= 200
    if height >= 800:
        assert canvas.height() >= 270


def test_the_height_of_a_tall_page_is_remembered_beside_the_other(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    window, docks = person.window, person.window.docks
    person.ctrl(Qt.Key.Key_I)
    person.until(lambda: docks.bottom.height() == 406)
    drag_edge(person, 50)
    assert window.close()
    again = Window(person.windows)
    again.show()
    again.resize(1280, 800)
    person.until(lambda: again.docks.bottom.height() == 196)
    again.docks.show_tab("Inspection")
    person.until(lambda: again.docks.bottom.height() == 356)
    again.close()


def test_a_height_that_a_person_has_chosen_stays_and_is_remembered(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    window, docks = person.window, person.window.docks
    status = window.status_line
    person.until(lambda: docks.bottom.geometry().bottom() + 1 == status.y() > 0)
    person.until(lambda: docks.bottom.height() == 196)
    drag_edge(person, -60)
    window.resize(1280, 720)
    person.until(lambda: docks.bottom.height() == 256)
    assert window.close()
    again = Window(person.windows)
    again.show()
    again.resize(1280, 780)
    person.until(lambda: again.docks.bottom.height() == 256)
    again.close()


def test_the_tabs_stay_below_the_pointer_that_chose_a_tall_page(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    docks, bar = person.window.docks, person.window.docks.bottom_tabs.bar
    person.until(lambda: docks.bottom.height() == 196)

    def click(name: str) -> QPoint:
        """Click a tab as the pointer stands on it; where it is on the screen."""
        at = bar.tabRect(docks.bottom_tabs.names.index(name)).center()
        QTest.mouseClick(bar, Qt.MouseButton.LeftButton, pos=at)
        return bar.mapToGlobal(QPoint(0, 0))

    before = bar.mapToGlobal(QPoint(0, 0))
    assert click("Inspection") == before
    assert click("Table") == before
    assert click("Inspection") == before
    assert docks.bottom.height() == 196
    QApplication.sendEvent(bar, QEvent(QEvent.Type.Leave))
    person.until(lambda: docks.bottom.height() == 406)
    low = bar.mapToGlobal(QPoint(0, 0))
    assert click("History") == low, "and when it becomes low again"
    QApplication.sendEvent(bar, QEvent(QEvent.Type.Leave))
    person.until(lambda: docks.bottom.height() == 196)
