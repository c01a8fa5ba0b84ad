"""``check`` answers hazards and properties: findings, JSON, the limit, the exit status."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.cli.shell import Shell, sample

HEADER = {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2}
BRANCH = {
    "HEADER": HEADER,
    "State_00": {"on": "State_10", "skip": "State_01"},
    "State_10": {"end": "State_11"},
    "State_01": {"end": "State_11"},
    "State_11": {"again": "State_00"},
}
HAZARD = {"name": "Blind cut", "facts": {"SB/0": "0", "SB/1": "1"}}


def put(folder: Path, **fields: Any) -> str:
    file = folder / "asked.json"
    file.write_text(json.dumps({**fields, "SB": BRANCH}, indent=1))
    return str(file)


def report(shell: Shell, file: str, *options: str) -> tuple[int, Any]:
    answer = shell("check", file, "--format", "json", *options)
    (found,) = answer.json["files"]
    return answer.status, found


def test_a_hazard_that_can_be_reached_is_an_error_with_its_run(
    shell: Shell, tmp_path: Path
) -> None:
    file = put(tmp_path, _hazards=[HAZARD])
    status, found = report(shell, file)
    assert status == 1
    assert found["properties"] == [
        {
            "name": "Blind cut",
            "kind": "hazard",
            "verdict": "fails",
            "configurations": 4,
            "engine": "explicit",
            "bound": None,
        }
    ]
    (finding,) = [one for one in found["findings"] if one["rule"] == "R19"]
    assert (finding["severity"], finding["address"]) == ("E", "_hazards/Blind cut")
    assert finding["counterexample"] == {
        "start": {"SB": "State_00"},
        "path": ["SB/State_00/skip"],
        "end": {"SB": "State_01"},
    }
    words = shell("check", file).out
    assert (
        "E R19 _hazards/Blind cut: the facts of the hazard Blind cut hold together after" in words
    )


@pytest.mark.parametrize(
    ("one", "rule"),
    [
        ({"never": "SB in State_01"}, "R19"),
        ({"way_back": {"from": "SB/1 = 1", "to": "SB/0 = 1 and SB/1 = 0", "within": 1}}, "R20"),
        ({"before": ["SB in State_10", "SB in State_11"]}, "R30"),
        ({"cost": {"goal": "State_11", "limit": 1}}, "R30"),
    ],
)
@pytest.mark.parametrize(("severity", "status"), [("E", 1), ("W", 0)])
def test_a_property_that_fails_has_its_rule_and_severity(
    one: dict[str, Any], rule: str, severity: str, status: int, shell: Shell, tmp_path: Path
) -> None:
    file = put(tmp_path, _properties=[{"name": "p", "severity": severity, **one}])
    found = report(shell, file)
    assert found[0] == status
    told = [(f["rule"], f["severity"], f["address"]) for f in found[1]["findings"]]
    assert (rule, severity, "_properties/p") in told
    assert [one["verdict"] for one in found[1]["properties"]] == ["fails"]
    # One rule may be asked for alone, and without it nothing is shown.
    assert [f["rule"] for f in report(shell, file, "--rule", rule)[1]["findings"]] == [rule]
    assert report(shell, file, "--rule", "R15")[1] == {**found[1], "findings": [], "properties": []}


@pytest.mark.parametrize(
    ("field", "entry", "watches"),
    [
        ("_hazards", {"name": "Odd", "facts": {"SB/0": "1", "SB/1": "0", "OTHER/0": "1"}}, True),
        ("_properties", {"name": "Odd", "never": "SB/0 = 1 and (SB/1 = 0 and OTHER = 1)"}, False),
    ],
)
def test_what_contradicts_itself_holds_with_a_note(
    shell: Shell, tmp_path: Path, field: str, entry: dict[str, Any], watches: bool
) -> None:
    branch = {"HEADER": HEADER, "State_00": {"on": "State_11"}, "State_11": {"off": "State_00"}}
    other = {"State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}}
    file = tmp_path / "odd.json"
    file.write_text(json.dumps({field: [entry], "SB": branch, "OTHER": other}, indent=1))
    status, found = report(shell, str(file), "--rule", "R19")
    assert (status, found["properties"][0]["verdict"]) == (0, "holds")
    (note,) = found["findings"]
    assert (note["severity"], note["address"]) == ("I", f"{field}/Odd")
    assert note["message"] == "Odd can never be met: no state of SB fits all that it names"
    assert note["advice"].startswith("compare what it names with the states")
    assert ("sensors" in note["advice"]) is watches
    assert "counterexample" not in note


def test_the_limit_gives_an_unknown_verdict_which_is_no_good_answer(
    shell: Shell, tmp_path: Path
) -> None:
    file = put(tmp_path, _properties=[{"name": "p", "reachable": "SB in State_11"}])
    assert report(shell, file)[0] == 0
    status, found = report(shell, file, "--limit", "2")
    assert status == 1
    (verdict,) = found["properties"]
    assert (verdict["verdict"], verdict["bound"]) == ("unknown", "2 configurations")
    (finding,) = [one for one in found["findings"] if one["rule"] == "R30"]
    assert "2 configurations" in finding["message"]
    assert "counterexample" not in finding
    assert shell("check", file, "--limit", "0").status == 2


def test_what_holds_is_no_finding(shell: Shell, tmp_path: Path) -> None:
    file = put(
        tmp_path, _properties=[{"name": "p", "before": ["SB/0 = 1 or SB/1 = 1", "SB in State_11"]}]
    )
    status, found = report(shell, file)
    assert status == 0
    assert [one["verdict"] for one in found["properties"]] == ["holds"]
    assert report(shell, sample("hfsm"))[1]["properties"] == []


def test_with_failures_begins_also_where_one_sb_has_failed(shell: Shell, tmp_path: Path) -> None:
    branch = {
        "HEADER": {"NUM_FACTS": 2, "INITIAL": "State_00", "ACTIVATING": "State_10"},
        "_facts": {"1": {"name": "grip", "values": ["0", "x"], "failure": ["x"]}},
        "State_00": {"go": "State_10"},
        "State_10": {"back": "State_00"},
        "State_1x": {"mend": "State_10"},
        "State_0x": {"go": "State_1x"},
    }
    properties = [
        {"name": "whole", "never": "SB/1 = x"},
        {"name": "mended", "way_back": {"from": "SB/1 = x", "to": "SB/1 = 0", "within": 1}},
    ]
    file = tmp_path / "failing.json"
    file.write_text(json.dumps({"_properties": properties, "SB": branch}))
    _, calm = report(shell, str(file))
    assert [one["verdict"] for one in calm["properties"]] == ["holds", "holds"]
    status, found = report(shell, str(file), "--with-failures")
    assert status == 1
    assert [one["verdict"] for one in found["properties"]] == ["fails", "fails"]
    failed = [one for one in found["findings"] if "counterexample" in one]
    runs = {one["address"]: one["counterexample"] for one in failed}
    assert runs["_properties/mended"] == {
        "start": {"SB": "State_0x"}, "path": [], "end": {"SB": "State_0x"},
    }  # fmt: skip
    assert runs["_properties/whole"]["path"] == []


def test_recoverability_names_the_way_out_of_each_failure_state(
    shell: Shell, tmp_path: Path
) -> None:
    branch: dict[str, Any] = {
        "HEADER": {"NUM_FACTS": 1},
        "_facts": {"0": {"failure": ["x", "y"]}},
        "State_0": {"go": "State_1"},
        "State_x": {"mend": "State_0"},
        "State_y": {"fall": "State_x"},
        "State_1": {},
    }
    file = tmp_path / "failing.json"
    file.write_text(json.dumps({"SB": branch}))
    status, found = report(shell, str(file), "--recoverability", "--rule", "R15")
    assert (status, found["recoverability"]) == (
        0,
        [
            {"state": "SB/State_x", "failure_free": 1, "goal": 2.0, "path": ["SB/State_x/mend"]},
            {
                "state": "SB/State_y",
                "failure_free": 2,
                "goal": 3.0,
                "path": ["SB/State_y/fall", "SB/State_x/mend"],
            },
        ],
    )
    words = shell("check", str(file), "--recoverability", "--rule", "R15").out
    said = "SB/State_x: without failure in SB/State_0 after 1 operation by SB/State_x/mend"
    assert f"{said}; who decides: robot; the goal costs 2" in words
    branch["State_y"] = {}
    file.write_text(json.dumps({"SB": branch}))
    status, found = report(shell, str(file), "--recoverability", "--rule", "R15")
    assert status == 1
    lost: dict[str, Any] = {"state": "SB/State_y", "failure_free": None, "goal": None, "path": []}
    assert found["recoverability"][1] == lost
    _, found = report(shell, str(file))
    assert "recoverability" not in found


@pytest.mark.parametrize(
    "entry",
    [
        {"at_most": {"operation": "nothing", "times": 3}},
        {"at_most": {"operation": "SB/nothing", "times": 3}},
        {"cost": {"goal": "SB", "limit": 3}},
        {"cost": {"goal": "SB/State_77", "limit": 3}},
        {"never": "Other = 1"},
        {"at_most": {"operation": "end", "times": 10**400}},
        {"way_back": {"from": "SB/0 = 1", "to": "SB/0 = 0", "within": 10**400}},
    ],
)
def test_what_names_nothing_is_neither_held_nor_failed(
    shell: Shell, tmp_path: Path, entry: dict[str, Any]
) -> None:
    status, found = report(shell, put(tmp_path, _properties=[{"name": "p", **entry}]))
    assert status == 1
    assert [one["verdict"] for one in found["properties"]] == ["unknown"]
    assert [one["rule"] for one in found["findings"] if one["severity"] == "E"] == ["R29"]


def test_a_route_that_is_too_dear_is_told_with_its_limit(shell: Shell, tmp_path: Path) -> None:
    entries = [
        {"name": "dear", "cost": {"goal": "SB/State_10", "limit": 0.5}},
        {"name": "often", "at_most": {"operation": "end", "times": 0}},
    ]
    words = shell("check", put(tmp_path, _properties=entries)).out
    assert "dear fails: the cheapest route has 1 operation and costs more than 0.5" in words
    assert "2 operations and carries out end more than 0 times" in words


def test_many_sbs_fill_no_memory(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("smsl_studio.inspection.proof.exploration.MOST_STEPS", 500)
    one = {"State_0": {"o": "State_1"}, "State_1": {"p": "State_0"}}
    asked = [{"name": "a", "after": ["R0 = 1", "R5 = 1"]}]
    file = tmp_path / "many.json"
    file.write_text(json.dumps({"_properties": asked, **{f"R{n}": one for n in range(12)}}))
    monkeypatch.setattr("smsl_studio.inspection.proof.engines.Engines.engine", lambda *_: None)
    _, found = report(shell, str(file))
    (verdict,) = found["properties"]
    assert verdict["verdict"] == "unknown"
    assert "with 500 steps, which would fill the memory" in verdict["bound"]


def test_a_run_that_is_met_at_the_limit_is_shown(shell: Shell, tmp_path: Path) -> None:
    """It was stored, and the limit came before the other operations of its source."""
    asked = [{"name": "p", "never": "SB/0 = 1 and SB/1 = 0"}]
    status, found = report(shell, put(tmp_path, _properties=asked), "--limit", "2")
    assert status == 1
    assert found["properties"][0]["verdict"] == "fails"
    (finding,) = [one for one in found["findings"] if one["rule"] == "R19"]
    assert finding["counterexample"]["path"] == ["SB/State_00/on"]


COUNTERS = {
    "_properties": [{"name": "p", "never": "A in S9"}],
    "A": {f"S{n}": {"on": f"S{(n + 1) % 9}"} for n in range(9)} | {"S9": {}},
}


def test_bounds_of_effort_on_the_command_line(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "counters.json"
    file.write_text(json.dumps(COUNTERS))
    answer = shell("check", str(file), "--memory", "1", "--format", "json")
    assert answer.status == 1
    (found,) = answer.json["files"]
    assert {one["bound"] for one in found["properties"]} == {"1 MB of memory"}
    assert shell("explore", str(file), "--seconds", "0.000001").status == 1
    for wrong in ("0", "-1", "x", "1e3", "nan"):
        assert shell("check", str(file), "--seconds", wrong).status == 2
        assert shell("explore", str(file), "--memory", wrong).status == 2


@pytest.mark.parametrize(
    ("option", "bound"), [(("--memory", "1"), "1 MB of memory"), (("--limit", "1"), "1 config")]
)
def test_recoverability_tells_the_bound_that_it_met(
    option: tuple[str, str], bound: str, shell: Shell, tmp_path: Path
) -> None:
    file = tmp_path / "failing.json"
    states = {"State_0": {"go": "State_1"}, "State_x": {"mend": "State_0"}, "State_1": {}}
    head = {"HEADER": {"NUM_FACTS": 1}, "_facts": {"0": {"failure": ["x"]}}}
    file.write_text(json.dumps({"SB": {**head, **states}}))
    asked = ("check", str(file), "--recoverability", "--rule", "R15", *option)
    text, found = shell(*asked), shell(*asked, "--format", "json")
    assert (text.status, found.status) == (1, 1)
    assert f"SB/State_x: {bound}" in text.out
    assert bound in text.err
    assert bound in found.err
    (one,) = found.json["files"][0]["recoverability"]
    assert (one["failure_free"], one["path"]) == (None, [])


def test_the_text_says_that_a_part_was_enough(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("smsl_studio.inspection.proof.engines.Engines.engine", lambda *_: None)
    ring = {f"S{n}": {"on": f"S{(n + 1) % 60}"} for n in range(60)}
    file = tmp_path / "parts.json"
    asked = [{"name": "p", "reachable": "A in S7"}]
    file.write_text(json.dumps({"_properties": asked, "A": ring, "B": ring}))
    said = shell("check", str(file)).out
    assert "_properties/p: holds; not counted: a part of the SBs is enough\n" in said
