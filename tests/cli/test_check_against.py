"""``check --against``: what has changed since another version (R27)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.cli.shell import Shell, sample

BEFORE: dict[str, Any] = {
    "_hazards": [{"name": "Both", "facts": {"SB/0": "1", "SB/1": "1"}}],
    "_properties": [{"name": "Never", "never": "SB/0 = 1"}],
    "SB": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11"},
        "State_00": {"a": "State_10", "b": "State_01"},
        "State_10": {"b": "State_11", "back": "State_00"},
        "State_01": {"a": "State_11"},
        "State_11": {"c": "State_00"},
    },
}


def changed() -> dict[str, Any]:
    after = json.loads(json.dumps(BEFORE))
    del after["_hazards"], after["_properties"]
    after["SB"]["HEADER"]["INITIAL"] = "State_01"
    after["SB"]["State_00"]["b"] = "State_11"
    del after["SB"]["State_10"]["back"]
    after["SB"]["State_01"]["d"] = "State_00"
    return dict(after)


def written(folder: Path, name: str, values: dict[str, Any]) -> str:
    (folder / name).write_text(json.dumps(values, indent=1))
    return str(folder / name)


def test_removals_come_first_and_every_change_of_meaning_is_a_warning(
    shell: Shell, tmp_path: Path
) -> None:
    old, new = written(tmp_path, "old.json", BEFORE), written(tmp_path, "new.json", changed())
    answer = shell("check", new, "--against", old, "--rule", "R27", "--format", "json")
    (report,) = answer.json["files"]
    found = [(one["rule"], one["severity"], one["address"]) for one in report["findings"]]
    assert answer.status == 0
    assert found == [
        ("R27", "W", "_hazards/Both"),
        ("R27", "W", "_properties/Never"),
        ("R27", "W", "SB/State_10/back"),
        ("R27", "W", "SB/State_00/b"),
        ("R27", "W", "SB"),
        ("R27", "W", "SB/State_01/d"),
    ]
    removed, retargeted = report["findings"][2], report["findings"][3]
    lines = Path(new).read_text().splitlines()
    assert '"State_10"' in lines[removed["line"] - 1]
    assert removed["message"].startswith(f"since {old} the operation back of SB/State_10 is rem")
    assert '"b": "State_11"' in lines[retargeted["line"] - 1]


def test_the_changes_follow_all_other_findings(shell: Shell, tmp_path: Path) -> None:
    old, new = written(tmp_path, "old.json", BEFORE), written(tmp_path, "new.json", changed())
    answer = shell("check", new, "--against", old, "--format", "json")
    rules = [one["rule"] for one in answer.json["files"][0]["findings"]]
    assert rules.index("R27") == len(rules) - rules.count("R27")
    assert len(set(rules)) > 1


def test_without_a_difference_there_is_nothing(shell: Shell) -> None:
    name = sample("hanoi-corrected")
    answer = shell("check", name, "--against", name, "--rule", "R27", "--format", "json")
    assert answer.json["files"][0]["findings"] == []


def test_a_version_that_cannot_be_read_is_told(shell: Shell, tmp_path: Path) -> None:
    answer = shell("check", sample("hanoi-2"), "--against", str(tmp_path / "gone.json"))
    assert answer.status == 2
    assert "gone.json" in answer.err
    assert answer.out == ""
