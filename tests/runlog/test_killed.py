"""After kill -9 of a writer or a run, no acknowledged event is lost."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.shipped import samples_dir
from tests.runlog.killed import kill_a_writer


@pytest.mark.parametrize("seed", range(6))
def test_a_killed_writer_loses_nothing_that_it_acknowledged(tmp_path: Path, seed: int) -> None:
    killed = kill_a_writer(tmp_path / "log", Random(seed))
    assert killed.acknowledged > 0
    assert killed.lost == 0
    assert killed.run.head is None
    assert killed.run.doubt is not None


def test_a_killed_run_has_logged_what_it_printed(tmp_path: Path) -> None:
    """It takes fifteen seconds and is killed within the second of them, so it has not ended."""
    log = tmp_path / "log"
    argv = ["run", str(samples_dir() / "hanoi-4.json"), "--world", "table", "--speed", "0.05"]
    command = [sys.executable, "-m", "smsl_studio", *argv, "--format", "json", "--log", str(log)]
    pipe, nothing = subprocess.PIPE, subprocess.DEVNULL
    with subprocess.Popen(command, stdout=pipe, stderr=nothing, text=True) as run:
        assert run.stdout is not None
        printed = [run.stdout.readline() for _ in range(14)]
        run.send_signal(signal.SIGKILL)
        printed += run.stdout.readlines()
    found = read_log(log, COMMANDS)
    logged = [f"{one.text}\n" for one in found.records]
    assert logged[: len(printed)] == printed
    assert len(logged) >= len(printed) >= 14
    assert "the log has no head" in str(found.doubt)
