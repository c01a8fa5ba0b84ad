"""The sample about drilling: what a surgeon asks of it, with and without failures, and its run."""

from __future__ import annotations

import json

import smsl_studio as smsl
from smsl_studio.front.proof import prove
from smsl_studio.front.recovery import recoverability
from smsl_studio.front.script.lines import script_of
from smsl_studio.runlog.events import Commanded, Committed
from smsl_studio.shipped import samples_dir

OCCLUDED, MOVED = "Drilling while the tracker sees nothing", "Drilling while the head has moved"
DIGITIZED = "Digitized before registered"


def _sample() -> smsl.Blueprint:
    return smsl.read(samples_dir() / "registration-drilling.json")


def test_its_states_and_operations_are_those_of_the_paper() -> None:
    ours = _sample()["REGISTRATION"]
    paper = smsl.read(samples_dir() / "registration.json")["REGISTRATION"]
    assert (ours.table, ours.initial, ours.activating) == (
        paper.table,
        paper.initial,
        paper.activating,
    )


def test_all_but_one_hold_and_two_more_fail_with_failures() -> None:
    verdicts = prove(_sample()).verdicts
    assert len(verdicts) == 8
    assert {one.name for one in verdicts if one.verdict == "fails"} == {DIGITIZED}
    failed = {one.name: one for one in prove(_sample(), with_failures=True).verdicts}
    assert {name for name, one in failed.items() if one.verdict != "holds"} == {
        DIGITIZED,
        OCCLUDED,
        MOVED,
    }
    run = failed[OCCLUDED].counterexample
    assert run is not None
    assert (run.path, run.start["TRACKER"]) == ((), "State_o")
    assert all(one.is_complete for one in recoverability(_sample()))


def test_a_finding_names_the_failure_state_from_which_its_run_begins() -> None:
    found = {one.address.state: one.message for one in prove(_sample(), 1000, True).findings}
    assert found[OCCLUDED].endswith("hold together as soon as TRACKER/State_o is entered")


def test_its_script_holds_within_one_tick_and_comes_to_the_goal() -> None:
    blueprint = _sample()
    script = smsl.read_script(samples_dir() / "scripts/registration-drilling.jsonl", blueprint)
    done = smsl.run(blueprint, script=script)
    told = [one.as_json() for one in done.events]
    (put,) = (one["t"] for one in told if one["event"] == "fault_injected")
    met = [one for one in told if one["event"] == "hazard_met"]
    assert {one["name"] for one in met} == {OCCLUDED}
    assert met[0]["t"] == round(put + 0.05, 6)
    assert [one["kind"] for one in told if one["event"] == "held"] == ["hazard", "hazard"]
    assert done.reason == "goal_reached"


def test_what_leads_out_of_a_hazard_begins_where_the_run_believes_its_critical_facts() -> None:
    """Before ``adopt`` the run is wrong about the tracker, so it begins nothing; it offers both."""
    blueprint = _sample()
    acts = [
        {"when": "REGISTRATION/State_1111", "do": "by_hand"},
        {"when": "REGISTRATION/State_1111", "after": 0.2, "do": "ask",
         "address": "DRILL/State_00/Op_StartDrill"},
        {"when": "DRILL/State_10", "after": 0.2, "do": "inject", "fault": "set",
         "fact": "TRACKER/0", "value": "o"},
        *({"when": "DRILL/State_10", "after": after, **STOP_DRILL} for after in (0.5, 0.9)),
        {"when": "DRILL/State_10", "after": 0.7, "do": "adopt"},
    ]  # fmt: skip
    lines = "".join(f"{json.dumps(act)}\n" for act in acts)
    done = smsl.run(blueprint, script=script_of(lines.encode(), "script", blueprint))
    first, second = (one for one in done.events if isinstance(one, Commanded)
                     and one.address == STOP_DRILL["address"])  # fmt: skip
    assert first.refused == "Tracker of TRACKER, a critical fact, reads o, not 1"
    assert second.refused == ""
    last = [one for one in done.events if isinstance(one, Committed)][-1]
    assert last.operations == (STOP_DRILL["address"],)


STOP_DRILL = {"do": "ask", "address": "DRILL/State_10/Op_StopDrill"}
