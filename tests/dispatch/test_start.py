"""Clauses 3 and 11: reasons to refuse a run before anything moves, and the goals of a run."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.errors import HostError
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.runs import Story, blueprint, branch, sample

SUB = branch({"0": "go>1", "1": "back>0"})


def refused(story: Story) -> str:
    assert story.end.event == "run_finished"
    assert story.end.reason == "refused"
    assert not [call for call in getattr(story.host, "calls", []) if "/" in call]
    assert story.dispatcher.finished
    assert story.dispatcher.tick() == ()
    return str(story.end.sentence)


def test_clause_3_every_state_check_is_asked_on_sensed_facts() -> None:
    story = Story(sample("three-levels"))
    assert story.words[0] == "run_started"
    checked = [(event.address, event.result) for event in story.of("state_checked")]
    assert checked == [
        ("SURGERY/State000", "true"),
        ("REGISTRATION/State000", "true"),
        ("DIGITIZATION/State00", "true"),
    ]


def test_clause_3_a_state_check_that_is_false_refuses_and_names_the_fact() -> None:
    class Elsewhere(FakeHost):
        def open(self, start: Any) -> Any:
            opened = super().open(start)
            self.facts["SB1", 1] = "c"
            return opened

    made = sample("hanoi")
    sentence = refused(Story(made, Elsewhere(made)))
    assert "SB1/State_aaa does not check true: Fact 2 of SB1 reads c, not a" in sentence


def test_clause_3_a_state_check_that_is_unknown_refuses_with_the_reason() -> None:
    class Blind(FakeHost):
        def open(self, start: Any) -> Any:
            opened = super().open(start)
            self.facts["SB1", 0] = None
            return opened

    made = sample("hanoi")
    assert "Fact 1 of SB1 is unknown, no valid reading" in refused(Story(made, Blind(made)))


@pytest.mark.parametrize(
    ("start", "words"),
    [
        ({"SB2": "State1"}, "the start SB2/State1 disagrees with SB1/State000"),
        ({"SB1": "State111", "SB2": "State0"}, "the start SB2/State0 disagrees"),
    ],
)
def test_clause_3_starts_that_disagree(start: dict[str, str], words: str) -> None:
    assert words in refused(Story(sample("hfsm"), start=start))


def test_clause_1_initial_that_is_activating_refuses() -> None:
    sub = branch({"0": "go>1", "1": "back>0"}, initial="1")
    made = blueprint({"BASE": branch({"0": "up>1", "1": ""}, subs={"SUB": 0}), "SUB": sub})
    assert "its INITIAL is its ACTIVATING" in refused(Story(made))


@pytest.mark.parametrize(
    "goals",
    [
        ("SB1/State111", "SB2/State0"),
        ("SB1/State100", "SB2/State1"),
        ("SB1/State100", "SB1/State110"),
    ],
)
def test_clause_11_goals_that_contradict_are_refused_at_the_start(goals: tuple[str, ...]) -> None:
    assert "cannot hold" in refused(Story(sample("hfsm"), goals=goals))


def test_clause_11_contradictions_are_seen_through_a_level_between() -> None:
    goals = ("SURGERY/State111", "DIGITIZATION/State00")
    assert "SURGERY/State111" in refused(Story(sample("three-levels"), goals=goals))
    assert Story(sample("three-levels"), goals=("SURGERY/State111", "DIGITIZATION/State11"))


def test_clause_11_bases_must_not_want_a_shared_sub_on_and_off() -> None:
    made = blueprint(
        {
            "ONE": branch({"0": "up>1", "1": ""}, subs={"SUB": 0}),
            "TWO": branch({"0": "up>1", "1": ""}, subs={"SUB": 0}),
            "SUB": SUB,
        }
    )
    goals = ("ONE/State1", "TWO/State0")
    assert "SUB cannot be both on and off" in refused(Story(made, goals=goals))


def test_hardware_needs_an_inspection_record() -> None:
    made = sample("hanoi")
    assert "hardware" in refused(Story(made, FakeHost(made, hardware=True)))


def test_a_host_that_dies_while_it_opens_is_a_failed_run() -> None:
    class Dead(FakeHost):
        def open(self, start: Any) -> Any:
            raise HostError("the child did not answer within 10 s", advice="Try again.")

    made = sample("hanoi")
    story = Story(made, Dead(made))
    assert story.words == ["held", "run_finished"]
    assert (story.end.reason, story.end.sentence) == (
        "failed",
        "the child did not answer within 10 s",
    )
    assert story.dispatcher.status.phase == "fault_hold"


def test_nothing_has_moved_before_the_first_tick() -> None:
    story = Story(sample("hanoi"))
    assert story.dispatcher.opened is not None
    assert story.dispatcher.status.phase == "running"
    assert story.host.calls == []  # type: ignore[attr-defined]
