"""Many unreachable states: what goes along with each is worked out for those that are listed."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.finding import LISTED
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules import reach
from smsl_studio.smsl.json_form import parse_json, write_json


def of(table: dict[str, dict[str, str]]) -> Blueprint:
    header = {"INITIAL": "State_0", "ACTIVATING": "State_0"}
    values = {"SB": {"HEADER": header, "State_0": {}, **table}}
    return read_blueprint(parse_json(write_json(values), "f.json"))


def test_fixes_are_worked_out_for_the_listed_ones_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    monkeypatch.setattr(reach, "_deletion", lambda branch, state, sources: asked.append(state))
    blueprint = of({f"State_{n}": {"x": "State_0"} for n in range(1, 300)})
    assert len(inspect(blueprint, ["R10"])) == len(asked) == LISTED


def test_those_that_only_lead_there_go_along() -> None:
    chain = {f"State_{n}": {"x": f"State_{n - 1}", "y": f"State_{n - 1}"} for n in range(2, 6)}
    blueprint = of(
        {"State_1": {"x": "State_0"}, **chain, "State_6": {"x": "State_5", "y": "State_0"},
         "State_7": {"x": "State_5", "y": "State_7"}, "State_8": {"x": "State_4", "y": "State_5"}}
    )  # fmt: skip
    words = {f.address.state: f.fix.words for f in inspect(blueprint, ["R10"]) if f.fix}
    assert words["State_1"] == "Delete 6 states"
    assert words["State_4"] == "Delete 3 states"
    first = next(f.fix for f in inspect(blueprint, ["R10"]) if f.address.state == "State_1")
    assert first is not None
    assert list(first.apply(blueprint)["SB"].table) == ["State_0", "State_6", "State_7"]
