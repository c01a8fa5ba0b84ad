"""A small screen with large letters: what floats or stands at a side is whole, and hides little."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QApplication, QLabel, QScrollArea, QToolButton, QWidget

from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.shell.frame import screen_room
from tests.stories.at_tasks import PATIENCE, AtTasks
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Modifier = Qt.Key, Qt.KeyboardModifier
LOW = (632, 326)
"""A screen of 1280 by 720 at twice the size, less the frame of the window."""


@pytest.fixture(autouse=True)
def any_size(monkeypatch: pytest.MonkeyPatch) -> None:
    """Here a window may be smaller than this screen asks for, also when it is looked at later."""
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))


def on_screen(part: QWidget) -> QRect:
    return QRect(part.mapToGlobal(QPoint(0, 0)), part.size())


def low(person: Person) -> None:
    """Draw on as little as such a screen leaves."""
    person.window.canvas.camera.motion = False
    person.window.setMinimumSize(1, 1)
    person.window.resize(*LOW)
    person.until(lambda: person.window.height() == LOW[1])


def test_what_people_are_asked_is_whole_in_a_narrow_column(sit: Sit) -> None:
    at = AtTasks(sit(SAMPLES / "registration-people.json", (853, 480)))
    at.start()
    at.person.qtbot.waitUntil(lambda: at.card.card is not None, timeout=PATIENCE)
    around: QWidget | None = at.card
    while not isinstance(around, QScrollArea):
        assert around is not None
        around = around.parentWidget()
    inner, view = around.widget(), around.viewport()
    assert inner is not None
    at.person.until(lambda: inner.width() == view.width())
    head = at.card.findChild(QWidget, "taskHead")
    assert head is not None
    for part in head.findChildren(QWidget):
        if part.isVisible():
            assert on_screen(head).contains(on_screen(part)), part
            assert part.width() >= part.minimumSizeHint().width()


def test_the_card_of_an_operation_is_whole_in_a_low_drawing(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    low(person)
    person.select("SB1/State_aaa")
    person.window.canvas.setFocus()
    person.press(Key.Key_Slash)
    card = person.window.editor.field
    assert isinstance(card, ConnectCard)
    person.until(card.target.isVisible)
    assert card.choices.names
    assert person.window.canvas.rect().contains(card.geometry())
    card.operation.clear()
    person.type("Op")
    assert card.choices.names
    assert person.window.canvas.rect().contains(card.geometry())


def test_the_name_of_a_world_ends_where_the_buttons_begin(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.ctrl(Key.Key_2)
    person.press(Key.Key_F10)
    pane = person.window.features.run.pane.scene
    person.until(lambda: pane.fault.isEnabled())
    pane.setMinimumWidth(0)
    for wide in (360, 260):
        pane.setFixedWidth(wide)
        QApplication.processEvents()
        assert pane.width() == wide
        words = [part for part in pane.findChildren(QLabel) if part.isVisible() and part.text()]
        for part in words:
            if on_screen(part).top() < on_screen(pane.fault).bottom():
                assert not on_screen(part).intersects(on_screen(pane.fault)), part.text()


def test_the_choices_of_a_run_are_read_whole_in_a_window_of_1280(sit: Sit) -> None:
    """Beside four modes the state at the start was read as 0...0."""
    person = sit(SAMPLES / "registration.json", (1280, 800))
    person.ctrl(Key.Key_2)
    transport = person.window.features.run.pane.transport
    person.until(lambda: transport.isVisible() and transport.start.count() == 8)
    for choice in (transport.world, transport.start, transport.goal):
        words = choice.fontMetrics().horizontalAdvance(choice.currentText())
        assert choice.width() >= words + 38, choice.currentText()


def test_the_tools_without_room_stand_in_a_menu_of_the_row(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1440, 900))
    tools = person.window.mode_bar.findChildren(QToolButton)
    (more,) = (one for one in tools if one.accessibleName() == "More drawing tools")
    assert more.isHidden()
    person.window.setMinimumSize(1, 1)
    person.window.resize(640, 540)
    person.until(more.isVisible)
    menu = more.menu()
    menu.aboutToShow.emit()
    words = [one.text() for one in menu.actions()]
    assert "Align…" in words
    shown = {one.defaultAction().text() for one in tools if one.isVisible() and one.defaultAction()}
    assert not shown & set(words)
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_A)
    (align,) = (one for one in menu.actions() if one.text() == "Align…")
    assert align.isEnabled()


def test_a_choice_without_room_shows_the_name_of_the_state(sit: Sit) -> None:
    """It was shown as e...L, and SB1/aa0 as SB...a0."""
    person = sit(SAMPLES / "registration.json", (1280, 800))
    person.ctrl(Key.Key_2)
    start = person.window.features.run.pane.transport.start
    metrics = start.fontMetrics()
    for words, own in (("each INITIAL", "INITIAL"), ("SB1/aa0", "aa0")):
        start.addItem(words, words)
        start.setCurrentIndex(start.count() - 1)
        assert start.words_in(metrics.horizontalAdvance(words), metrics) == words
        assert start.words_in(metrics.horizontalAdvance(words) - 1, metrics) == own
        assert words in start.toolTip()
