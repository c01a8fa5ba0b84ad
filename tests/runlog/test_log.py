"""The log: a line that was written is there, and a log that cannot be written says so."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from smsl_studio.errors import ReadError, SaveError
from smsl_studio.runlog.events import Committed, Paused, RunFinished
from smsl_studio.runlog.log import RunLog, read_log

EVENTS = (
    Paused(t=0.1),
    Committed(t=0.25, operations=("SB/é/Op",), configuration={"SB": "State_\udcff"}),
    RunFinished(t=1.0, reason="stopped", sentence="Stop.", operations=1, configuration={}),
)


def test_what_is_written_is_read(tmp_path: Path) -> None:
    with RunLog(tmp_path / "run.jsonl", {"seed": 7}) as log:
        log.write(EVENTS[:1])
        log.write(EVENTS[1:])
    found = read_log(tmp_path / "run.jsonl")
    assert found.header == {"log": "smsl-run", "version": 1, "seed": 7}
    assert [e["event"] for e in found.events] == ["paused", "committed", "run_finished"]
    assert found.events[1]["operations"] == ["SB/é/Op"]
    assert not found.cut


def test_a_killed_writer_loses_nothing_it_has_written(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    code = (
        "import os, signal, sys, pathlib\n"
        "from smsl_studio.runlog.log import RunLog\n"
        "from smsl_studio.runlog.events import Paused\n"
        "log = RunLog(pathlib.Path(sys.argv[1]), {})\n"
        "for i in range(100): log.write([Paused(t=float(i))])\n"
        "os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", code, str(path)], check=False)
    assert done.returncode == -signal.SIGKILL
    assert [event["t"] for event in read_log(path).events] == [float(i) for i in range(100)]


def test_a_line_cut_short_is_dropped(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    with RunLog(path, {}) as log:
        log.write(EVENTS)
    whole = path.read_bytes()
    path.write_bytes(whole[:-5])
    found = read_log(path)
    assert (len(found.events), found.cut) == (2, True)


@pytest.mark.parametrize("where", ["nowhere/run.jsonl", "."])
def test_a_log_that_cannot_be_opened_says_so(tmp_path: Path, where: str) -> None:
    with pytest.raises(SaveError, match="the run log cannot be written") as caught:
        RunLog(tmp_path / where, {})
    assert caught.value.advice


def test_a_full_disk_is_seen_at_the_first_line() -> None:
    with pytest.raises(SaveError, match="No space left"):
        RunLog(Path("/dev/full"), {})


@pytest.mark.parametrize(
    ("text", "line"), [(b"", 1), (b'{"a":1}\n', 1), (b'{"log":"smsl-run"}\n[]\n', 2)]
)
def test_what_is_no_log_is_refused_with_its_line(tmp_path: Path, text: bytes, line: int) -> None:
    path = tmp_path / "x"
    path.write_bytes(text)
    with pytest.raises(ReadError) as caught:
        read_log(path)
    assert caught.value.place is not None
    assert caught.value.place.line == line


def test_a_missing_log_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="cannot be read"):
        read_log(tmp_path / "x")
