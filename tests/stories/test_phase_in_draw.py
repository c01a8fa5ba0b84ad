"""Draw mode shows the phase of the run too, so that one sees the effect of a Stop."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtWidgets import QWidget

from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"


def word(person: Person) -> str:
    """What stands beside Stop; the empty text where nothing does."""
    badge = person.window.mode_bar.phase
    return badge.text().removeprefix("●").strip() if badge.isVisible() else ""


def in_window(person: Person, part: QWidget) -> QRect:
    return QRect(part.mapTo(person.window, QPoint(0, 0)), part.size())


def test_in_draw_one_sees_that_a_run_goes_on_holds_and_is_stopped(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    run.choose(world="table")
    assert word(person) == ""
    person.press(Key.Key_F10)
    run.until_done(1)
    # Run says it in its own row.
    assert word(person) == ""
    person.ctrl(Key.Key_1)
    assert word(person) == "Paused"
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    badge, transport = person.window.mode_bar.phase, run.pane.transport
    assert badge.text() == transport.phase.text()
    assert badge.property("kind") == transport.phase.property("kind") == "held"
    assert badge.accessibleName() == "The run: Stopped"
    person.ctrl(Key.Key_2)
    assert word(person) == ""


@pytest.mark.parametrize("width", [1280, 1000, 620, 460])
def test_the_word_beside_stop_is_whole_or_gives_way_and_stop_stays(sit: Sit, width: int) -> None:
    person = sit(HFSM, (width, 800))
    run = AtRun(person)
    run.choose(world="table")
    person.press(Key.Key_F10)
    run.until_done(1)
    person.ctrl(Key.Key_1)
    bar = person.window.mode_bar
    bar.show_phase("Waiting for a human", "busy", "")
    badge = bar.phase
    person.until(lambda: badge.isHidden() or badge.width() >= badge.sizeHint().width())
    stop = in_window(person, bar.stop)
    assert stop.width() == 136
    assert stop.right() < person.window.width()
    if width >= 1000:
        assert badge.isVisible()
    if badge.isVisible():
        assert in_window(person, badge).right() < stop.left()
        assert in_window(person, bar.segments).right() < in_window(person, badge).left()
