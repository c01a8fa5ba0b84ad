"""``explore``: what can happen, its JSON, and its exit status."""

from __future__ import annotations

import json
from pathlib import Path

from tests.cli.shell import Shell, sample


def test_the_coupling_of_the_paper_prevents_four_disagreements(shell: Shell) -> None:
    answer = shell("explore", sample("hfsm"), "--format", "json")
    assert answer.status == 0
    assert list(answer.json) == ["sbs", "modes"]
    assert answer.json["sbs"] == ["SB1", "SB2"]
    ours, free = answer.json["modes"]["ours"], answer.json["modes"]["free"]
    assert ours == {"configurations": 4, "disagreements": [], "traps": []}
    assert free["configurations"] == 8
    assert free["disagreements"][0] == {
        "configuration": {"SB1": "State000", "SB2": "State1"},
        "path": ["SB2/State0/Operation0"],
    }
    assert len(free["disagreements"]) == 4
    text = shell("explore", sample("hfsm")).out
    assert "ours: 4 configurations, 0 disagreements, 0 traps\n" in text
    assert "  disagreement: SB1 in State000, SB2 in State1, by SB2/State0/Operation0\n" in text


def test_a_trap_and_a_limit_are_a_no(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "trap.json"
    states = {"State_0": {"go": "State_1", "fall": "State_2"}, "State_1": {}, "State_2": {}}
    file.write_text(json.dumps({"SB1": {"HEADER": {"ACTIVATING": "State_1"}, **states}}))
    answer = shell("explore", str(file))
    assert answer.status == 1
    assert "  trap: SB1 in State_2, by SB1/State_0/fall\n" in answer.out
    bound = shell("explore", str(file), "--limit", "1", "--format", "json")
    assert bound.status == 1
    assert bound.json["modes"]["ours"]["bound"] == "1 configurations"
    assert shell("explore", str(file), "--limit", "0").status == 2
