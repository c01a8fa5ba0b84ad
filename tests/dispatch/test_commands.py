"""Commands during a run: pause, resume, step, stop, prune, by hand."""

from __future__ import annotations

from typing import Any

from smsl_studio.blueprint.address import Address
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.runs import Story, sample

FIRST = Address("SB1", "State_aaa", "Op_1c")


def hanoi(**choices: Any) -> Story:
    made = sample("hanoi-corrected")
    host = FakeHost(made, **choices.pop("host", {"lasts": 5, "timeout": 60.0}))
    return Story(made, host, goals=["SB1/State_ccc"], **choices)


def calls(story: Story) -> list[str]:
    found: list[str] = story.host.calls  # type: ignore[attr-defined]
    return found


def test_pause_holds_now_and_resume_goes_on_with_the_same_operation() -> None:
    story = hanoi().tick(3)
    story.dispatcher.pause()
    time = story.tick().dispatcher.time
    assert story.phase == "paused"
    assert story.dispatcher.status.running == FIRST
    assert story.tick(20).dispatcher.time == time
    story.dispatcher.resume()
    assert story.run().end.reason == "goal_reached"
    assert calls(story).count(str(FIRST)) == 1
    assert story.words.count("paused") == story.words.count("resumed") == 1


def test_pause_waits_for_an_operation_that_must_finish() -> None:
    story = hanoi(host={"lasts": 5, "stop": "finish"}).tick(3)
    story.dispatcher.pause()
    assert story.tick().phase == "running"
    assert story.run().phase == "paused"
    assert story.configuration == {"SB1": "State_caa"}


def test_pause_aborts_an_operation_that_cannot_be_held() -> None:
    story = hanoi(host={"lasts": 5, "stop": "abort"}).tick(3)
    story.dispatcher.pause()
    assert story.tick().phase == "paused"
    assert "cancel abort" in calls(story)
    assert story.of("operation_ended")[0].outcome == "cancelled"
    assert not story.of("operation_risky")
    story.dispatcher.resume()
    assert story.run().end.reason == "goal_reached"


def test_step_carries_out_one_operation_then_pauses() -> None:
    story = hanoi().tick()
    story.dispatcher.pause()
    story.run()
    story.dispatcher.step()
    assert story.run().phase == "paused"
    assert story.configuration == {"SB1": "State_caa"}
    story.dispatcher.step()
    assert story.run().configuration == {"SB1": "State_cba"}
    assert len(story.commits) == 2


def test_stop_brakes_and_is_the_end() -> None:
    story = hanoi().tick(3)
    story.dispatcher.stop()
    story.tick()
    assert calls(story)[-1] == "cancel hold"
    assert (story.end.reason, story.end.operations) == ("stopped", 0)
    assert story.dispatcher.tick() == ()
    assert story.dispatcher.status.phase == "stopped"


def test_pruning_what_runs_stops_it_and_plans_around_it() -> None:
    story = hanoi().tick(3)
    story.dispatcher.prune(FIRST, "the gripper slips")
    story.run()
    assert story.end.reason == "goal_reached"
    assert story.started.count(str(FIRST)) == 1
    assert (str(FIRST),) not in story.commits
    assert story.of("operation_pruned")[0].reason == "the gripper slips"
    assert len(story.of("route_planned")) == 2


def test_by_hand_nothing_moves_until_it_is_asked_and_the_world_lives() -> None:
    story = hanoi(automatic=False).tick(5)
    assert (story.phase, calls(story)) == ("ready", [])
    assert story.dispatcher.time > 0
    story.ask("Op_1b")
    assert (story.phase, story.configuration) == ("ready", {"SB1": "State_baa"})
    story.ask("Op_1c", "Op_2b", "Op_1b", "Op_3c", "Op_1a", "Op_2c", "Op_1c")
    assert not story.of("goal_reached")
    story.tick()
    assert story.of("goal_reached")[0].goal == "SB1/State_ccc"
    assert story.phase == "ready"
    story.dispatcher.stop()
    assert story.tick().phase == "stopped"
    story.dispatcher.end()
    assert story.tick().end.reason == "stopped"


def test_by_hand_a_step_follows_the_route_and_play_finishes_it() -> None:
    story = hanoi(automatic=False)
    story.dispatcher.step()
    assert story.run().phase == "ready"
    assert story.configuration == {"SB1": "State_caa"}
    story.dispatcher.resume()
    assert story.run().end.reason == "goal_reached"


def test_a_paused_run_takes_orders_and_stays_paused() -> None:
    story = hanoi().tick()
    story.dispatcher.pause()
    story.run()
    assert story.phase == "paused"
    story.dispatcher.resume()
    story.tick(6)
    story.dispatcher.pause()
    story.tick()
    story.run()
    assert story.phase == "paused"


def test_set_automatic_switches_while_it_runs() -> None:
    story = hanoi().tick(2)
    story.dispatcher.set_automatic(False)
    assert story.run().phase == "ready"
    assert len(story.commits) == 1
    story.dispatcher.set_automatic(True)
    assert story.run().end.reason == "goal_reached"


def test_status_shows_what_runs_and_what_is_ahead() -> None:
    story = hanoi().tick(3)
    status = story.dispatcher.status
    assert status.running == status.carrying == FIRST
    assert status.running_since == 0.0
    assert len(status.route) == 6
    assert [str(goal) for goal in status.goals] == ["SB1/State_ccc"]
    assert status.check is not None
    assert status.check.state == "State_caa"
    ahead = {str(one.address) for one in status.possible if one.on_route}
    assert ahead == set()
    assert {one.address for one in status.possible} == {
        FIRST,
        Address("SB1", "State_aaa", "Op_1b"),
    }


def test_pending_states_show_while_a_crossing_is_under_way() -> None:
    made = sample("hfsm")
    story = Story(made, FakeHost(made, lasts=3)).tick(8)
    status = story.dispatcher.status
    assert status.configuration == {"SB1": "State100", "SB2": "State0"}
    assert status.pending == {"SB2": "State1"}
    assert str(status.carrying) == "SB1/State100/Operation100B"
