"""Closing a window frees everything it held, whatever was going on in it."""

from __future__ import annotations

import gc
import threading
import weakref
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.place import folder_of
from smsl_studio.studio.shell.window import Window
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import Person
from tests.stories.test_files import copy_of
from tests.stories.test_several_files import answer

OPENED = 3


def work(person: Person) -> None:
    """Use what is built only when it is asked for, and leave dialogs and menus open."""
    window = person.window
    person.select("SB1/State100")
    window.show_tab("Source")
    window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB7"))
    window.session.show_branch("SB7")
    window.comparing.with_saved()
    window.open_palette()
    window.show_shortcuts()
    window.session.history.setClean()


def make_pages(person: Person) -> None:
    """Make the pages of a run, of supervision and of a recording. Nobody ever shows them."""
    features = person.window.features
    assert not features.run.pane.isVisible()
    assert not features.replay.verbs.pane.isVisible()


def gone() -> None:
    """Let everything happen that was posted when a window was closed."""
    QApplication.processEvents()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def held() -> tuple[int, int]:
    """How many widgets there are, and how many objects of ours."""
    gc.collect()
    modules = (str(type(one).__module__) for one in gc.get_objects())
    ours = sum(module.startswith("smsl_studio.studio") for module in modules)
    return len(QApplication.allWidgets()), ours


@pytest.mark.parametrize("use", [work, make_pages])
def test_windows_that_were_closed_leave_nothing_behind(
    sit: Sit, tmp_path: Path, use: Callable[[Person], None]
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    refs: list[weakref.ref[QObject]] = []
    counts = []
    for _ in range(OPENED):
        person = sit(path)
        use(person)
        refs += [weakref.ref(person.window), weakref.ref(person.window.session)]
        assert person.window.close()
        gone()
        del person
        counts.append(held())
    assert [ref for ref in refs if ref() is not None] == []
    assert counts[1:] == counts[1:2] * (OPENED - 1)


def begin_inspection(window: Window) -> None:
    window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB7"))
    window.inspector._inspect()


def begin_reading(window: Window) -> None:
    window.show_tab("Source")
    window.source.editor.setFocus()
    window.source.typing.begin("Type")
    window.source.typing.hurry()


def begin_journal(window: Window) -> None:
    window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB7"))
    window.safety.journal._write()
    window.session.history.setClean()


def begin_git(window: Window) -> None:
    window.comparing.with_revision()


def begin_look(window: Window) -> None:
    assert window.files.path is not None
    window.files.path.write_text(window.files.path.read_text().replace("SB1", "SB3"))
    window.safety.outside.watcher.stir()


@pytest.mark.parametrize(
    "begin", [begin_inspection, begin_reading, begin_journal, begin_git, begin_look]
)
def test_a_window_is_closed_while_something_goes_on(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, begin: Callable[[Window], None]
) -> None:
    monkeypatch.setattr("smsl_studio.studio.features.draw.source.typed_text.LARGE", 1)
    before = set(threading.enumerate())
    person = sit(copy_of("hfsm.json", tmp_path))
    told: list[object] = []
    begin(person.window)
    person.window.session.history.setClean()
    person.window.session.blueprint_changed.connect(lambda *_: told.append(1))
    assert person.window.close()
    gone()
    person.until(lambda: set(threading.enumerate()) <= before)
    assert told == []


def by_hand(sit: Sit, path: Path) -> AtRun:
    """A run that waits for a hand, and so does not come to its end by itself."""
    run = AtRun(sit(path))
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Qt.Key.Key_F5)
    run.until_phase("Ready")
    return run


def phases(run: AtRun) -> list[str]:
    """Every phase that the run comes to from now on."""
    seen: list[str] = []
    run.pane.run.changed.connect(lambda: seen.append(run.pane.run.phase))
    return seen


def test_closing_during_a_run_asks_and_staying_changes_nothing(sit: Sit, tmp_path: Path) -> None:
    run = by_hand(sit, copy_of("hfsm.json", tmp_path))
    told: list[str] = []
    answer(run.person, "Stay", told)
    assert not run.person.window.close()
    assert told == ["The run of hfsm.json in table has not ended."]
    assert run.pane.run.exists
    assert run.phase == "Ready"


def test_closing_stops_the_run_first_and_unsaved_work_is_asked_about(
    sit: Sit, tmp_path: Path
) -> None:
    run = AtRun(sit(copy_of("hanoi.json", tmp_path)))
    run.person.press(Qt.Key.Key_F5)
    run.until_runs()
    window, seen = run.person.window, phases(run)
    window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB7"))
    told: list[str] = []

    def stop_then(words: str) -> None:
        answer(run.person, "Stop and close", told)
        QTimer.singleShot(60, window, lambda: answer(run.person, words, told))

    stop_then("Cancel")
    assert not window.close()
    assert run.pane.run.exists, "nothing is stopped before everything is answered"
    stop_then("Discard changes")
    assert window.close()
    assert told[1::2] == ["hanoi.json has unsaved changes."] * 2
    assert seen[-1] == "stopped"


def test_the_end_of_the_session_stops_a_run_and_asks_nothing(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = by_hand(sit, copy_of("hfsm.json", tmp_path))
    window, seen = run.person.window, phases(run)
    monkeypatch.setattr(QApplication, "quit", lambda *_: window.close())
    run.person.windows.leave()
    assert not window.isVisible()
    assert seen[-1] == "stopped"


def test_what_is_edited_while_a_run_ends_is_kept_and_not_asked_about(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = by_hand(sit, copy_of("hfsm.json", tmp_path))
    window, told = run.person.window, list[str]()
    end = window.end_run

    def end_and_edit() -> None:
        end()
        window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB7"))

    monkeypatch.setattr(window, "end_run", end_and_edit)
    monkeypatch.setattr(QApplication, "quit", lambda *_: window.close())
    QTimer.singleShot(60, window, lambda: answer(run.person, "Cancel", told))
    run.person.windows.leave()
    assert (told, window.isVisible()) == ([], False)
    (left,) = left_behind(folder_of(run.person.windows.settings.folder))
    assert "SB7" in str(left.entry)
    left.drop()


def test_a_key_closes_the_window_and_asks_before_work_is_lost(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    window = person.window
    window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB7"))
    answer(person, "Cancel")
    person.ctrl(Qt.Key.Key_W)
    assert window in list(person.windows)
    window.session.history.setClean()
    person.come_back()
    window.canvas.setFocus()
    person.ctrl(Qt.Key.Key_W)
    assert window not in list(person.windows)
