"""What a run will lack is told before it begins."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.reading import read_gathered
from smsl_studio.front.views.before_run import RunMeans, lacking
from smsl_studio.smsl.files import parse_bytes

NOTES = {
    "Op_Cut": {"confirm": ["surgeon"]},
    "Op_Place": {"actor": "human", "forecast": "hold"},
    "Op_Move": {"forecast": "ask"},
}


def told(means: RunMeans, notes: Mapping[str, Any] = NOTES, human: bool = False) -> list[str]:
    facts = {"0": {"aggregation": "human"}} if human else {}
    header = {"NUM_FACTS": 1, "INITIAL": "State_0", "ACTIVATING": "State_1"}
    states = {
        "State_0": {"Op_Cut": "State_1", "Op_Place": "State_1"}, "State_1": {"Op_Move": "State_0"},
    }  # fmt: skip
    values = {"SB1": {"HEADER": header, "_operations": notes, "_facts": facts, **states}}
    blueprint = read_gathered([parse_bytes(json.dumps(values).encode(), "x.json")])
    return [*lacking(blueprint, Levels(blueprint), means)]


def test_roles_that_nobody_has_are_named() -> None:
    (people, cut) = told(RunMeans("table", tried=True, roles=("nurse",)))
    assert people.startswith("Op_Place is carried out by people and cannot be forecast")
    assert cut.startswith("Op_Cut asks for surgeon, and nobody with this role is entered")
    assert len(told(RunMeans("table", tried=True, roles=("Surgeon",)))) == 1
    both = {"Op_Cut": {"confirm": ["surgeon", "surgeon"]}}
    assert told(RunMeans("table", True, ("surgeon", "surgeon")), both) == []
    (few,) = told(RunMeans("table", True, ("surgeon",)), both)
    assert few.startswith("Op_Cut asks for more people than")
    helped = {"Op_Cut": {"confirm": ["surgeon"], "escalates_to": "nurse"}}
    assert told(RunMeans("table", True, ()), helped) == []


def test_a_world_that_cannot_be_tried_and_a_run_without_people_say_what_happens_then() -> None:
    asked, people, alone = told(RunMeans("remote", tried=False, roles=None))
    assert asked == (
        "Op_Move asks for a forecast (ask), and the world remote cannot be tried beforehand: "
        "a person decides before each of them."
    )
    assert people.startswith("Op_Place is carried out by people")
    assert alone == "Op_Cut and Op_Place ask for people, and nobody is there: " + (
        "the run holds before each of them."
    )
    assert told(RunMeans("table", tried=True, roles=None), {}) == []
    (fact,) = told(RunMeans("table", tried=True, roles=None), {}, human=True)
    assert fact.startswith("People tell one fact (SB1 Fact 1), and nobody is there")
    (own,) = told(RunMeans("remote", tried=False, forecast="show"), {})
    assert own.startswith("Op_Cut, Op_Place, Op_Move ") is False
    assert own.startswith("Op_Cut, Op_Place and Op_Move ask for a forecast (show)")
