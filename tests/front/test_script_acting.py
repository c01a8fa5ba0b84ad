"""A script supervises a run: at times, at states, in the middle of operations."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import ReadError
from smsl_studio.front.runs import Run
from smsl_studio.front.script.lines import script_of
from smsl_studio.runlog.events import Commanded, Committed, Event, OperationStarted
from smsl_studio.shipped import samples_dir
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

HANOI = smsl.read(samples_dir() / "hanoi-corrected.json")
SCRIPTS = samples_dir() / "scripts"
Line = Mapping[str, Any]
ELSEWHERE = {"do": "inject", "fault": "elsewhere", "state": "SB1/State_baa"}


def _run(*lines: Line, blueprint: Blueprint = HANOI, **asked: Any) -> Run:
    raw = "\n".join(json.dumps(line) for line in lines).encode()
    return smsl.run(blueprint, script=script_of(raw, "script", blueprint), **asked)


def _told(run: Run) -> list[str]:
    """What was commanded, by whom, and what was refused."""
    return [
        f"{event.t:.2f} {event.command} {event.by}{' refused' if event.refused else ''}"
        for event in run.events
        if isinstance(event, Commanded)
    ]


def _way(run: Run) -> list[str]:
    found = (event for event in run.events if isinstance(event, Committed))
    return [text.rpartition("/")[2] for event in found for text in event.operations]


def _words(run: Run) -> list[str]:
    return [event.event for event in run.events]


def test_acts_come_at_their_time_and_carry_who_does_them() -> None:
    run = _run(
        {"at": 0.1, "do": "full_map", "on": True, "by": "Ada"},
        {"at": 0.1, "do": "set_cost", "address": "SB1/State_aaa/Op_1b", "cost": 3},
        {"do": "full_map", "on": False},
    )
    assert _told(run) == ["0.00 full_map script", "0.10 set_cost script", "0.10 full_map Ada"]
    assert (run.reason, run.left) == ("goal_reached", ())


def test_acts_come_when_a_state_becomes_active_for_the_nth_time() -> None:
    way = ("Op_1b", "Op_1a")
    asks = [
        {"when": "State_aaa", "times": n, "do": "ask", "address": f"State_aaa/{way[0]}"}
        for n in (1, 2)
    ]
    backs = [
        {"when": "State_baa", "times": n, "do": "ask", "address": f"State_baa/{way[1]}"}
        for n in (1, 2)
    ]
    never = {"when": "State_aaa", "times": 4, "do": "stop"}
    run = _run(*asks, *backs, never)
    assert _way(run) == [*way, *way, "Op_1c", "Op_2b", "Op_1b", "Op_3c", "Op_1a", "Op_2c", "Op_1c"]
    assert [str(act) for act in run.left] == ["stop"]
    every = {"when": "State_bba", "times": "every", "do": "full_map", "on": True}
    assert _told(_run(every, *asks, *backs)) == [
        *("0.00 pause script", "0.00 ask script", "0.05 ask script", "0.10 ask script"),
        *("0.15 ask script", "0.20 resume script", "0.35 full_map script"),
    ]


def test_an_act_after_a_state_waits_for_its_seconds() -> None:
    run = _run({"when": "State_caa", "after": 0.12, "do": "full_map", "on": True})
    assert _told(run) == ["0.20 full_map script"]


@pytest.fixture
def lamp(tmp_path: Any) -> dict[str, Any]:
    """A world in which operations take their time."""
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    avoid = ("State_0/Op_break", "State_0/Op_spin")
    lamp = blueprint_of(LAMP)
    return {"blueprint": lamp, "world": "lamp", "avoid": avoid, "plugin_paths": [tmp_path]}


def _started(run: Run) -> list[Event]:
    return [event for event in run.events if isinstance(event, OperationStarted)]


def test_an_act_comes_in_the_middle_of_an_operation(lamp: dict[str, Any]) -> None:
    plain = _run(**lamp)
    (began,) = _started(plain)
    edge = began.as_json()["address"]
    ended = next(event.t for event in plain.events if event.event == "operation_ended")
    half = (ended - began.t) / 2
    stopped = _run({"during": edge, "after": half, "do": "stop", "by": "Ada"}, **lamp)
    assert (stopped.reason, stopped.sentence) == ("stopped", "Stopped by Ada.")
    (stop,) = (event for event in stopped.events if isinstance(event, Commanded))
    assert began.t + half <= stop.t < ended
    late = _run({"during": edge, "after": 10 * half, "do": "stop"}, **lamp)
    assert (late.reason, [act.do for act in late.left]) == ("goal_reached", ["stop"])


def test_an_operation_that_has_ended_takes_its_act_along() -> None:
    run = _run({"during": "State_aaa/Op_1c", "after": 0.12, "do": "stop"})
    assert run.events[-1].t > 0.12
    assert (run.reason, [act.do for act in run.left]) == ("goal_reached", ["stop"])


def test_time_stands_still_in_a_pause_so_the_next_act_comes_at_once(lamp: dict[str, Any]) -> None:
    plain = _run(**lamp)
    edge = _started(plain)[0].as_json()["address"]
    run = _run({"during": edge, "do": "pause"}, {"at": 99, "do": "resume"}, **lamp)
    assert run.reason == "goal_reached"
    assert run.events[-1].t == plain.events[-1].t
    assert [word for word in _words(run) if word in ("paused", "resumed")] == ["paused", "resumed"]


@pytest.mark.parametrize(
    ("last", "reason"),
    [
        ({"do": "pause"}, "held"),
        ({"do": "by_hand"}, "held"),
        ({"do": "take_over"}, "held"),
        ({"do": "stop"}, "stopped"),
        (ELSEWHERE, "held"),
    ],
)
def test_a_run_that_waits_for_a_script_with_nothing_more_to_say_is_over(
    last: Line, reason: str
) -> None:
    never = {"when": "SB1/State_bbb", "do": "full_map", "on": True}
    run = _run({"when": "State_caa", **last}, never)
    assert run.reason == reason
    assert [act.do for act in run.left] == ["full_map"]


def test_a_script_attends_a_run_as_long_as_something_can_come() -> None:
    run = _run({"when": "State_caa", **ELSEWHERE}, {"at": 5, "do": "adopt", "by": "Ada"})
    assert run.reason == "goal_reached"
    assert "5.00 adopt Ada" in _told(run)
    assert 5 < run.events[-1].t < 6


def test_a_run_by_hand_goes_where_it_is_asked_to() -> None:
    lines = [{"do": "by_hand"}]
    lines += [
        {"when": f"SB1/{state}", "do": "ask", "address": f"SB1/{state}/{name}"}
        for state, name in (("State_aaa", "Op_1b"), ("State_baa", "Op_2c"))
    ]
    run = _run(*lines)
    assert _way(run) == ["Op_1b", "Op_2c"]
    assert run.reason == "held"
    assert _run(*lines, goal="State_bca").reason == "goal_reached"


def test_what_is_asked_on_the_way_is_carried_out_and_the_run_goes_on_by_itself() -> None:
    run = _run({"when": "State_caa", "do": "ask", "address": "State_caa/Op_1b", "by": "Ada"})
    assert _told(run) == ["0.05 pause Ada", "0.05 ask Ada", "0.10 resume Ada"]
    assert _way(run)[:3] == ["Op_1c", "Op_1b", "Op_1c"]
    assert run.reason == "goal_reached"


def test_what_is_refused_is_told_and_the_run_goes_on() -> None:
    run = _run({"when": "State_caa", "do": "ask", "address": "State_aaa/Op_1b"},
               {"at": 0.05, "do": "inject", "fault": "elsewhere", "state": "X"})  # fmt: skip
    assert [line for line in _told(run) if line.endswith("refused")] == [
        "0.05 inject script refused",
        "0.05 ask script refused",
    ]
    assert run.reason == "goal_reached"


@pytest.mark.parametrize("host", ["local", "process"])
@pytest.mark.parametrize(
    ("fault", "words", "advice"),
    [
        ({"fault": "nothin"}, "the world 'table' has no fault 'nothin'", "nothing"),
        ({"fault": "fail", "disk": 1}, "no parameter 'disk'", "It takes operation."),
        ({"fault": "elsewhere"}, "'state' is missing", "It takes state, operation."),
        ({"fault": "set", "fact": 0, "value": "a"}, "fact is 0, not a text", ""),
    ],
)
def test_a_fault_that_the_world_has_not_is_refused_before_the_run(
    host: str, fault: Line, words: str, advice: str
) -> None:
    with pytest.raises(ReadError) as caught:
        _run({"do": "pause"}, {"at": 9, "do": "inject", **fault}, host=host)
    assert str(caught.value.place) == "script:2:36"
    assert words in caught.value.sentence
    assert advice in caught.value.advice


def test_sensors_are_disturbed_by_script() -> None:
    stuck = {"when": "State_caa", "do": "disturb", "target": "SB1/1", "kind": "stuck"}
    run = _run(stuck)
    assert run.reason == "held"
    assert "disturbed" in _words(run)


def _sample(name: str, **asked: Any) -> Run:
    script = smsl.read_script(SCRIPTS / f"{name}.jsonl", HANOI)
    return smsl.run(HANOI, script=script, **asked)


ON = ("State_aaa/Op_1c",)


def test_with_an_edge_avoided_and_one_pruned_on_the_way_the_next_cheapest_way_is_taken() -> None:
    run = _sample("hanoi-pruned", avoid=ON)
    assert run.reason == "goal_reached"
    assert _way(run) == [
        *("Op_1b", "Op_1c", "Op_2b", "Op_1a", "Op_1b", "Op_3c", "Op_1a", "Op_2c", "Op_1c"),
    ]
    costs = [event.as_json()["cost"] for event in run.events if event.event == "route_planned"]
    assert costs == [8.0, 6.0]


def test_with_everything_cut_there_is_no_route_and_every_edge_says_why() -> None:
    run = _sample("hanoi-cut", avoid=ON)
    assert run.reason == "no_route"
    held = run.events[-2].as_json()
    assert (held["event"], held["kind"]) == ("held", "no_route")
    text = " ".join(held["details"])
    for edge in ("Op_1a", "Op_1c", "Op_2c"):
        assert f"SB1/State_baa/{edge}" in text
    assert "peg c is blocked" in text


def test_the_other_sample_scripts_do_what_they_say() -> None:
    taken = _sample("hanoi-taken-over")
    assert [line.split()[1] for line in _told(taken)] == [
        "take_over", "inject", "give_back", "accept", "resume"]  # fmt: skip
    given = next(event for event in taken.events if event.event == "given_back")
    assert given.as_json()["configuration"] == {"SB1": "State_cba"}
    chosen = _sample("hanoi-chosen")
    assert _way(chosen)[:3] == ["Op_1b", "Op_2c", "Op_1a"]
    faults = _sample("hanoi-faults")
    assert "mismatch" in _words(faults)
    for run in (taken, chosen, faults):
        assert (run.reason, run.left) == ("goal_reached", ())


PEOPLE = (
    {"do": "level", "of": "SB1/Op_1c", "level": "human"},
    {"do": "level", "of": "inspection", "level": "human"},
    {"do": "answer", "kind": "start", "option": "start", "by": "Ada"},
)


def test_a_script_sets_levels_and_answers_what_people_are_asked() -> None:
    done = {"do": "answer", "kind": "operation", "option": "done", "after": 2, "times": "every"}
    run = _run(*PEOPLE, {**done, "by": "Bo"})
    assert run.reason == "goal_reached"
    closed = [event.as_json() for event in run.events if event.event == "task_closed"]
    said = {"Ada": "start"}, {"Bo": "done"}, {"Bo": "done"}
    assert [one["answers"] for one in closed] == list(said)
    assert [round(one["t"], 2) for one in closed] == [0.0, 2.0, 4.3]


def test_who_is_asked_and_not_answered_by_the_script_holds_the_run() -> None:
    run = _run(*PEOPLE)
    assert (run.reason, run.left) == ("held", ())
    wrong = _run(*PEOPLE[:2], {"do": "answer", "kind": "start", "option": "maybe"})
    assert (wrong.reason, _told(wrong)) == ("held", ["0.00 answer script refused"])
    assert _run(*PEOPLE[:2], {"at": 1, "do": "answer", "option": "start"}).left == ()


def test_a_script_is_named_in_the_header_of_the_log(tmp_path: Any) -> None:
    from smsl_studio.runlog.grammar.log_reader import read_log

    _sample("hanoi-chosen", log=tmp_path / "log")
    header = read_log(tmp_path / "log", COMMANDS).header
    raw = (SCRIPTS / "hanoi-chosen.jsonl").read_bytes()
    assert header["script"]["digest"] == script_of(raw, "", HANOI).digest
    assert (header["levels"], header["supervisor"]) == ({}, "")
