"""A veto holds where it was given: neither reading the status nor resuming the run lifts it."""

from __future__ import annotations

import pytest

from tests.dispatch.people.tasks import Attended
from tests.dispatch.runs import blueprint, branch
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


def test_the_record_says_which_operation_was_vetoed() -> None:
    story = hanoi(automatic=False).tick()
    assert said(story, "veto").address == str(FIRST)


def test_a_veto_meets_what_people_are_asked_about() -> None:
    made = blueprint(
        {
            "SB": branch(
                {"0": "go>1, alt>2", "1": "", "2": "x>1"},
                activating="1",
                operations={"alt": {"confirm": ["surgeon"]}},
            )
        }
    )
    story = Attended(made, automatic=False).tick()
    said(story, "ask", made.resolve("SB/State0/alt"))
    assert said(story, "veto").address == "SB/State0/alt"
    assert story.outcomes == [("withdrawn", "")]
    vetoed = [str(one.address) for one in story.dispatcher.status.possible if one.vetoed]
    assert vetoed == ["SB/State0/alt"]
