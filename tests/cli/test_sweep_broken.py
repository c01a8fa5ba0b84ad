"""A sweep of a blueprint with errors still runs every edge, to help find the errors."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.shell import Shell

BASE = {
    "HEADER": {"SUB_SBS": {"Sub": 0}},
    "State_0": {"load": "State_1", "rise": "State_1"},
    "State_1": {"fall": "State_0"},
}
SUB = {"State_0": {"up": "State_1"}, "State_1": {"down": "State_0"}}


@pytest.mark.parametrize("activating", ["State_100", "State_", "x"])
@pytest.mark.parametrize("facts", [{}, {"State_0": {"facts": ["0"]}, "State_1": {"facts": ["1"]}}])
def test_a_sub_whose_activating_is_no_state(
    shell: Shell, tmp_path: Path, activating: str, facts: object
) -> None:
    file = tmp_path / "broken.json"
    sub = {"HEADER": {"ACTIVATING": activating, "NUM_FACTS": 1}, "_states": facts, **SUB}
    values = {"Base": {"_operations": {"load": {"subs": "load"}}, **BASE}, "Sub": sub}
    file.write_text(json.dumps(values), "utf-8")
    answer = shell("sweep", str(file), "--world", "table", "--format", "json")
    assert (answer.status, len(answer.lines)) == (1, 6)
    assert not any(line["passed"] for line in answer.lines if line.get("address", "")[:4] == "Base")
    assert shell("check", str(file)).status == 1
    assert shell("run", str(file), "--world", "table").status == 1
