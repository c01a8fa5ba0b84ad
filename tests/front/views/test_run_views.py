"""The story of a run, its lanes, rows and marks."""

from __future__ import annotations

from pathlib import Path

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.views.fact_rows import fact_rows, last_check
from smsl_studio.front.views.possible_rows import possible_rows
from smsl_studio.front.views.run_marks import run_marks
from smsl_studio.front.views.states import choices
from smsl_studio.front.views.timeline_lanes import lanes
from smsl_studio.host.protocol import SensorInfo
from smsl_studio.runlog import events as told
from smsl_studio.runlog.playback import RunObserver

SAMPLES = Path(__file__).parents[3] / "samples"


def _opened(name: str, **choice: object) -> tuple[Blueprint, Dispatcher, RunObserver]:
    """A run in the table world, opened, with its story so far."""
    blueprint = front.read(SAMPLES / name)
    dispatcher = front.open_run(blueprint, host="local", attended=True, **choice)  # type: ignore[arg-type]
    telling = RunObserver()
    telling.tell(dispatcher.open())
    return blueprint, dispatcher, telling


def _until(dispatcher: Dispatcher, telling: RunObserver, operations: int) -> None:
    while dispatcher.status.operations < operations and not dispatcher.finished:
        telling.tell(dispatcher.tick())


def test_the_story_keeps_states_trail_and_the_end() -> None:
    blueprint, dispatcher, telling = _opened("hfsm.json")
    _until(dispatcher, telling, 99)
    assert [span.words for span in telling.story.history.states["SB1"]] == [
        "State000",
        "State100",
        "State111",
    ]
    assert telling.story.visited("SB1") == {"State000", "State100"}
    assert [str(a) for a in telling.story.trail("SB2")] == ["SB2/State0/Operation0"]
    assert telling.story.moment.finished is not None
    assert telling.story.moment.finished.reason == "goal_reached"
    assert all(span.end is not None for span in telling.story.history.operations)
    assert [row.group for row in fact_rows(blueprint, dispatcher.status)][:1] == [True]


def test_a_function_is_expected_to_take_what_it_took() -> None:
    telling = RunObserver()
    for at, end in ((0.0, 3.0), (10.0, 11.0), (20.0, 22.0)):
        op = f"SB1/A/Op_{at:g}"
        telling.tell([told.OperationStarted(t=at, address=op, target="B", function="p.move")])
        telling.tell([told.OperationEnded(t=end - 0.2, address=op, outcome="returned")])
        telling.tell([told.Committed(t=end, operations=(op,), configuration={"SB1": "B"})])
    assert telling.story.expected("SB1/A/Op_0") == 2.0
    assert telling.story.expected("SB1/A/Other") is None
    telling.tell(
        [told.OperationStarted(t=30.0, address="SB1/A/Op_0", target="B", function="p.move")]
    )
    telling.tell([told.OperationEnded(t=31.0, address="SB1/A/Op_0", outcome="failed")])
    assert telling.story.expected("SB1/A/Op_0") == 2.0
    assert not telling.story.history.operations[-1].good


def test_what_is_risky_or_pruned_is_so_until_it_is_restored() -> None:
    telling = RunObserver()
    telling.tell([told.OperationRisky(t=1.0, address="SB1/A/b", reason="slipped")])
    telling.tell([told.OperationPruned(t=1.0, address="SB1/A/c", reason="wet")])
    assert (telling.story.moment.risky, telling.story.moment.pruned) == (
        {"SB1/A/b": "slipped"},
        {"SB1/A/c": "wet"},
    )
    for name in "bc":
        telling.tell([told.OperationRestored(t=2.0, address=f"SB1/A/{name}")])
    assert not telling.story.moment.risky
    assert not telling.story.moment.pruned


def test_lanes_say_held_for_a_value_no_state_has_and_mark_the_present() -> None:
    blueprint, dispatcher, telling = _opened("hanoi-2.json")
    telling.tell([told.FactChanged(t=1.0, branch="SB1", digit=0, value="h")])
    telling.tell([told.FactChanged(t=2.0, branch="SB1", digit=1, value=None, reason="stale")])
    sensors = [SensorInfo("peg_1", "SB1", 0, 0.02, 0.3, words={"h": "held"})]
    found = lanes(blueprint, dispatcher.status, telling.story, sensors)
    assert [lane.label for lane in found] == ["State", "Operation", "Fact 1", "Fact 2"]
    assert [(b.words, b.look) for b in found[2].blocks] == [("a", "past"), ("held", "beyond")]
    assert [(b.words, b.look) for b in found[3].blocks] == [("a", "past"), ("?", "unknown")]
    assert found[0].blocks[-1].look == "now"


def test_rows_of_a_dead_world_know_nothing() -> None:
    blueprint, dispatcher, _ = _opened("hanoi-2.json")
    rows = fact_rows(blueprint, dispatcher.status, lost=True)
    assert {(row.sensed, row.quality) for row in rows} == {(None, "unknown")}
    assert last_check(blueprint, dispatcher.status, lost=True) is None
    alive = last_check(blueprint, dispatcher.status, lost=False)
    assert alive is not None
    assert alive.truth is True


def test_possible_rows_put_what_may_be_done_first() -> None:
    blueprint, dispatcher, telling = _opened("registration.json", automatic=False)
    rows = possible_rows(blueprint, dispatcher.status)
    assert {row.kind for row in rows} == {"possible"}
    assert rows[0].group == "From State_0000"
    shut = Address("REGISTRATION", "State_0000", rows[0].name)
    dispatcher.prune(shut, "grip slipped")
    telling.tell(dispatcher.tick())
    rows = possible_rows(blueprint, dispatcher.status)
    assert rows[-1].kind == "pruned"
    assert "grip slipped" in rows[-1].words
    marks = run_marks(blueprint, "REGISTRATION", dispatcher.status, telling.story)
    assert marks.pruned == {shut}
    assert shut in marks.possible


def test_marks_show_where_the_run_is_and_what_comes() -> None:
    blueprint, dispatcher, telling = _opened("hanoi-corrected.json")
    _until(dispatcher, telling, 3)
    marks = run_marks(blueprint, "SB1", dispatcher.status, telling.story)
    assert marks.active == "State_bba"
    assert len(marks.trail) == 3
    assert marks.goals == {"State_ccc"}
    assert marks.dimmed
    _until(dispatcher, telling, 99)
    assert not run_marks(blueprint, "SB1", dispatcher.status, telling.story).planned


def test_choices_begin_with_what_the_blueprint_says() -> None:
    starts, goals = choices(front.read(SAMPLES / "hfsm.json"))
    assert starts[0] == ("SB1/000", "SB1/State000")
    assert goals[0] == ("SB1/111", "SB1/State111")
    assert ("SB2/1", "SB2/State1") in goals
    assert ("SB2/1", "SB2/State1") not in starts
    starts, goals = choices(front.read(SAMPLES / "hanoi-2.json"))
    assert (starts[0], goals[0]) == (("aa", "SB1/State_aa"), ("cc", "SB1/State_cc"))


def test_worlds_that_suit_stand_before_the_table() -> None:
    hanoi = front.read(SAMPLES / "hanoi-corrected.json")
    assert front.worlds_for(hanoi) == ("hanoi", "hanoi-mujoco", "table")
    assert front.worlds_for(front.read(SAMPLES / "registration.json")) == ("registration", "table")


def test_operations_of_a_base_and_its_sub_are_under_way_together() -> None:
    blueprint, dispatcher, telling = _opened("hfsm.json")
    _until(dispatcher, telling, 99)
    spans = [
        (span.words.rpartition("/")[2], span.start, span.end)
        for span in telling.story.history.operations
    ]
    assert [(name, round(a, 2), round(b or 0, 2)) for name, a, b in spans] == [
        ("Operation000", 0.0, 0.05),
        ("Operation100B", 0.05, 0.15),
        ("Operation0", 0.05, 0.15),
    ]
    rows = [
        lane
        for lane in lanes(blueprint, dispatcher.status, telling.story)
        if lane.kind == "operation"
    ]
    assert [lane.label for lane in rows] == ["Operation", "Operation 2"]
    assert [[block.words for block in lane.blocks] for lane in rows] == [
        ["Operation000", "Operation100B"],
        ["Operation0"],
    ]


def test_a_base_goes_on_while_its_sub_commits_and_a_mismatch_ends_both() -> None:
    base, sub = "A/a0/go", "B/b0/step"
    telling = RunObserver()
    telling.tell([told.OperationStarted(t=0.0, address=base, target="a1")])
    telling.tell([told.OperationStarted(t=0.0, address=sub, target="b1")])
    telling.tell([told.Committed(t=1.0, operations=(sub,), configuration={"B": "b1"})])
    assert [span.end for span in telling.story.history.operations] == [None, 1.0]
    telling.tell([told.OperationStarted(t=1.0, address="B/b1/on", target="b2")])
    telling.tell([told.Mismatch(t=2.0, facts=())])
    assert [(span.end, span.good) for span in telling.story.history.operations] == [
        (2.0, False), (1.0, True), (2.0, False),
    ]  # fmt: skip


def test_the_states_are_shown_while_people_are_asked_before_the_start() -> None:
    blueprint, dispatcher, telling = _opened("registration-people.json")
    found = lanes(blueprint, dispatcher.status, telling.story)
    assert [(lane.label, lane.kind) for lane in found[:3]] == [
        ("HEAD", "state"), ("REGISTRATION", "state"), ("Operation", "operation"),
    ]  # fmt: skip
    assert [(b.words, b.look) for b in found[0].blocks] == [("0", "unknown")]
