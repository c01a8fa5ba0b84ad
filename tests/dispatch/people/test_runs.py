"""Levels in a run: what people do, confirm, answer, supervise and accept."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.agents import RiskLimit
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.people.tasks import Attended
from tests.dispatch.runs import blueprint, branch

GO = "SB/State0/go"


def line(**notes: Any) -> Blueprint:
    """0 > 1 > 2 on one fact; ``notes`` are of operations and ``_facts``."""
    facts = notes.pop("facts", {})
    edges = {"0": "go>1", "1": "on>2, back>0", "2": "back>1"}
    return blueprint({"SB": branch(edges, operations=notes, facts=facts)})


# operations ------------------------------------------------------------------------------------


def test_a_human_operation_is_done_by_a_person_and_checked_like_any_other() -> None:
    story = Attended(line(go={"actor": "human", "title": "Fix the clamp"})).run()
    assert (story.phase, story.asked) == ("waiting", [("operation", GO)])
    assert story.dispatcher.status.sentence.startswith("Waiting for an answer: Fix the clamp")
    assert story.of("operation_started")[0].function == "", "no library function runs"
    assert story.configuration == {"SB": "State0"}
    story.say("done")
    assert story.end.reason == "goal_reached"
    assert story.started == [GO, "SB/State1/on"]
    assert story.of("operation_ended")[0].message == "done by Ann"


def test_a_person_who_could_not_makes_it_risky_like_a_function_that_fails() -> None:
    story = Attended(line(go={"actor": "human"})).run().say("could_not")
    (risky,) = story.of("operation_risky")
    assert risky.address == GO
    assert 'Ann answered "Could not do it"' in risky.reason
    assert story.phase == "fault_hold", "no other way leads on"
    assert story.configuration == {"SB": "State0"}


def test_what_was_done_is_written_down_within_a_limit() -> None:
    """On the table that is the function's place, and a fault may befall it."""
    story = Attended(line(go={"actor": "human", "timeout": 3.0})).run()
    story.dispatcher.inject("hang")
    story.say("done").wait(5.0)
    (ended,) = story.of("operation_ended")
    assert (ended.outcome, ended.message) == ("timed_out", f"{GO} took longer than its 3 s")
    assert story.phase == "fault_hold"


def test_the_word_of_a_person_is_no_evidence() -> None:
    """In a world where nothing has moved, the state check says so."""
    made = line(go={"actor": "human"})
    host = FakeHost(made)
    story = Attended(made, host).run().say("done")
    assert "begin" not in host.calls
    assert not [call for call in host.calls if call == GO]
    (ended,) = story.of("operation_ended")
    assert (ended.outcome, ended.message) == ("returned", "done by Ann")
    assert "reads 0, not 1" in story.of("operation_risky")[0].reason
    assert story.configuration == {"SB": "State0"}


def test_what_a_person_really_did_counts() -> None:
    made = line(go={"actor": "human"})
    host = FakeHost(made)
    story = Attended(made, host).run()
    host.facts["SB", 0] = "1"
    story.say("done")
    assert story.end.reason == "goal_reached"


def test_a_human_operation_needs_no_library_function() -> None:
    made = line(go={"actor": "human"})
    story = Attended(made, FakeHost(made, unbound=[GO])).run()
    assert story.asked == [("operation", GO)]


def test_nobody_answers_so_the_run_holds_and_a_late_answer_is_refused() -> None:
    story = Attended(line(go={"actor": "human", "answer_within": 10, "escalates_to": "head"}))
    story.run().wait(4.9)
    assert not story.of("task_escalated")
    story.wait(0.2)
    assert [event.role for event in story.of("task_escalated")] == ["head"]
    story.wait(6)
    assert story.phase == "fault_hold"
    assert story.outcomes == [("timed_out", "")]
    assert "nobody answered" in story.dispatcher.status.sentence
    assert "within 10 s" in story.dispatcher.status.sentence
    assert not story.of("operation_risky"), "the operation is not to blame"
    story.say("done", task="task-1")
    assert story.refused[-1] == "it is too late, the time ran out"
    assert story.configuration == {"SB": "State0"}
    story.dispatcher.resume()
    story.run()
    assert [task.name for task in story.tasks] == ["task-2"]


def test_unattended_nobody_is_there_to_answer() -> None:
    story = Attended(line(go={"actor": "human"}), attended=False).run()
    assert story.end.reason == "held"
    assert story.end.sentence == 'nobody is there to answer "go: please carry it out"'
    assert not story.of("task_opened")
    assert story.dispatcher.time < 1


def test_a_shared_operation_begins_when_a_person_agrees() -> None:
    story = Attended(line(go={"actor": "shared"})).run()
    assert (story.asked, story.started) == ([("confirm", GO)], [])
    story.say("confirm")
    assert story.end.reason == "goal_reached"


def test_two_persons_confirm_and_neither_sees_what_the_other_said() -> None:
    made = line(go={"confirm": ["surgeon", "nurse"]})
    story = Attended(made).run().say("confirm", "Ann", "surgeon")
    assert story.phase == "waiting"
    assert [one.by for one in story.tasks[0].answered] == ["Ann"]
    story.say("confirm", "ann ", "nurse")
    assert "has answered already" in story.refused[-1]
    assert story.started == []
    story.say("confirm", "Bo", "nurse")
    assert story.end.reason == "goal_reached"


@pytest.mark.parametrize(
    ("second", "words"),
    [
        ("refuse", "Ann and Bo did not give the same answer"),
        ("confirm", ""),
    ],
)
def test_persons_who_differ_hold_the_run(second: str, words: str) -> None:
    made = line(go={"confirm": ["", ""]})
    story = Attended(made).run().say("confirm").say(second, "Bo")
    if not words:
        assert story.started
        return
    assert story.phase == "fault_hold"
    assert words in story.reasons[-1]
    assert story.started == []


def test_a_declared_confirmation_is_asked_also_at_the_automatic_level() -> None:
    made = line(go={"confirm": ["nurse"]})
    story = Attended(made, levels={GO: "automatic"}).run()
    assert story.asked == [("confirm", GO)]


def test_levels_set_before_the_run_are_obeyed() -> None:
    story = Attended(line(), levels={"SB/on": "human", GO: "shared"}).run()
    story.say("confirm").say("done")
    assert story.asked == [("confirm", GO), ("operation", "SB/State1/on")]
    assert story.end.reason == "goal_reached"
    plain = Attended(line(go={"actor": "human"}), levels={"SB/go": "automatic"}).run()
    assert plain.asked == []


# facts -----------------------------------------------------------------------------------------

HUMAN = {"0": {"aggregation": "human", "name": "Clamp"}}


def test_a_human_fact_is_asked_for_at_the_start_and_again_where_it_changes() -> None:
    story = Attended(line(facts=HUMAN))
    assert (story.phase, story.asked) == ("waiting", [("fact", "SB/0")])
    assert not story.of("run_started")
    story.say("0")
    assert story.of("run_started")
    assert story.phase == "waiting"
    story.say("1").say("2")
    assert story.end.reason == "goal_reached"
    known = [(event.value, event.reason) for event in story.of("fact_changed")]
    assert known == [
        (None, "nobody has answered yet"),
        ("0", ""),
        (None, "nobody has answered yet"),
        ("1", ""),
        (None, "nobody has answered yet"),
        ("2", ""),
    ]


def test_a_person_who_says_otherwise_makes_the_check_false() -> None:
    story = Attended(line(facts=HUMAN)).say("0").say("0")
    assert "Clamp of SB reads 0, not 1" in story.of("operation_risky")[0].reason
    story = Attended(line(facts=HUMAN)).say("1")
    assert story.end.reason == "refused"
    assert "Clamp of SB reads 1, not 0" in story.end.sentence


def test_a_person_who_cannot_say_holds_the_run_and_blames_nobody() -> None:
    story = Attended(line(facts=HUMAN)).say("0").say("cannot say")
    assert story.phase == "fault_hold"
    assert "I cannot say" in story.dispatcher.status.sentence
    assert not story.of("operation_risky")
    story.dispatcher.resume()
    story.run()
    assert [task.address for task in story.tasks] == ["SB/0"], "asked anew where it resumes"


def test_nobody_is_there_for_a_fact_of_the_start() -> None:
    story = Attended(line(facts=HUMAN), attended=False)
    assert story.end.reason == "refused"
    assert story.end.sentence.startswith('nobody is there to answer "What is Clamp of SB?"')


def test_an_answer_that_is_too_old_is_asked_for_again() -> None:
    facts = {"0": {"aggregation": "human", "max_age": 5}}
    story = Attended(line(facts=facts), automatic=False).say("0").wait(6)
    assert story.dispatcher.status.scene.get("SB", 0).value is None  # type: ignore[union-attr]
    possible = {str(one.address): one.permitted for one in story.dispatcher.status.possible}
    assert possible[GO], "a person will be asked first, and that is no reason against it"
    story.ask("go")
    assert story.phase == "waiting"
    story.say("0")
    assert story.started == [GO]


def test_a_level_makes_a_sensed_fact_a_persons_also_on_the_table() -> None:
    story = Attended(line(), levels={"SB/0": "human"})
    assert story.asked == [("fact", "SB/0")]
    story.say("0").say("1").say("2")
    assert story.end.reason == "goal_reached"


def test_a_shared_fact_is_asked_only_where_sensors_leave_it_unknown() -> None:
    made = line()
    host = FakeHost(made)
    story = Attended(made, host, levels={"SB/0": "shared"}, automatic=False).run()
    story.ask("go")
    assert story.asked == []
    host.facts["SB", 0] = None
    story.wait(0.5)
    story.ask("on")
    assert story.asked == [("fact", "SB/0")]
    host.faults.clear()
    story.say("1")
    assert story.started == [GO, "SB/State1/on"]
    assert story.asked == [("fact", "SB/0")], "the sensor knows the target by itself"


def test_required_facts_of_other_branches_are_asked_for() -> None:
    made = blueprint(
        {
            "SB": branch(
                {"0": "go>1", "1": "back>0"}, operations={"go": {"requires": {"R/0": "1"}}}
            ),
            "R": branch({"0": "up>1", "1": "down>0"}, initial="1", facts={"0": {"max_age": 3}}),
        }
    )
    story = Attended(made, levels={"R/0": "human"}, start={"R": "State1"}, goals=["SB/State1"]).say(
        "1"
    )
    assert story.end.reason == "goal_reached"
    assert story.asked == [("fact", "R/0")], "said at the start, it holds"


# supervision and inspection --------------------------------------------------------------------


def test_a_person_lets_every_operation_begin() -> None:
    story = Attended(line(), levels={"supervision": "human"}).run()
    assert story.asked == [("supervise", GO)]
    story.say("go_on")
    assert story.asked[1:] == [("supervise", "SB/State1/on")]
    story.say("go_on")
    assert story.end.reason == "goal_reached"


def ways() -> Blueprint:
    edges = {"0": "go>2, aside>1", "1": "on>2", "2": "back>0"}
    return blueprint({"SB": branch(edges)})


@pytest.mark.parametrize(("option", "event"), [("veto", ""), ("prune", "operation_pruned")])
def test_a_supervisor_skips_or_prunes_and_another_way_is_found(option: str, event: str) -> None:
    story = Attended(ways(), levels={"supervision": "human"}).run().say(option)
    assert [(one.command, one.by) for one in story.of("commanded")][-1] == (option, "Ann")
    assert bool(story.of("operation_pruned")) is bool(event)
    assert story.asked[-1] == ("supervise", "SB/State0/aside")
    story.say("go_on").say("go_on")
    assert story.end.reason == "goal_reached"
    assert story.started == ["SB/State0/aside", "SB/State1/on"]


def test_a_supervisor_pauses() -> None:
    story = Attended(ways(), levels={"supervision": "human"}).run().say("pause")
    assert story.phase == "paused"
    story.dispatcher.resume()
    story.run()
    assert story.asked == [("supervise", GO)] * 2


def test_a_supervisor_who_says_nothing_lets_nothing_begin() -> None:
    story = Attended(ways(), levels={"supervision": "human"}).run().wait(121)
    assert story.phase == "fault_hold"
    assert story.started == []


def test_who_asks_for_an_operation_has_supervised_it() -> None:
    story = Attended(ways(), levels={"supervision": "human"}, automatic=False).run().ask("aside")
    assert (story.asked, story.started) == ([], ["SB/State0/aside"])


def test_the_agent_refuses_above_its_limit_and_asks_where_no_risk_is_declared() -> None:
    edges = {"0": "go>2, aside>1", "1": "on>2", "2": "back>0"}
    risks = {"go": {"risk": "high"}, "aside": {"risk": "low"}}
    made = blueprint({"SB": branch(edges, operations=risks)})
    story = Attended(made, supervisor=RiskLimit(), levels={"supervision": "automatic"}).run()
    assert "above the limit of medium" in story.reasons[0]
    assert story.asked == [("supervise", "SB/State1/on")]
    assert "risk limit medium asks" in story.tasks[0].detail
    story.say("go_on")
    assert story.started == ["SB/State0/aside", "SB/State1/on"]
    alone = Attended(made, supervisor=RiskLimit(), attended=False).run()
    assert alone.end.reason == "held"


def test_findings_are_accepted_before_anything_moves() -> None:
    story = Attended(line(), findings="2 errors, 1 warning.").run()
    assert story.of("run_started")
    assert (story.asked, story.tasks[0].detail) == ([("start", "")], "2 errors, 1 warning.")
    story.say("start")
    assert story.end.reason == "goal_reached"
    refused = Attended(line(), findings="2 errors.").run().say("refuse")
    assert refused.end.reason == "refused"
    assert refused.started == []
    late = Attended(line(), findings="2 errors.").run().wait(121)
    assert late.phase == "fault_hold"
    late.dispatcher.resume()
    late.run()
    assert late.asked == [("start", "")] * 2
    alone = Attended(line(), findings="2 errors.", attended=False).run()
    assert alone.end.reason == "held"
    assert alone.started == []


# commands while people are asked ---------------------------------------------------------------


def test_stop_and_take_over_withdraw_what_is_asked() -> None:
    for command in ("stop", "take_over"):
        story = Attended(line(go={"actor": "human"})).run()
        getattr(story.dispatcher, command)()
        story.tick()
        assert story.outcomes == [("withdrawn", "")], command
        assert story.tasks == ()
        assert story.phase in ("stopped", "taken_over")
        story.say("done", task="task-1")
        assert story.refused[-1] == "it was withdrawn, the run has moved on"


def test_who_gives_back_is_asked_what_only_people_know() -> None:
    story = Attended(line(facts=HUMAN)).say("0")
    story.dispatcher.take_over(by="Ann")
    story.tick()
    reading = story.dispatcher.status.scene.get("SB", 0)
    assert reading is not None
    assert reading.value is None, "what was said before is no evidence after it"
    story.dispatcher.give_back(by="Ann")
    story.tick()
    assert (story.phase, story.asked[-1]) == ("taken_over", ("fact", "SB/0"))
    story.say("1")
    assert story.dispatcher.status.candidates == ({"SB": "State1"},)
    story.dispatcher.accept(by="Ann")
    story.tick()
    assert (story.phase, story.configuration) == ("paused", {"SB": "State1"})


def test_a_pause_stops_the_time_of_a_task_and_its_answers_wait_for_resume() -> None:
    story = Attended(line(go={"actor": "human", "answer_within": 10})).run().wait(1)
    story.dispatcher.pause()
    story.tick(1000)
    assert story.phase == "paused"
    assert story.outcomes == []
    story.dispatcher.answer("", "done", by="Ann")
    story.tick(5)
    assert (story.phase, story.outcomes) == ("paused", [("answered", "done")])
    assert story.configuration == {"SB": "State0"}
    story.dispatcher.resume()
    story.run()
    assert story.end.reason == "goal_reached"


def test_a_veto_or_a_prune_of_what_waits_for_consent_asks_about_another_way() -> None:
    for act in ("veto", "prune"):
        edges = {"0": "go>2, aside>1", "1": "on>2", "2": "back>0"}
        made = blueprint({"SB": branch(edges, operations={"go": {"confirm": ["nurse"]}})})
        story = Attended(made).run()
        if act == "veto":
            story.dispatcher.veto()
        else:
            story.dispatcher.prune(Address("SB", "State0", "go"), "bent")
        story.run()
        assert story.outcomes == [("withdrawn", "")]
        assert story.started == ["SB/State0/aside", "SB/State1/on"]


def test_a_prune_of_what_a_person_is_doing_ends_it() -> None:
    story = Attended(line(go={"actor": "human"})).run()
    story.dispatcher.prune(Address("SB", "State0", "go"), "bent")
    story.run()
    assert story.outcomes == [("withdrawn", "")]
    assert [event.outcome for event in story.of("operation_ended")] == ["cancelled"]
    assert story.phase in ("no_route", "fault_hold")


def test_what_failed_is_to_blame_before_the_question_about_it_is_answered() -> None:
    story = Attended(line(go={"actor": "human"}, facts=HUMAN)).say("0").say("could_not")
    assert story.asked[-1] == ("fact", "SB/0"), "what did it leave behind?"
    assert [event.address for event in story.of("operation_risky")] == [GO]
    story.dispatcher.prune(Address("SB", "State1", "on"), "bent")
    story.run()
    assert story.phase == "waiting", "a prune changes nothing about where it stands"
    story.say("0")
    assert story.started == [GO]
    assert story.phase in ("no_route", "fault_hold")


def test_an_operation_that_was_asked_for_waits_for_its_confirmation() -> None:
    made = line(go={"confirm": ["nurse"]})
    story = Attended(made, automatic=False).run().ask("go")
    assert (story.phase, story.started) == ("waiting", [])
    story.say("confirm", role="nurse")
    assert (story.phase, story.started) == ("ready", [GO])
    story = Attended(made, automatic=False).run().ask("go").say("refuse", role="nurse")
    assert (story.phase, story.started) == ("ready", []), "by hand nothing is held by a no"
    assert "Do not begin" in story.reasons[-1]


def test_what_people_say_is_never_in_an_event_before_all_have_said_it() -> None:
    made = line(go={"confirm": ["", "", ""]})
    story = Attended(made).run().say("confirm").say("refuse", "Bo")
    said = [repr(e) for e in story.events if e.event in ("commanded", "task_answered")]
    assert not any("refuse'" in words or "'confirm'" in words for words in said)


def test_what_is_asked_about_is_the_first_of_the_route_while_it_is_asked() -> None:
    story = Attended(ways(), levels={"supervision": "human"}).run()
    status = story.dispatcher.status
    assert [str(one) for one in status.route[:1]] == [story.asked[-1][1]]
    assert status.detour is not None
    assert status.route[0] not in status.detour
