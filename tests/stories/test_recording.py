"""Every run of the window is recorded unless that is switched off.

If the log fails, the run ends.
"""

from __future__ import annotations

import resource
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from PySide6.QtCore import Qt

import smsl_studio as smsl
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front import read
from smsl_studio.front.verifier import told_again
from smsl_studio.runlog.ends import LET_GO
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.studio.running import operation_time
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
HFSM, HANOI = SAMPLES / "hfsm.json", SAMPLES / "hanoi-corrected.json"


def _recorded(home: Path) -> list[Path]:
    return sorted((home / "recordings").glob("*.jsonl"))


@contextmanager
def _small_files(size: int) -> Iterator[None]:
    """No file of this process grows beyond ``size`` bytes, as on a disk that is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_run_is_recorded_as_it_is_told(sit: Sit, home: Path) -> None:
    run = AtRun(sit(HFSM))
    run.person.press(Key.Key_F10)
    run.until_done(1)
    assert "Recording" in [part.text() for part in run.person.window.status_line.run_right]
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    (path,) = _recorded(home)
    assert path.name.startswith("hfsm-")
    log = read_log(path, COMMANDS)
    assert log.doubt is None
    assert [one.text for one in log.records] == [event.line() for event in run.events]
    assert (log.header["host"], log.header["world"]) == ("process", "table")


def test_a_run_that_ends_with_its_window_has_a_complete_log(sit: Sit, home: Path) -> None:
    run = AtRun(sit(HANOI))
    run.person.press(Key.Key_F5)
    run.until_runs()
    run.pane.shut()
    (path,) = _recorded(home)
    log = read_log(path, COMMANDS)
    assert log.doubt is None
    assert log.header["versions"]["plugin hanoi"]
    assert (log.events[-1].event, log.events[-1].as_json()["sentence"]) == ("run_finished", LET_GO)


def test_a_run_that_a_person_stopped_ends_so_when_its_window_goes(
    sit: Sit, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", 1e6)
    run = AtRun(sit(HANOI))
    run.choose(world="table")
    run.person.press(Key.Key_F5)
    run.until_runs()
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    run.pane.shut()
    (path,) = _recorded(home)
    log = read_log(path, COMMANDS)
    assert log.doubt is None
    by = next(event.as_json()["by"] for event in log.events if event.event == "stopped")
    end = log.events[-1].as_json()
    assert (end["event"], end["reason"]) == ("run_finished", "stopped")
    assert end["sentence"] == f"Stopped by {by}."
    assert told_again(path.read_bytes(), read(str(HANOI))) == ""


def test_runs_are_not_recorded_where_nobody_wants_it(sit: Sit, home: Path) -> None:
    run = AtRun(sit(HFSM))
    run.person.windows.settings.record_runs = False
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert _recorded(home) == []


def test_a_log_that_cannot_be_written_refuses_the_start(sit: Sit, home: Path) -> None:
    run = AtRun(sit(HFSM))
    home.mkdir(exist_ok=True)
    (home / "recordings").write_text("a file where the folder should be")
    run.person.press(Key.Key_F5)
    run.person.until(lambda: "cannot be made" in run.pane.canvas.banner)
    assert not run.pane.run.exists
    assert run.events == []


@pytest.mark.parametrize("room", [600, 2000])
def test_a_disk_that_fills_holds_the_run_and_ends_it(
    sit: Sit, home: Path, tmp_path: Path, room: int
) -> None:
    """The header has room, and so many bytes behind it."""
    smsl.run(smsl.read(SAMPLES / "registration.json"), "registration", log=tmp_path / "log")
    header = (tmp_path / "log").read_bytes().index(b"\n")
    run = AtRun(sit(SAMPLES / "registration.json"))
    run.person.windows.settings.sync()
    with _small_files(header + room):
        run.person.press(Key.Key_F5)
        run.until_phase("Ended: failed")
    assert [event.event for event in run.events][-2:] == ["held", "run_finished"]
    assert "the run log cannot be written" in run.pane.canvas.banner
    (path,) = _recorded(home)
    log = read_log(path, COMMANDS)
    assert log.doubt is not None
    kept = [one.text for one in log.records]
    assert kept == [event.line() for event in run.events][: len(kept)]
    assert len(log.events) == len(run.events) - 2
