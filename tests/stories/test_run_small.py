"""The run page in a small window: the facts have rows, and the page does not scroll sideways."""

from __future__ import annotations

import pytest

from smsl_studio.studio.features.run.facts_place import NAMES
from smsl_studio.studio.running.facts_table import HEADS, ROW
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

HFSM = SAMPLES / "hfsm.json"


def paused(person: Person) -> AtRun:
    run = AtRun(person)
    run.choose(world="table")
    person.click(run.pane.transport.step)
    run.until_done(1)
    return run


@pytest.mark.parametrize("size", [(1280, 720), (1280, 800)])
def test_three_facts_are_in_view_beside_the_lists(sit: Sit, size: tuple[int, int]) -> None:
    person = sit(HFSM, size)
    pane = paused(person).pane
    # The rows come with the run, and the places follow them.
    person.until(lambda: pane.facts.height() >= HEADS + 28 + 3 * ROW)
    assert pane.facts_place.lists.names == ("Possible now", "Events")


def test_in_a_small_window_they_are_tabs_and_come_back(sit: Sit) -> None:
    person = sit(HFSM, (853, 560))
    pane, body = paused(person).pane, person.window.body
    lists = pane.facts_place.lists
    assert lists.names == ("Possible now", "Events", *NAMES)
    assert body.horizontalScrollBar().maximum() == 0, "nothing lies beside the window"
    lists.show_page("Facts")
    person.until(pane.facts.isVisible)
    assert pane.facts.height() >= HEADS + 28 + ROW
    assert pane.facts.width() > 380
    lists.show_page("Check")
    person.until(pane.check.isVisible)
    person.window.resize(1440, 900)
    person.until(lambda: lists.names == ("Possible now", "Events"))
    person.until(lambda: pane.facts.isVisible() and pane.check.isVisible())
    assert (
        pane.facts.mapTo(pane, pane.facts.rect().bottomLeft()).y()
        < pane.check.mapTo(pane, pane.check.rect().topLeft()).y()
    ), "the state check stands below the facts"


def test_at_640_pixels_the_page_fits_and_the_notice_is_whole(sit: Sit) -> None:
    person = sit(HFSM, (640, 398))
    paused(person)
    person.window.setMinimumSize(0, 0)
    person.window.resize(640, 398)
    body, line = person.window.body, person.window.status_line
    person.until(lambda: person.window.width() == 640)
    assert body.horizontalScrollBar().maximum() == 0
    end = line.ending
    assert end.x() + end.width() <= line.width(), "the notice is never cut"
    assert end.width() >= end.fontMetrics().horizontalAdvance(end.text())
