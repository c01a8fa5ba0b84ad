"""``sweep``: what its lines say of hazards. tests/cli/test_run.py has the rest."""

from __future__ import annotations

import json
from pathlib import Path

from tests.cli.shell import Shell


def test_a_sweep_is_not_guarded_and_names_the_hazards_that_edges_meet(
    shell: Shell, tmp_path: Path
) -> None:
    hazards = [
        {"name": "Middle", "facts": {"SB/0": "1", "SB/1": "0"}},
        {"name": "First", "facts": {"SB/0": "1"}},
    ]
    table = {
        "State00": {"a": "State10", "b": "State01"},
        "State10": {"c": "State11", "d": "State00"},
        "State01": {"e": "State11"},
        "State11": {},
    }
    file = tmp_path / "swept.json"
    file.write_text(json.dumps({"_hazards": hazards, "SB": table}))
    answer = shell("sweep", str(file), "--world", "table", "--format", "json")
    lines = [json.loads(line) for line in answer.out.splitlines()][:-1]
    assert answer.status == 0
    found = {line["address"][-1]: line.get("hazard") for line in lines}
    assert found == {"a": "Middle", "b": None, "c": "First", "d": None, "e": "First"}
    assert all("hazard" not in line for line in lines if line["address"][-1] in "bd")
    text = shell("sweep", str(file), "--world", "table").out
    assert "meets the hazard Middle" in text
