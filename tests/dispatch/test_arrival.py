"""The end of a run: a goal is reported after a fresh check; if a fact is false, the run holds."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.host.local import LocalHost
from tests.dispatch.fake_host import TICK, FakeHost
from tests.dispatch.runs import Story, blueprint, branch

FLAT = blueprint({"A": branch({"00": "one>10", "10": "two>11", "11": "back>00"}, activating="11")})
TWO = blueprint(
    {
        "A": branch({"0": "a>1", "1": ""}, activating="1"),
        "B": branch({"0": "b>1", "1": ""}, activating="1"),
    }
)
NESTED = blueprint(
    {
        "A": branch({"00": "up>10, pure>01", "10": "", "01": ""}, activating="10", subs={"B": 0}),
        "B": branch({"00": "u>10", "10": "v>11", "11": "w>00"}, activating="11"),
    }
)


def on_table(made: Any, **choices: Any) -> Story:
    return Story(made, LocalHost(made, "table"), **choices)


def at_goal(made: Any = FLAT, commits: int = 2, **choices: Any) -> Story:
    """The last operation is committed; nothing has been told of the goal yet."""
    story = on_table(made, **choices)
    while len(story.commits) < commits:
        story.tick()
    assert not story.of("goal_reached")
    return story


def kind(story: Story) -> str:
    """How the run held; it must not have claimed anything, before or after."""
    assert not story.of("goal_reached")
    (held,) = story.of("held")
    return str(held.kind)


def test_a_goal_is_told_one_tick_after_the_last_commit() -> None:
    story = at_goal().run()
    assert story.words[-2:] == ["goal_reached", "run_finished"]
    assert story.end.t == pytest.approx(story.of("committed")[-1].t + 0.05)
    assert story.end.reason == "goal_reached"


@pytest.mark.parametrize(
    ("disturbance", "words"),
    [
        ({"kind": "dropout"}, "Fact 1 of A is unknown, no reading for 0.3 s"),
        ({"kind": "stuck", "value": "0"}, "Fact 1 of A reads 0, not 1"),
        ({"kind": "delay", "seconds": 0.5}, "Fact 1 of A is unknown, no reading for 0.3 s"),
    ],
)
def test_a_goal_fact_that_is_lost_in_the_tick_of_the_goal(
    disturbance: dict[str, Any], words: str
) -> None:
    story = at_goal()
    story.dispatcher.disturb("A/0", **disturbance)
    story.run()
    assert (kind(story), story.end.reason) == ("goal_unconfirmed", "held")
    expected = f"The goal is not confirmed: A/State11 does not check true: {words}"
    assert story.end.sentence == expected


def test_a_goal_fact_that_is_changed_in_the_tick_of_the_goal() -> None:
    story = at_goal(attended=True)
    story.dispatcher.inject("set", fact="A/1", value="0")
    story.run()
    assert kind(story) == "goal_unconfirmed"
    status = story.dispatcher.status
    assert (status.phase, status.reason) == ("fault_hold", "goal_unconfirmed")
    assert status.candidates == ({"A": "State10"},)
    assert status.offers[0].command == "adopt"
    story.dispatcher.adopt()
    story.run()
    assert story.end.reason == "goal_reached"


def test_a_run_that_adopts_goes_on_from_there_to_its_goal() -> None:
    story = at_goal(on_mismatch="adopt")
    story.dispatcher.inject("set", fact="A/1", value="0")
    story.run()
    assert story.end.reason == "goal_reached"
    assert len(story.of("goal_reached")) == 1
    assert len(story.commits) == 3


def test_a_pause_in_the_tick_of_the_goal_comes_first() -> None:
    story = at_goal(attended=True)
    story.dispatcher.pause()
    story.tick(5)
    assert (story.phase, story.of("goal_reached")) == ("paused", [])
    story.dispatcher.disturb("A/0", "dropout")
    story.dispatcher.resume()
    story.run()
    assert kind(story) == "goal_unconfirmed"


def test_whoever_leaves_a_run_that_is_paused_at_its_goal_gets_the_same_check() -> None:
    for lost, reason in ((False, "goal_reached"), (True, "held")):
        story = at_goal(attended=True)
        story.dispatcher.pause()
        story.tick()
        if lost:
            story.dispatcher.disturb("A/0", "dropout")
        story.dispatcher.leave()
        story.run()
        assert story.end.reason == reason
        assert bool(story.of("goal_reached")) is not lost


def test_a_reading_counts_only_if_it_was_taken_after_the_last_thing_that_happened() -> None:
    story = at_goal()
    story.dispatcher.disturb("A/0", "delay", seconds=0.15)
    story.tick()
    assert story.dispatcher.status.sentence == "A/State11 awaits a new reading of A/0."
    story.run()
    commit, told = story.of("committed")[-1].t, story.of("goal_reached")[0].t
    assert told == pytest.approx(commit + 0.05 + 0.15)


def test_a_command_asks_for_newer_readings_than_itself() -> None:
    story = at_goal(attended=True)
    story.dispatcher.disturb("A/0", "delay", seconds=0.15)
    story.tick(2)
    story.dispatcher.full_map(True)
    story.run()
    said = story.of("commanded")[-1].t
    assert story.of("goal_reached")[0].t == pytest.approx(said + 0.05 + 0.15)


def test_no_goal_is_told_of_a_run_that_holds() -> None:
    class Meddling(FakeHost):
        """With the second operation another SB's fact changes."""

        def _carry_out(self, edge: Any) -> None:
            super()._carry_out(edge)
            self.facts["B", 0] = "1"

    story = Story(TWO, Meddling(TWO), goals=["A/State1"], attended=True).run()
    story.tick(5)
    assert kind(story) == "held"
    assert story.phase == "fault_hold"


def test_a_goal_that_holds_at_the_start_is_checked_too() -> None:
    story = on_table(FLAT, goals=["A/State00"]).run()
    assert (story.end.reason, story.end.operations) == ("goal_reached", 0)
    assert story.end.t == pytest.approx(0.05)
    story = on_table(FLAT, goals=["A/State00"])
    story.dispatcher.disturb("A/1", "dropout")
    story.run()
    assert kind(story) == "goal_unconfirmed"


def test_a_goal_fact_that_is_unknown_before_the_last_operation() -> None:
    story = on_table(TWO, goals=["A/State1", "B/State0"], attended=True)
    story.dispatcher.disturb("B/0", "dropout")
    story.run()
    assert kind(story) == "goal_unconfirmed"
    assert "Fact 1 of B is unknown" in story.of("held")[0].reason


def test_several_goals_must_all_be_true_at_the_end_also_those_that_were_told() -> None:
    story = on_table(TWO, goals=["A/State1", "B/State1"])
    while len(story.commits) < 2:
        story.tick()
    assert [one.goal for one in story.of("goal_reached")] == ["A/State1"]
    story.dispatcher.disturb("A/0", "dropout")
    story.run()
    assert story.end.reason == "held"
    assert [one.goal for one in story.of("goal_reached")] == ["A/State1"]
    assert story.of("held")[0].kind == "goal_unconfirmed"


def test_without_a_goal_every_root_is_confirmed() -> None:
    story = on_table(TWO).run()
    assert [one.goal for one in story.of("goal_reached")] == ["A/State1", "B/State1"]
    assert story.end.reason == "goal_reached"


def test_a_goal_on_a_base_hangs_on_the_facts_below() -> None:
    story = on_table(NESTED)
    while len(story.commits) < 2:
        story.tick()
    story.dispatcher.disturb("B/1", "dropout")
    story.run()
    assert kind(story) == "goal_unconfirmed"
    assert "B/1 in B is unknown" in story.end.sentence


def test_a_goal_on_a_sub_is_confirmed_by_the_subs_own_facts() -> None:
    for fact in ("B/0", "B/1"):
        story = on_table(NESTED, goals=["B/State10"])
        while not story.commits:
            story.tick()
        story.dispatcher.disturb(fact, "dropout")
        story.run()
        assert kind(story) == "goal_unconfirmed"


def test_a_fact_below_that_no_goal_hangs_on_keeps_nothing_from_ending() -> None:
    story = on_table(NESTED, goals=["A/State01"])
    story.dispatcher.disturb("B/1", "dropout")
    story.run()
    assert story.end.reason == "goal_reached"


def test_a_step_to_the_goal_tells_it_and_pauses_then() -> None:
    story = on_table(FLAT, attended=True, goals=["A/State10"])
    story.dispatcher.step()
    story.run()
    assert story.words[-2:] == ["goal_reached", "paused"]
    story.dispatcher.step()
    story.run()
    assert story.end.reason == "goal_reached"
    assert len(story.of("goal_reached")) == 1


def test_by_hand_a_goal_is_told_after_the_check_and_the_run_stays_open() -> None:
    story = on_table(FLAT, automatic=False).ask("one", "two")
    story.tick()
    assert story.words[-1] == "goal_reached"
    story.tick(5)
    assert (story.phase, len(story.of("goal_reached"))) == ("ready", 1)


def test_by_hand_a_goal_that_is_not_confirmed_holds() -> None:
    story = on_table(FLAT, automatic=False).ask("one", "two")
    story.dispatcher.disturb("A/1", "dropout")
    story.tick(10)
    assert (kind(story), story.phase) == ("goal_unconfirmed", "fault_hold")
    story.dispatcher.disturb("A/1", "none")
    story.dispatcher.resume()
    story.tick(3)
    assert (story.phase, len(story.of("goal_reached"))) == ("ready", 1)


def test_a_flicker_shorter_than_the_settling_time_is_waited_for() -> None:
    for ticks, reason in ((3, "goal_reached"), (10, "held")):
        host = FakeHost(FLAT, settle=5 * TICK)
        story = Story(FLAT, host)
        while len(story.commits) < 2:
            story.tick()
        host.facts["A", 1] = "0"
        story.tick(ticks)
        host.facts["A", 1] = "1"
        story.run()
        assert story.end.reason == reason


def test_by_hand_a_step_that_awaits_the_goals_check_gives_way_to_a_request() -> None:
    story = on_table(FLAT, automatic=False).ask("one", "two")
    story.dispatcher.disturb("A/1", "delay", seconds=10.0)
    story.tick(2)
    story.dispatcher.step()
    assert story.tick().phase == "running"
    story.ask("back")
    assert (story.reasons, story.started[-1]) == ([], "A/State11/back")
