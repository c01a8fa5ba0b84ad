"""A veto holds where it was said: neither looking at the run nor letting it go on lifts it."""

from __future__ import annotations

import pytest

from tests.dispatch.supervision.runs import (
    FIRST,
    OTHER,
    SECOND,
    facts_of,
    fault_hold,
    hanoi,
    middle,
    said,
)


@pytest.mark.parametrize("looked", [False, True])
def test_looking_at_a_paused_run_lifts_no_veto_of_what_follows(looked: bool) -> None:
    story = middle()
    assert not said(story, "veto", SECOND).refused
    said(story, "pause")
    if looked:
        assert SECOND not in story.dispatcher.status.route
    said(story, "resume")
    story.run()
    assert story.phase == "done"
    assert str(SECOND) not in story.started


def test_the_route_of_a_held_operation_goes_on_from_where_it_leads() -> None:
    story = middle()
    said(story, "set_cost", FIRST, 2.0)
    said(story, "pause")
    route = story.dispatcher.status.route
    assert route[0] == SECOND


def test_a_veto_said_while_the_run_holds_is_not_lifted_by_resume() -> None:
    story = fault_hold()
    facts_of(story)["SB1", 0] = "a"
    assert not said(story, "veto", OTHER).refused
    said(story, "resume")
    story.run()
    assert story.phase == "fault_hold"
    assert str(OTHER) not in story.started
    assert "Only risky operations" in story.dispatcher.status.sentence


def test_resume_lifts_only_the_vetoes_that_left_no_route() -> None:
    story = hanoi(avoid=[str(OTHER)], automatic=False).tick()
    said(story, "veto", FIRST)
    said(story, "set_automatic", True)
    story.run()
    assert story.phase == "no_route"
    said(story, "restore", OTHER)
    said(story, "set_cost", FIRST, 100.0)
    said(story, "veto", OTHER)
    said(story, "resume")
    story.run()
    assert story.phase == "done"
    assert story.started[0] == str(FIRST)
    assert str(OTHER) not in story.started
