"""The sample with a hazard: the other way, a refusal by hand, a hold, a take-over."""

from __future__ import annotations

import io
from pathlib import Path

import smsl_studio as smsl
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.grammar.log_reader import verify
from smsl_studio.shipped import samples_dir

NAME = "Two disks on peg b"


def test_the_run_goes_the_other_way() -> None:
    blueprint = smsl.read(samples_dir() / "hanoi-hazard.json")
    done = smsl.run(blueprint)
    assert (done.reason, done.events[-1].operations) == ("goal_reached", 11)  # type: ignore[attr-defined]
    plain = smsl.run(smsl.read(samples_dir() / "hanoi-corrected.json"))
    assert plain.events[-1].operations == 7  # type: ignore[attr-defined]
    route = smsl.plan_route(blueprint, "State_aaa", "State_ccc")
    assert route is not None
    assert not any(state.startswith("State_bb") for state in route.states)


def test_its_script_is_refused_held_and_given_back(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "hanoi-hazard.json")
    script = smsl.read_script(samples_dir() / "scripts" / "hanoi-hazard.jsonl", blueprint)
    log = tmp_path / "run.jsonl"
    done = smsl.run(blueprint, script=script, log=log)
    told = [one.as_json() for one in done.events]
    (refused,) = (one for one in told if one["event"] == "operation_refused")
    assert (refused["address"], refused["hazard"]) == ("SB1/State_cba/Op_1b", NAME)
    met = [one["t"] for one in told if one["event"] == "hazard_met"]
    held = [(one["t"], one["kind"]) for one in told if one["event"] == "held"]
    (put, *_) = (one["t"] for one in told if one["event"] == "fault_injected")
    assert held == [(t, "hazard") for t in met]
    assert met[0] == round(put + 0.05, 6), "within one tick"
    (taken,) = (one["t"] for one in told if one["event"] == "taken_over")
    assert met[1] == round(taken + 0.05, 6), "while taken over, too"
    assert done.reason == "goal_reached"
    assert verify(io.BytesIO(log.read_bytes()), "log", COMMANDS).doubt is None
