"""Starting the window: files and options, one window for each file, messages on unreadable
files."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.place import folder_of
from smsl_studio.studio.shell import application as app
from smsl_studio.studio.shell.windows import Windows

SAMPLES = Path(__file__).parents[3] / "samples"


def test_files_and_mode_are_read_from_the_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[tuple[list[str], str]] = []

    def open_window(files: list[str], mode: str) -> int:
        told.append((files, mode))
        return 0

    monkeypatch.setattr(app, "open_window", open_window)
    assert app.main(["a.json", "--mode", "run", "b.json"]) == 0
    assert app.main([]) == 0
    assert told == [(["a.json", "b.json"], "run"), ([], "draw")]


def test_a_file_that_cannot_be_read_leaves_an_empty_window_that_says_why(
    qapp: QApplication, qtbot: QtBot, tmp_path: Path
) -> None:
    path = tmp_path / "picture.json"
    path.write_bytes(b"\x89PNG\r\n\x1a\n")
    window = app.make_window(Windows(qapp, Settings()), str(path))
    assert "picture.json:1:1" in window.toast.words
    assert list(window.session.blueprint.branches) == ["SB1"]
    window.close()
    window.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_the_window_runs_until_it_is_closed(
    qapp: QApplication, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    windows: list[QWidget] = []

    def execute(self: QApplication) -> int:
        windows.extend(w for w in self.topLevelWidgets() if w.isVisible() and w.windowTitle())
        return 0

    monkeypatch.setattr(QApplication, "exec", execute)
    files = [str(SAMPLES / "hfsm.json"), str(SAMPLES / "hanoi.json")]
    assert app.open_window(files, "run") == 0
    titles = {window.windowTitle().partition(" ")[0] for window in windows}
    assert titles == {"hfsm.json", "hanoi.json"}
    for window in windows:
        window.close()
        window.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_a_session_that_ends_keeps_unsaved_work_and_asks_nothing(
    qapp: QApplication,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    windows = Windows(qapp, Settings())
    window = app.make_window(windows, str(SAMPLES / "hfsm.json"))
    window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State011"))
    window.session.select([Address("SB1", "State011")])
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    window.properties.state.title.setFocus()
    QTest.keyClicks(window.properties.state.title, "Half typed")
    monkeypatch.setattr(QApplication, "quit", lambda *_: window.close())
    windows.leave()
    assert not window.isVisible()
    (left,) = left_behind(folder_of(windows.settings.folder))
    assert "State011" in left.entry.texts[0].text
    assert "Half typed" in left.entry.texts[0].text
    assert "unsaved work in hfsm.json is kept" in capsys.readouterr().err
    left.drop()
    window.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


DRAWN = """
import os, sys
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.shell.windows import Windows
application = make_application([])
window = make_window(Windows(application, Settings()), sys.argv[1])
application.processEvents()
rooms = ("pyqtgraph", "moderngl", "pydantic", "pybullet", "paho", "numpy.ma",
         "smsl_studio.front.runs", "smsl_studio.host.child", "smsl_studio.runlog.events",
         "smsl_studio.dispatch.drive.driver", "smsl_studio.studio.features.run.pane")
print(*(name for name in rooms if name in sys.modules), flush=True)
os._exit(0)
"""


def test_the_first_picture_needs_nothing_of_a_run_and_no_plugin() -> None:
    sample = str(SAMPLES / "hanoi-corrected.json")
    done = subprocess.run(
        [sys.executable, "-c", DRAWN, sample], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == []


def test_a_page_is_made_when_its_mode_is_first_shown(qapp: QApplication, qtbot: QtBot) -> None:
    window = app.make_window(Windows(qapp, Settings()), str(SAMPLES / "hfsm.json"))
    run, replay = window.features.run, window.features.replay
    assert run.part.made is None
    assert replay.part.made is None
    window.actions_table["run_stop"].trigger()
    assert run.part.made is None, "there is nothing to stop"
    window.set_mode("supervise")
    assert run.part.made is not None, "what is supervised is a run"
    assert window.body.pages.currentWidget() is window.features.supervise.pane
    window.close()
    window.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
