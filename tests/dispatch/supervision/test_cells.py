"""The command table of the specification, one test for each cell: idle, in motion, afterwards."""

from __future__ import annotations

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.host.protocol import Outcome
from smsl_studio.runlog.phase import RUN_STATES
from tests.dispatch.fake_host import Fault
from tests.dispatch.runs import Story, blueprint, branch, sample
from tests.dispatch.supervision.runs import (
    FIRST,
    SECOND,
    between,
    calls,
    facts_of,
    hanoi,
    middle,
    paused,
    said,
    stopped,
    taken_over,
)


def begun(story: Story) -> list[str]:
    """The functions that the host was asked to begin."""
    return [call for call in calls(story) if "/" in call and " " not in call]


def offered(story: Story) -> list[str]:
    return [offer.command for offer in story.dispatcher.status.offers]


# pause ------------------------------------------------------------------------------------------


def test_pause_while_idle_stays() -> None:
    story = between()
    assert said(story, "pause").refused == ""
    time = story.dispatcher.time
    assert story.tick(20).phase == "paused"
    assert (story.dispatcher.time, begun(story)) == (time, [str(FIRST)])


def test_pause_in_the_middle_holds_now_by_default() -> None:
    story = middle()
    said(story, "pause")
    time = story.dispatcher.time
    assert story.tick(20).dispatcher.time == time
    assert (story.phase, story.dispatcher.status.running) == ("paused", FIRST)


def test_pause_in_the_middle_aborts_what_declares_so() -> None:
    story = middle(host={"stop": "abort"})
    said(story, "pause")
    assert "cancel abort" in calls(story)
    assert story.run().phase == "paused"
    assert not story.commits


def test_pause_in_the_middle_lets_end_what_declares_so() -> None:
    story = middle(host={"stop": "finish"})
    said(story, "pause")
    assert story.run().phase == "paused"
    assert len(story.commits) == 1
    assert not [call for call in calls(story) if call.startswith("cancel")]


def test_pause_in_the_middle_cancels_what_cannot_resume() -> None:
    story = middle(host={"resumes": False})
    said(story, "pause")
    assert story.run().phase == "paused"
    assert "cancel hold" in calls(story)
    said(story, "resume")
    story.run()
    assert begun(story).count(str(FIRST)) == 2


def test_after_a_pause_resume_checks_the_state_again() -> None:
    story = paused()
    facts_of(story)["SB1", 0] = "b"
    said(story, "resume")
    assert story.phase == "fault_hold"
    assert story.words[-3:] == ["fact_changed", "mismatch", "held"]
    assert len(begun(story)) == 1


def test_after_a_pause_resume_finds_the_route_again() -> None:
    story = paused()
    said(story, "prune", SECOND, "worn")
    said(story, "resume", ticks=2)
    planned = story.of("route_planned")[-1].operations
    assert str(SECOND) not in planned
    assert story.run().end.reason == "goal_reached"


def test_after_a_pause_a_held_operation_is_cancelled_where_another_branch_has_moved() -> None:
    made = sample("three-roots")
    story = hanoi(blueprint=made, goals=["ROBOT/State10"]).tick(3)
    said(story, "pause")
    facts_of(story)["TOOLPLAN", 0] = "1"
    said(story, "resume")
    story.run()
    assert story.of("operation_ended")[0].outcome == "cancelled"
    assert (story.phase, story.commits) == ("fault_hold", [])


# step -------------------------------------------------------------------------------------------


def test_step_while_idle_is_one_operation_then_pause() -> None:
    story = paused()
    assert said(story, "step").refused == ""
    assert story.run().phase == "paused"
    assert len(story.commits) == 2


def test_step_between_two_operations_of_a_run_that_goes_on_pauses_after_the_next() -> None:
    story = between()
    said(story, "step")
    assert story.run().phase == "paused"
    assert len(story.commits) == 2


def test_step_in_the_middle_is_ignored_and_says_so() -> None:
    story = middle()
    refused = said(story, "step").refused
    assert refused == f"{FIRST} is being carried out; step is ignored until it ended"
    assert story.run().end.reason == "goal_reached"


def test_after_a_step_the_next_one_checks_the_state_again() -> None:
    story = paused()
    facts_of(story)["SB1", 0] = "b"
    said(story, "step")
    assert (story.phase, len(begun(story))) == ("fault_hold", 1)


# veto -------------------------------------------------------------------------------------------


def test_veto_while_idle_skips_the_next_edge_once() -> None:
    story = between()
    assert said(story, "veto", by="Brandt").refused == ""
    assert story.run().end.reason == "goal_reached"
    assert story.commits[1] != (str(SECOND),)


def test_veto_in_the_middle_is_too_late_and_offers_stop() -> None:
    story = middle()
    assert said(story, "veto").refused == f"too late, {FIRST} is being carried out; a stop ends it"
    assert offered(story) == ["stop"]
    assert story.run().end.reason == "goal_reached"
    assert len(story.commits) == 7


def test_veto_in_the_middle_of_what_comes_next_is_in_time() -> None:
    story = middle()
    assert said(story, "veto", SECOND).refused == ""
    assert story.run().end.reason == "goal_reached"
    assert (str(FIRST),) == story.commits[0]
    assert story.commits[1] != (str(SECOND),)


def test_after_a_veto_the_route_is_found_again_and_the_edge_may_be_used_later() -> None:
    story = hanoi(avoid=["SB1/State_aaa/Op_1b"])
    said(story, "veto")
    assert story.phase == "no_route"
    assert f"it would with {FIRST}" in story.dispatcher.status.sentence
    said(story, "resume")
    assert story.run().end.reason == "goal_reached"
    assert story.commits[0] == (str(FIRST),)


# prune ------------------------------------------------------------------------------------------


def test_prune_while_idle_excludes_until_restored_with_a_reason() -> None:
    story = between(automatic=True)
    assert said(story, "prune", SECOND, "worn", by="Brandt").reason == "worn"
    assert story.of("operation_pruned")[0].reason == "worn"
    assert story.run().end.reason == "goal_reached"
    assert (str(SECOND),) not in story.commits


def test_prune_in_the_middle_stops_the_operation_and_the_world_settles() -> None:
    story = middle(host={"settle": 0.3})
    said(story, "prune", FIRST, "slips")
    assert calls(story)[-1] == "cancel hold"
    assert story.of("operation_ended")[0].outcome == "cancelled"
    time = story.dispatcher.time
    story.run()
    settled = story.of("relocalised")[0]
    assert settled.t >= time + 0.1
    assert not story.of("operation_risky")


def test_after_a_prune_the_route_is_found_again() -> None:
    story = middle()
    said(story, "prune", FIRST, "slips")
    assert story.run().end.reason == "goal_reached"
    assert len(story.of("route_planned")) == 2
    assert (str(FIRST),) not in story.commits


def test_pruning_a_base_edge_stops_what_its_sub_carries_out() -> None:
    story = hanoi(blueprint=sample("hfsm"), goals=[])
    while story.dispatcher.status.running is None or story.dispatcher.status.running.branch != (
        "SB2"
    ):
        story.tick()
    asked = story.dispatcher.status.carrying
    assert asked is not None
    assert asked.branch == "SB1"
    said(story, "prune", asked, "not this way")
    story.run()
    assert str(asked) not in [edge for edges in story.commits for edge in edges]


# take over --------------------------------------------------------------------------------------


def test_take_over_while_idle_locks_automation_out() -> None:
    story = between()
    assert said(story, "take_over", by="Brandt").refused == ""
    assert story.of("taken_over")[0].by == "Brandt"
    count = len(begun(story))
    for word in ("resume", "step", "pause"):
        assert "Brandt has taken over" in said(story, word).refused
    assert "locked out" in said(story, "ask", SECOND).refused
    assert len(begun(story.tick(30))) == count
    assert (story.phase, story.dispatcher.status.by) == ("taken_over", "Brandt")


def test_take_over_in_the_middle_holds_and_only_observes() -> None:
    story = taken_over()
    assert story.of("operation_ended")[0].outcome == "cancelled"
    assert "cancel hold" in calls(story)
    time = story.dispatcher.time
    facts_of(story)["SB1", 0] = "b"
    story.tick(5)
    assert story.dispatcher.time > time
    assert story.of("fact_changed")[-1].value == "b"
    check = story.dispatcher.status.check
    assert check is not None
    assert check.truth is False
    assert not story.of("held", "mismatch")


def test_giving_back_needs_one_configuration_that_checks_true() -> None:
    story = taken_over()
    facts = facts_of(story)
    facts["SB1", 0] = None
    assert "Fact 1 of SB1 is unknown" in said(story, "give_back").refused
    facts["SB1", 0] = "nowhere"
    assert "agrees with no configuration" in said(story, "give_back").refused
    assert said(story, "accept").refused == "nothing is offered: give it back first"
    assert story.phase == "taken_over"


def test_giving_back_is_accepted_explicitly_and_the_old_operation_never_resumes() -> None:
    story = taken_over()
    facts_of(story)["SB1", 0] = "b"
    assert said(story, "give_back", by="Brandt").refused == ""
    assert story.phase == "taken_over"
    assert story.dispatcher.status.candidates == ({"SB1": "State_baa"},)
    assert offered(story)[0] == "accept"
    said(story, "accept", by="Brandt")
    (given,) = story.of("given_back")
    assert (given.by, given.configuration) == ("Brandt", {"SB1": "State_baa"})
    assert (story.phase, story.configuration) == ("paused", {"SB1": "State_baa"})
    said(story, "resume")
    assert story.run().end.reason == "goal_reached"
    assert begun(story).count(str(FIRST)) == 1


def test_what_was_offered_must_still_hold_when_it_is_accepted() -> None:
    story = taken_over()
    said(story, "give_back")
    facts_of(story)["SB1", 0] = "b"
    assert "no longer agrees with SB1/State_aaa" in said(story, "accept").refused
    assert story.phase == "taken_over"


def test_giving_back_where_two_states_read_alike_names_them() -> None:
    values = {"SB1": branch({"0": "go>1", "1": ""})}
    values["SB1"]["Twin_0"] = {}
    story = hanoi(blueprint=blueprint(values), goals=["SB1/State1"]).tick(3)
    said(story, "take_over")
    assert "SB1/State0 or SB1/Twin_0" in said(story, "give_back").refused


# stop -------------------------------------------------------------------------------------------


def test_stop_while_idle_latches() -> None:
    story = between()
    said(story, "stop", by="Brandt")
    count = len(begun(story))
    for word in ("resume", "step", "pause", "take_over"):
        assert said(story, word).refused == "the run is stopped, reset it first"
    assert said(story, "stop").refused == "it is stopped already"
    assert (story.phase, len(begun(story.tick(30)))) == ("stopped", count)
    assert (story.dispatcher.status.by, story.dispatcher.finished) == ("Brandt", False)


def test_stop_in_the_middle_brakes_before_the_next_step_of_the_world() -> None:
    story = middle()
    time = story.dispatcher.time
    said(story, "stop")
    assert calls(story)[-1] == "cancel hold"
    stopped_at = story.of("stopped")[0].t
    assert stopped_at == time
    assert story.of("operation_ended")[0].t == time
    assert story.tick(5).dispatcher.time > time
    assert not story.commits


def test_stop_in_the_middle_brakes_also_what_would_rather_finish() -> None:
    story = middle(host={"stop": "finish"})
    said(story, "stop")
    assert calls(story)[-1] == "cancel hold"


def test_after_a_stop_reset_only_unlatches_to_paused() -> None:
    story = stopped()
    assert offered(story) == ["reset", "end"]
    assert said(story, "reset", by="Brandt").refused == ""
    time = story.dispatcher.time
    assert (story.phase, story.tick(9).dispatcher.time) == ("paused", time)
    assert story.of("reset")[0].unknown == ("SB1/0",)
    said(story, "resume")
    assert story.run().end.reason == "goal_reached"
    assert begun(story).count(str(FIRST)) == 2


def test_after_a_stop_touched_facts_are_unknown_until_they_are_sensed_anew() -> None:
    story = stopped()
    assert story.of("fact_changed")[-2].value is None
    assert story.of("fact_changed")[-1].value == "a"
    said(story, "reset")
    reading = story.dispatcher.status.scene.readings["SB1", 0]
    assert reading.value is None
    assert reading.reason == "an operation that was stopped may have changed it"
    assert story.dispatcher.status.scene.readings["SB1", 1].value == "a"
    said(story, "resume")
    assert story.dispatcher.status.scene.readings["SB1", 0].value == "a"


def test_after_a_stop_declared_facts_are_unknown_too() -> None:
    story = middle(host={"touches": (("SB1", 2),)})
    said(story, "stop")
    said(story, "reset")
    assert story.of("reset")[0].unknown == ("SB1/0", "SB1/2")


def test_after_a_stop_a_touched_fact_that_nobody_senses_needs_a_person() -> None:
    story = middle(host={"blind": [("SB1", 0)]})
    said(story, "stop")
    said(story, "reset")
    said(story, "resume")
    assert story.phase == "fault_hold"
    assert "Fact 1 of SB1 is unknown" in story.dispatcher.status.sentence
    assert "adopt" in offered(story)
    said(story, "adopt")
    assert story.run().end.reason == "goal_reached"


def test_after_a_stop_end_finishes_the_run() -> None:
    story = stopped()
    said(story, "end", by="Brandt")
    assert (story.end.reason, story.end.sentence) == ("stopped", "Stopped by Brandt.")
    assert story.dispatcher.finished
    assert story.phase == "stopped"


def test_unattended_a_stop_is_the_end_at_once() -> None:
    story = middle(attended=False)
    said(story, "stop")
    assert story.words[-2:] == ["stopped", "run_finished"]
    assert story.end.reason == "stopped"


# failures ---------------------------------------------------------------------------------------


def test_everything_cut_names_what_stands_in_the_way() -> None:
    story = hanoi(avoid=["SB1/State_aaa/Op_1b"], attended=False)
    said(story, "prune", FIRST, "bent")
    assert story.end.reason == "no_route"
    assert story.end.sentence == (
        "Nothing permitted leads from SB1/State_aaa to SB1/State_ccc; "
        "it would with SB1/State_aaa/Op_1c."
    )
    assert f"{FIRST}: {FIRST} is pruned: bent" in story.of("held")[0].details


def test_a_hold_offers_every_way_out_with_a_sentence() -> None:
    story = hanoi(host={"faults": {str(FIRST): Fault(Outcome.FAILED, {})}},
                  avoid=["SB1/State_aaa/Op_1b"])  # fmt: skip
    story.run()
    assert story.phase == "fault_hold"
    always = [row.word for row in COMMANDS.values() if "fault_hold" in row.offered]
    assert {"resume", "take_over", "end"} <= set(always)
    assert offered(story) == ["restore", "ask", *always]
    assert all(offer.sentence.endswith(".") for offer in story.dispatcher.status.offers)
    assert story.dispatcher.status.details


def test_a_command_with_a_sentence_of_offer_is_offered_in_some_run_state() -> None:
    about_something = {"adopt", "restore", "ask", "accept"}
    for row in COMMANDS.values():
        assert bool(row.offer) == bool(row.offered or row.word in about_something), row.word
        assert set(row.offered) <= set(RUN_STATES), row.word


def test_the_loop_guard_holds_what_begins_again_and_again() -> None:
    fails = {str(FIRST): Fault(Outcome.FAILED, {})}
    story = hanoi(host={"faults": fails}, attended=False, visits=2)
    for _ in range(40):
        if story.words[-2:] == ["operation_risky", "relocalised"]:
            story.dispatcher.restore(FIRST)
        story.tick()
    assert story.started == [str(FIRST)] * 2
    assert story.end.reason == "held"
    assert story.end.sentence == (
        f"{FIRST} was begun 2 times from SB1/State_aaa without getting further."
    )
