"""``generate explore`` that is killed in the middle and called again."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.shell import Shell
from tests.front.test_physics import BOARD, SWITCHES
from tests.plugin_folder import write_plugin

GATE = """

    @library.operation("Op_wait")
    def wait(world):
        yield
        gate = os.environ.get("SWITCH_GATE", "")
        if gate and world.fact(world.sb, 0) == "1":
            open(gate).read()
        return False
"""


def test_what_was_killed_goes_on_to_the_same_bytes(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its second state waits at a pipe that nobody writes, and there it is killed."""
    write_plugin(tmp_path / "plugins", "switches", f"import os\n{SWITCHES}{GATE}")
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path / "plugins"))
    board, gate = tmp_path / "board.json", tmp_path / "gate"
    board.write_text(json.dumps(BOARD), "utf-8")
    os.mkfifo(gate)
    words = ("generate", "explore", "--world", "switches", "--start", str(board), "-o")
    out, whole = tmp_path / "found.json", tmp_path / "whole.json"
    command = [sys.executable, "-m", "smsl_studio", *words, str(out)]
    environment = os.environ | {"SWITCH_GATE": str(gate)}
    # The other end of the pipe opens as soon as the child waits there.
    with subprocess.Popen(command, env=environment) as child, gate.open("w"):
        child.kill()
        assert child.wait() == -signal.SIGKILL
    part = Path(f"{out}.part")
    assert part.read_bytes().count(b"\n") == 2, "the first state is kept"
    assert not out.exists()
    assert shell(*words, str(out)).status == 0
    assert shell(*words, str(whole)).status == 0
    assert out.read_bytes() == whole.read_bytes()
    assert not part.exists()
