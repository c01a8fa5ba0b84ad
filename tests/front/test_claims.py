"""Rows about hazards and properties, and the run that shows why one fails."""

from __future__ import annotations

import json
from itertools import pairwise
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front import run
from smsl_studio.front.claim_rows import answered
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.views.claim_run import script_of as as_script
from smsl_studio.front.views.claim_run import steps_of
from smsl_studio.runlog.events import OperationRefused, OperationStarted
from smsl_studio.smsl.json_form import parse_json
from tests.dispatch.generated import blueprint_values
from tests.inspection.proof.brute import drawn_condition

BRANCH = {
    "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
    "State_00": {"on": "State_10", "skip": "State_01"},
    "State_10": {"end": "State_11"},
    "State_01": {"end": "State_11"},
    "State_11": {"again": "State_00"},
}


def written(**fields: Any) -> Blueprint:
    return read_blueprint(parse_json(json.dumps({**fields, "SB": BRANCH}), "rows.json"))


def test_what_fails_stands_first() -> None:
    never = {"name": "never both", "never": "0 = 1 and 1 = 1"}
    there = {"name": "goal", "reachable": "SB in State_11", "why": "It is what we want."}
    cheap = {"name": "cheap", "cost": {"goal": "SB/State_11", "limit": 9}}
    odd = {"name": "odd", "never": "0 ="}
    rows = answered(written(_properties=[there, odd, never, cheap]), 1000).rows
    assert [(row.name, row.verdict, row.index) for row in rows] == [
        ("never both", "fails", 2),
        ("odd", "unknown", 1),
        ("goal", "holds", 0),
        ("cheap", "holds", 3),
    ]
    assert [row.looked_at for row in rows] == [
        "4 configurations, all", "it cannot be read", "4 configurations, all", "cheapest route",
    ]  # fmt: skip
    assert rows[1].sentence == "It cannot be read. Its finding R29 says why"
    assert rows[2].why == "It is what we want."


def test_a_bound_is_told() -> None:
    rows = answered(written(_properties=[{"name": "a", "never": "0 = 1 and 0 = 0"}]), 2).rows
    assert (rows[0].verdict, rows[0].looked_at) == ("unknown", "2 configurations, limit")


def test_without_claims_there_is_no_row() -> None:
    assert answered(written(), 10).rows == ()
    assert answered(written(), 10).proof.verdicts == ()


@pytest.mark.parametrize("seed", range(12))
def test_the_steps_lead_to_the_end_of_the_run(seed: int) -> None:
    values, dice = blueprint_values(seed), Random(seed)
    asked = [{"name": f"p{at}", "never": drawn_condition(values, dice)[0]} for at in range(4)]
    text = json.dumps({"_properties": asked, **values})
    blueprint = read_blueprint(parse_json(text, "any.json"))
    for row in answered(blueprint, 2000).rows:
        if row.run is not None:
            steps = steps_of(blueprint, row.run)
            assert tuple(one.operation for one in steps[1:]) == row.run.path
            assert steps[-1].configuration == row.run.end
            assert steps[-1].during == row.run.during
            for before, after in pairwise(steps):
                moved = {n for n, s in after.configuration.items() if before.configuration[n] != s}
                assert after.changed == moved


def committed(blueprint: Blueprint, script: str) -> tuple[list[str], str, list[str]]:
    """The operations that are carried out if a script acts, the end of the run, and what was
    refused."""
    ran = run(blueprint, script=script_of(script.encode(), "s.jsonl", blueprint))
    done = [one.address for one in ran.events if isinstance(one, OperationStarted)]
    refused = [one.hazard for one in ran.events if isinstance(one, OperationRefused)]
    return done, ran.reason, refused


@pytest.mark.parametrize("never", ["SB in State_11", "0 = 1 and 1 = 0", "SB in State_01"])
def test_the_script_of_a_run_carries_it_out(never: str) -> None:
    blueprint = written(_properties=[{"name": "n", "never": never}])
    (row,) = answered(blueprint, 100).rows
    assert row.run is not None
    done, _, refused = committed(blueprint, as_script(blueprint, steps_of(blueprint, row.run)))
    assert done == [str(one) for one in row.run.path]
    assert not refused


def test_a_run_refuses_the_step_into_a_hazard() -> None:
    blueprint = written(_hazards=[{"name": "Both", "facts": {"SB/0": "1", "SB/1": "1"}}])
    (row,) = answered(blueprint, 100).rows
    assert row.run is not None
    assert row.met == {("SB", 0), ("SB", 1)}
    done, _, refused = committed(blueprint, as_script(blueprint, steps_of(blueprint, row.run)))
    assert done == [str(one) for one in row.run.path[:-1]]
    assert refused == ["Both"]


def test_the_script_counts_arrivals_of_a_sub_that_goes_round() -> None:
    base = {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "SUB_SBS": {"SUB": 0}},
        "State_0": {"up": "State_1"},
        "State_1": {"down": "State_0"},
    }
    sub = {"State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}}
    asked = {"name": "n", "never": "LAST in State_1"}
    last = {"State_0": {"end": "State_1"}, "State_1": {"back": "State_0"},
            "_operations": {"end": {"requires": {"BASE/0": "1"}}}}  # fmt: skip
    text = json.dumps({"_properties": [asked], "BASE": base, "SUB": sub, "LAST": last})
    blueprint = read_blueprint(parse_json(text, "sub.json"))
    (row,) = answered(blueprint, 100).rows
    assert row.run is not None
    steps = steps_of(blueprint, row.run)
    done, _, refused = committed(blueprint, as_script(blueprint, steps))
    assert not refused
    assert done == [str(edge) for step in steps for edge in step.edges]


def test_the_script_waits_for_the_right_arrival() -> None:
    """The switch has to be on, off and on again, so its states are reached several times."""
    switch = {"State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}}
    last: dict[str, Any] = {f"State_{at}": {f"go{at}": f"State_{at + 1}"} for at in range(3)}
    last |= {"State_3": {}, "_operations": {
        f"go{at}": {"requires": {"SWITCH/0": value}} for at, value in enumerate("101")
    }}  # fmt: skip
    asked = {"name": "n", "never": "LAST in State_3"}
    text = json.dumps({"_properties": [asked], "SWITCH": switch, "LAST": last})
    blueprint = read_blueprint(parse_json(text, "switch.json"))
    (row,) = answered(blueprint, 100).rows
    assert row.run is not None
    assert len(row.run.path) == 6
    done, _, refused = committed(blueprint, as_script(blueprint, steps_of(blueprint, row.run)))
    assert done == [str(one) for one in row.run.path]
    assert not refused


def test_a_run_may_end_in_the_middle_of_a_step() -> None:
    base = {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "SUB_SBS": {"SUB": 0}},
        "State_00": {"up": "State_11"},
        "State_11": {"down": "State_00"},
    }
    sub = {"State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}}
    asked = {"name": "n", "never": "SUB in State_1 and BASE in State_00"}
    text = json.dumps({"_properties": [asked], "BASE": base, "SUB": sub})
    blueprint = read_blueprint(parse_json(text, "pending.json"))
    (row,) = answered(blueprint, 100).rows
    assert row.run is not None
    assert row.run.during is not None
    *_, end = steps_of(blueprint, row.run)
    assert end.during == row.run.during
    assert end.configuration == {"BASE": "State_00", "SUB": "State_1"}
