"""``route``: the cheapest way, and states that do not exist."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.shell import Shell, sample

FROM_TO = ("--from", "State_aaa", "--to", "State_ccc")


def test_hanoi_takes_seven_operations(shell: Shell) -> None:
    answer = shell("route", sample("hanoi"), *FROM_TO, "--format", "json")
    assert answer.status == 0
    assert list(answer.json) == ["operations", "states", "cost"]
    assert len(answer.json["operations"]) == answer.json["cost"] == 7
    assert answer.json["operations"][0] == "SB1/State_aaa/Op_1c"
    assert answer.json["states"][::7] == ["State_aaa", "State_ccc"]
    text = shell("route", sample("hanoi"), *FROM_TO)
    assert text.out.splitlines()[-1] == "7 operations, cost 7"


def test_what_is_avoided_is_not_used(shell: Shell) -> None:
    avoid = ("--avoid", "SB1/State_aaa/Op_1c", "--avoid", "State_baa/Op_2c")
    answer = shell("route", sample("hanoi"), *FROM_TO, *avoid, "--format", "json")
    assert answer.status == 0
    assert not {"SB1/State_aaa/Op_1c", "SB1/State_baa/Op_2c"} & set(answer.json["operations"])
    assert answer.json["cost"] > 7


def test_where_no_route_leads_the_answer_is_no(shell: Shell) -> None:
    answer = shell("route", sample("hfsm"), "--from", "State111", "--to", "State000")
    assert (answer.status, answer.out) == (1, "")
    assert "no route leads from State111 to State000" in answer.err


def test_a_route_costs_what_its_sub_routes_cost(shell: Shell) -> None:
    ends = ("--from", "State000", "--to", "SB1/State111", "--format", "json")
    answer = shell("route", sample("hfsm"), *ends)
    assert answer.json == {
        "operations": ["SB1/State000/Operation000", "SB1/State100/Operation100B"],
        "states": ["State000", "State100", "State111"],
        "cost": 3.0,
    }
    around = shell("route", sample("hfsm"), *ends, "--avoid", "SB1/State100/Operation100B")
    assert around.json["states"] == ["State000", "State100", "State110", "State111"]


def test_a_sub_sb_has_routes_of_its_own(shell: Shell) -> None:
    ends = ("--from", "State1", "--to", "State0", "--sb", "SB2", "--format", "json")
    assert shell("route", sample("hfsm"), *ends).json["operations"] == ["SB2/State1/Operation1"]


def test_a_state_that_does_not_exist_has_a_near_name(shell: Shell) -> None:
    answer = shell("route", sample("hanoi"), "--from", "SB1/State_aax", "--to", "State_ccc")
    assert answer.status == 2
    assert "there is no state 'State_aax' in SB1" in answer.err
    assert "Did you mean State_aa" in answer.err
    ends = ("--from", "State_aaa", "--to", "State_ccd", "--sb", "SB1")
    assert "there is no state 'State_ccd' in SB1" in shell("route", sample("hanoi"), *ends).err
    assert shell("route", sample("hanoi"), *FROM_TO, "--sb", "SB9").status == 2
    assert shell("route", sample("hanoi"), "--from", "SB1", "--to", "State_ccc").status == 2


def test_a_slash_in_a_name_may_be_written_as_it_is(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "odd.json"
    table = {"State a/0": {"go / on": "State ~1"}, "State ~1": {}}
    file.write_text(json.dumps({"S/B": {"HEADER": {"NUM_FACTS": 1}, **table}}), "utf-8")
    for state in ("State a/0", "S/B/State a/0", "S~1B/State a~10", "State a~10"):
        answer = shell("route", str(file), "--from", state, "--to", "State ~1", "--format", "json")
        assert answer.status == 0, answer.err
        assert answer.json["operations"] == ["S~1B/State a~10/go ~1 on"]
        assert answer.json["states"] == ["State a/0", "State ~1"]
    ends = ("--from", "State a/0", "--to", "State ~1", "--sb", "S/B")
    assert shell("route", str(file), *ends).status == 0
    for avoid in ("State a/0/go / on", "S/B/State a/0/go / on", "S~1B/State a~10/go ~1 on"):
        assert shell("route", str(file), *ends, "--avoid", avoid).status == 1


def test_a_state_of_another_sb_is_named_with_it(shell: Shell) -> None:
    answer = shell("route", sample("hfsm"), "--from", "State0", "--to", "State1")
    assert (answer.status, answer.out) == (2, "")
    assert answer.err.splitlines()[-1] == "Write SB2/State0."
    answer = shell("run", sample("three-roots"), "--world", "table", "--goal", "State1")
    assert answer.status == 2
    assert answer.err.splitlines()[-1].startswith("Write ")


def test_an_operation_is_avoided_wherever_its_branch_has_it(shell: Shell) -> None:
    ends = ("--from", "SB1/State000", "--to", "SB1/State111", "--format", "json")
    around = shell("route", sample("hfsm"), *ends, "--avoid", "SB1/Operation100B").json
    assert around["states"] == ["State000", "State100", "State110", "State111"]
    wrong = shell("route", sample("hfsm"), *ends, "--avoid", "SB2/Operation100B")
    assert (wrong.status, wrong.out) == (2, "")


def test_a_route_meets_no_hazard_and_names_the_one_in_the_way(shell: Shell, tmp_path: Path) -> None:
    values = json.loads(Path(sample("hfsm")).read_text())
    file = tmp_path / "guarded.json"
    ends = ("--from", "State000", "--to", "SB1/State111", "--format", "json")

    def routed(**facts: str) -> list[str]:
        hazard = {"name": "Both", "facts": {key.replace("_", "/"): v for key, v in facts.items()}}
        file.write_text(json.dumps({"_hazards": [hazard], **values}))
        answer = shell("route", str(file), *ends)
        assert answer.status == (0 if answer.json["cost"] is not None else 1)
        assert ("but through the hazard Both" in answer.err) == bool(answer.status)
        return list(answer.json["states"])

    assert routed(SB1_0="0", SB1_1="1") == ["State000", "State100", "State111"]
    assert routed(SB1_0="1", SB1_1="0") == []
    file.write_text(json.dumps({
        "_hazards": [{"name": "Nowhere", "facts": {"SB/0": "1"}}],
        "SB": {"State0": {"a": "State1", "b": "State2"}, "State1": {"c": "State3"},
               "State2": {"d": "State3"}, "State3": {}},
    }))  # fmt: skip
    answer = shell("route", str(file), "--from", "State0", "--to", "State3", "--format", "json")
    assert answer.json["operations"] == ["SB/State0/b", "SB/State2/d"]
    answer = shell("route", str(file), "--from", "State0", "--to", "State1")
    assert (answer.status, "but through the hazard Nowhere" in answer.err) == (1, True)


GATED = {
    "GATE": {"State_0": {"Open": "State_1"}, "State_1": {}},
    "SB": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
        "_operations": {"short": {"requires": {"GATE/0": "1"}},
                        "second": {"requires": {"SB/0": "1"}}},
        "State_00": {"short": "State_11", "first": "State_10", "second": "State_01"},
        "State_10": {"second": "State_11"}, "State_01": {"first": "State_11"}, "State_11": {},
    },
}  # fmt: skip
"""A short way that another root must open, and a longer one that is open by itself."""
ENDS = ("--from", "SB/State_00", "--to", "SB/State_11", "--format", "json")


@pytest.fixture
def gated(tmp_path: Path) -> Path:
    file = tmp_path / "gated.json"
    file.write_text(json.dumps(GATED))
    return file


def test_a_route_takes_no_operation_that_requires_what_does_not_hold(
    shell: Shell, gated: Path
) -> None:
    """The other roots stand as at the start; the SB's own facts change on its way."""
    answer = shell("route", str(gated), *ENDS)
    assert answer.json["operations"] == ["SB/State_00/first", "SB/State_10/second"]
    shut = shell("route", str(gated), *ENDS, "--avoid", "SB/State_00/first")
    assert (shut.status, shut.json["cost"]) == (1, None)
    assert shut.err.splitlines() == [
        "no route leads from SB/State_00 to SB/State_11",
        "SB/State_00/short requires GATE/0 to be 1, and it is 0",
    ]
    gated.write_text(json.dumps({**GATED, "GATE": {"State_1": {}}}))
    assert shell("route", str(gated), *ENDS).json["operations"] == ["SB/State_00/short"]


def test_the_route_of_a_run_and_the_planned_one_agree_about_what_is_required(
    shell: Shell, gated: Path
) -> None:
    planned = shell("route", str(gated), *ENDS).json
    run = shell("run", str(gated), "--world", "table", "--goal", "SB/State_11", "--format", "json")
    told = [json.loads(line) for line in run.out.splitlines()]
    (route,) = [one for one in told if one["event"] == "route_planned"]
    assert (route["operations"], route["cost"]) == (planned["operations"], planned["cost"])
