"""Faults with one cause are one finding with several places, and a rule lists a limited number."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import LISTED, LISTED_IN_ALL, Finding, Severity
from smsl_studio.inspection.rules.words import NearNames
from smsl_studio.smsl.json_form import parse_json


def of(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "f.json"))


def found(rule: str, values: dict[str, Any]) -> tuple[Finding, ...]:
    return inspect(of(values), [rule])


def places(finding: Finding) -> list[str]:
    return [str(finding.address), *(str(spot.address) for spot in finding.others)]


def test_what_cannot_be_reached_is_one_finding_for_all_that_hang_together() -> None:
    header = {"INITIAL": "State_0", "ACTIVATING": "State_0"}
    chain = {f"State_{n}": {"x": f"State_{n - 1}"} for n in range(2, 5)}
    table = {"State_0": {}, "State_1": {"x": "State_0"}, **chain, "State_8": {"x": "State_0"}}
    blueprint = of({"SB": {"HEADER": header, **table}})
    first, alone = inspect(blueprint, ["R10"])
    assert places(first) == [f"SB/State_{n}" for n in range(1, 5)]
    assert first.also == "also at 11:3, 14:3 and 17:3"
    assert places(alone) == ["SB/State_8"]
    assert alone.also == ""
    assert first.fix is not None
    assert list(first.fix.apply(blueprint)["SB"].table) == ["State_0", "State_8"]


def test_those_that_hold_a_failure_are_told_apart_and_nothing_is_deleted_with_them() -> None:
    values = {
        "_facts": {"0": {"failure": ["x"]}},
        "State_0": {"a": "State_1"},
        "State_1": {"b": "State_0"},
        "State_x": {"c": "State_2"},
        "State_2": {"d": "State_0"},
    }
    findings = found("R10", {"SB": values})
    assert [(one.severity.value, places(one), one.fix) for one in findings] == [
        ("W", ["SB/State_x"], None),
        ("E", ["SB/State_2"], None),
    ]


def test_a_goal_that_nothing_reaches_is_one_finding() -> None:
    ring = {f"State_{n}": {"go": f"State_{(n + 1) % 5}"} for n in range(5)}
    (trap,) = found("R11", {"SB": {**ring, "State_9": {"back": "State_0"}}})
    assert places(trap) == [f"SB/State_{n}" for n in range(5)]


def test_operations_to_one_unknown_state_are_one_finding_and_one_fix_leads_all_elsewhere() -> None:
    table = {f"State_{n}": {"go": "State_A", "back": "State_0"} for n in range(4)}
    blueprint = of({"SB": table})
    (finding,) = inspect(blueprint, ["R02"])
    assert places(finding) == [f"SB/State_{n}/go" for n in range(4)]
    assert finding.fix is not None
    assert finding.fix.words.startswith("Lead all 4 to State_")
    assert inspect(finding.fix.apply(blueprint), ["R02"]) == ()


def test_equal_facts_and_equal_lengths_are_one_finding_each() -> None:
    same: dict[str, Any] = {name: {} for name in ("State_01", "State01", "a_01", "State_10")}
    (equal,) = found("R06", {"SB": {"HEADER": {"NUM_FACTS": 2}, **same}})
    assert places(equal) == ["SB/State01", "SB/a_01"]
    odd: dict[str, Any] = {
        name: {} for name in ("State_00", "State_01", "State_11", "State_000", "State_111")
    }
    (length,) = found("R05", {"SB": {"HEADER": {"NUM_FACTS": 2}, **odd}})
    assert places(length) == ["SB/State_000", "SB/State_111"]


def test_a_key_written_many_times_is_one_finding() -> None:
    text = '{"SB": {"State_0": {"a": "State_0", "a": "State_1", "a": "State_0"}, "State_1": {}}}'
    (doubled,) = inspect(read_blueprint(parse_json(text, "f.json")), ["R01"])
    assert doubled.message == "a is written 3 times, first at line 1, column 21"
    assert (doubled.place.column, doubled.also) == (37, "also at 1:53")


def test_self_loops_and_parallel_operations_have_all_their_places() -> None:
    ring = {
        f"State_{n}": {"stay": f"State_{n}", "a": f"State_{1 - n}", "b": f"State_{1 - n}"}
        for n in range(2)
    }
    (loops,) = found("R17", {"SB": ring})
    (parallel,) = found("R18", {"SB": ring})
    assert places(loops) == ["SB/State_0/stay", "SB/State_1/stay"]
    assert places(parallel) == ["SB/State_0/a", "SB/State_1/a"]
    assert loops.fix is not None
    assert inspect(loops.fix.apply(of({"SB": ring})), ["R17"]) == ()


def test_a_finding_has_its_places_in_json_only_where_it_has_several() -> None:
    one, many = (
        found("R02", {"SB": {f"State_{n}": {"go": "Nowhere"} for n in range(count)}})[0].as_json()
        for count in (1, 2)
    )
    assert "others" not in one
    assert many["others"] == [{"address": "SB/State_1/go", "line": 7, "column": 4}]
    assert many["more"] == 0


def test_places_are_counted_that_are_not_listed() -> None:
    table = {f"State_{n:03}": {"go": "State_X"} for n in range(250)}
    (finding,) = found("R02", {"SB": table})
    assert (1 + len(finding.others), finding.more) == (LISTED, 150)
    assert finding.also.endswith(" and 244 more places")
    assert finding.as_json()["more"] == 150


def test_notes_never_hide_an_error() -> None:
    """A hundred notes about shared sub-SBs, and one SB that does not exist behind them."""
    bases = {
        f"B{n}": {"HEADER": {"SUB_SBS": {"S": 0}}, "State0": {"a": "State1"}, "State1": {}}
        for n in range(LISTED_IN_ALL + 50)
    }
    last = {"HEADER": {"SUB_SBS": {"Gone": 0}}, "State0": {"a": "State1"}, "State1": {}}
    findings = found("R07", {"S": {"State0": {}, "State1": {}}, **bases, "Last": last})
    assert [str(one.address) for one in findings if one.severity is Severity.ERROR] == ["Last"]
    assert len(findings) == LISTED_IN_ALL
    assert sum("in 50 other SBs are not listed" in one.message for one in findings) == 1


def test_remedies_are_sought_for_what_is_listed_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def near(_: NearNames, name: str, without: object) -> str:
        asked.append(name)
        return ""

    monkeypatch.setattr(NearNames, "near", near)
    subs = {f"Gone{n}": n for n in range(300)}
    states: dict[str, Any] = {"State" + "0" * 300: {}, "State" + "1" * 300: {}}
    assert len(found("R07", {"SB": {"HEADER": {"SUB_SBS": subs}, **states}})) == LISTED
    assert len(asked) == LISTED
