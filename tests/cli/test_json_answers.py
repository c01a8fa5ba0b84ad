"""Whatever a command is given: an answer of status 0 or 1 in JSON is one object, or one object a
line for a stream."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.cli.calls import filled, json_calls
from tests.cli.shell import Shell

STREAMS = ("run", "sweep")
ENDS = {"FROM": {"Op": "TO"}, "TO": {}}
CIRCLE = {
    name: {"HEADER": {"NUM_FACTS": 1, "SUB_SBS": {sub: 0}}, **ENDS}
    for name, sub in (("SB", "SUB"), ("SUB", "SB"))
}
BLUEPRINTS: dict[str, Any] = {
    "a start": {"SB": ENDS},
    "no start": {"SB": {"HEADER": {"INITIAL": "NOWHERE"}, **ENDS}},
    "an SB without states": {"SB": ENDS, "NONE": {}},
    "nothing": {},
    "a circle of SBs": CIRCLE,
    "a circle with properties": {
        "_hazards": [{"name": "H", "facts": {"SB/0": "O"}}],
        "_properties": [{"name": "P", "reachable": "SB in TO"}],
        **CIRCLE,
    },
    "a sub-SB whose start is its end": {
        "SB": {"HEADER": {"NUM_FACTS": 1, "SUB_SBS": {"SUB": 0}}, "State_0": {"Op": "State_1"},
               "State_1": {}},
        "SUB": {"HEADER": {"INITIAL": "State_1", "ACTIVATING": "State_1"}, "State_1": {}},
    },
}  # fmt: skip
"""Files that open, and of which some questions have no answer."""


@pytest.mark.parametrize("kind", BLUEPRINTS)
@pytest.mark.parametrize("command", json_calls())
def test_an_answer_in_json_is_an_object(
    command: str, kind: str, shell: Shell, tmp_path: Path
) -> None:
    file, out = tmp_path / "a.json", str(tmp_path / "OUT")
    file.write_text(json.dumps(BLUEPRINTS[kind]))
    other = tmp_path / "b.json"
    other.write_bytes(file.read_bytes())
    values = {"FILE": str(file), "OTHER": str(other), "OUT": out}
    answer = shell(*filled(json_calls()[command], values))
    if answer.status == 2:
        assert answer.err
        return
    assert answer.status in (0, 1)
    lines = answer.out.splitlines()
    assert lines if command in STREAMS else len(lines) == 1
    assert all(isinstance(json.loads(line), dict) for line in lines)


@pytest.mark.parametrize(
    ("command", "keys"),
    [
        ("diff", ["equal", "path", "reason", "configurations"]),
        ("flatten", ["equal", "path", "reason"]),
        ("explore", ["sbs", "modes"]),
        ("identify", ["cuts", "bound"]),
    ],
)
def test_no_answer_has_the_keys_of_an_answer(
    command: str, keys: list[str], shell: Shell, tmp_path: Path
) -> None:
    file = tmp_path / "a.json"
    file.write_text(json.dumps(BLUEPRINTS["no start"]))
    words = {"diff": [str(file), str(file), "--behaviour"],
             "flatten": [str(file), "-o", str(tmp_path / "flat.json")]}  # fmt: skip
    answer = shell(command, *words.get(command, [str(file)]), "--format", "json")
    assert answer.status == 1
    assert list(answer.json) == keys
    assert answer.json.get("equal") is None
    assert "INITIAL is NOWHERE" in answer.err


def test_an_account_of_a_log_answers_in_json(shell: Shell, tmp_path: Path) -> None:
    file, log = tmp_path / "a.json", tmp_path / "log"
    file.write_text(json.dumps({"SB": {"State_0": {"Op": "State_1"}, "State_1": {}}}))
    shell("run", str(file), "--world", "table", "--log", str(log))
    page = str(tmp_path / "page.html")
    answer = shell("replay", str(log), "-o", page, "--format", "json")
    assert (answer.status, answer.json["verified"], answer.json["output"]) == (0, True, page)
