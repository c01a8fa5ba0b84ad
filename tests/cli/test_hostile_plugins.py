"""Every command that needs the offers of plugins, run with hostile plugins."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from tests.cli.shell import Shell
from tests.hostile_plugins import IMPORTED, MARKING, REGISTERED
from tests.plugin_folder import LAMP, LAMP_PLUGIN, write_plugin

WORST = {**IMPORTED, **REGISTERED}
NAMES = ("exits", "kills_the_program", "tells_a_pickle", "timeout_runs", "name_steers")


@pytest.mark.parametrize(
    "command",
    ["plugins", "worlds", "check {file} --world lamp", "run {file} {on}", "sweep {file} {on}"],
)
def test_no_command_runs_them_and_none_is_stopped(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    marks, folder = tmp_path / "marks", tmp_path / "plugins"
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "home"))
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(folder))
    for name in NAMES:
        code = MARKING.format(marks=str(marks)) + WORST[name][0]
        write_plugin(folder, name, code.replace("{program}", str(os.getpid())))
    write_plugin(folder, "lamp", LAMP_PLUGIN)
    file = tmp_path / "lamp.json"
    only_on = {"State_0": {"Op_on": "State_1"}}
    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], **only_on}}), "utf-8")
    answer = shell(*command.format(file=file, on="--world lamp").split())
    assert answer.status == 0, answer
    assert "\x1b" not in answer.out + answer.err
    assert str(os.getpid()) not in marks.read_text().split()
    if command in ("plugins", "worlds"):
        assert all(answer.out.count(f"the plugin '{name}' did not load") == 1 for name in NAMES)
        assert "lamp" in answer.out
