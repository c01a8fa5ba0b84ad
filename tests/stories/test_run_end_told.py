"""The end of a run is told where it is not seen, and reads as an end."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from smsl_studio.runlog.events import Commanded
from smsl_studio.studio.running import operation_time
from tests.stories.at_run import AtRun
from tests.stories.at_supervise import AtSupervise
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_files import copy_of

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"


def paused(sit: Sit, path: Path = HFSM) -> AtRun:
    run = AtRun(sit(path))
    run.choose(world="table")
    run.person.press(Key.Key_F10)
    run.until_done(1)
    return run


def test_a_run_that_a_person_ended_waits_for_nobody_and_stop_is_off(sit: Sit) -> None:
    run = paused(sit)
    person, stop = run.person, run.pane.transport.stop
    assert stop.isEnabled()
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    assert run.pane.transport.phase.property("kind") == "held"
    run.pane.run.end()
    run.until_phase("Ended: stopped")
    assert run.pane.transport.phase.property("kind") == "quiet"
    assert stop.isVisible()
    assert not stop.isEnabled()
    person.ctrl(Key.Key_3)
    bar = person.window.features.supervise.pane.bar
    assert bar.phase.text() == "Ended: stopped"
    assert bar.stop.isVisible()
    assert not bar.stop.isEnabled()
    assert person.window.features.supervise.pane.notice.words.startswith("Ended: stopped")


def test_stop_with_the_keyboard_focus_gives_it_to_the_page_when_the_run_ends(sit: Sit) -> None:
    run = paused(sit)
    run.pane.transport.stop.setFocus()
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    run.pane.run.end()
    run.until_phase("Ended: stopped")
    person = run.person
    person.until(run.pane.canvas.canvas.hasFocus)


def test_draw_tells_how_the_run_of_another_file_has_ended_and_leads_to_it(
    sit: Sit, tmp_path: Path
) -> None:
    run = paused(sit)
    person, toast = run.person, run.person.window.toast
    person.ctrl(Key.Key_1)
    person.window.open_path(copy_of("hanoi-2.json", tmp_path))
    run.pane.play()
    person.until(lambda: "hfsm.json has ended: goal reached" in toast.words)
    assert toast.severity == ""
    person.click(toast.button)
    assert person.window.mode == "run"
    assert run.phase == "Goal reached"


def test_a_run_that_was_ended_is_told_in_draw_as_a_warning_but_not_in_run(sit: Sit) -> None:
    run = paused(sit)
    person, toast = run.person, run.person.window.toast
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    person.ctrl(Key.Key_1)
    run.pane.run.end()
    person.until(lambda: "hfsm.json has ended: stopped" in toast.words)
    assert toast.severity == "W"
    person.ctrl(Key.Key_2)
    toast.hide()
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert toast.words == ""


def test_a_question_with_a_typed_reason_says_that_the_run_has_ended(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", 0.5)
    at = AtSupervise(sit(HFSM))
    at.start("table")
    at.person.until(lambda: at.run.status is not None and at.run.status.running is not None)
    at.press(Key.Key_P)
    at.person.type("blunt")
    asked = at.pane.step_in.asking.words.partition("?")[0]
    at.until_phase("Goal reached")
    assert not at.pane.step_in.asking.isVisible()
    assert f'The run has ended, so the question "{asked}?" is gone.' in at.pane.step_in.refusal


def test_a_question_in_run_says_that_the_run_has_ended(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", 0.5)
    run = AtRun(sit(HFSM))
    run.choose(world="table")
    run.person.press(Key.Key_F5)
    run.until_runs()
    session, possible = run.pane.run, run.pane.possible
    assert session.status is not None
    possible.list.prune_wanted.emit(session.status.running)
    run.person.type("blunt")
    run.until_phase("Goal reached")
    run.person.until(partial(_reads, possible, "is gone. Nothing of it was recorded."))


def _reads(possible: QWidget, words: str) -> bool:
    return any(words in part.text() for part in possible.findChildren(QLabel) if part.isVisible())


def test_a_run_that_is_paused_is_ended_from_the_palette_with_a_question(sit: Sit) -> None:
    run = paused(sit)
    person = run.person
    person.ctrl(Key.Key_K)
    person.type("end run")
    person.press(Key.Key_Return)
    asking = person.window.features.supervise.pane.step_in.asking
    person.until(asking.isVisible)
    assert "stopped first" in asking.words
    assert run.pane.run.exists
    person.press(Key.Key_Return)
    person.until(lambda: not run.pane.run.exists)
    assert run.phase == "Ended: stopped"


def test_what_moves_is_stopped_before_its_run_is_ended(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", 30.0)
    run = AtRun(sit(HFSM))
    run.choose(world="table")
    run.person.press(Key.Key_F5)
    run.until_runs()
    action = run.person.window.actions_table["run_end"]
    assert action.isEnabled()
    action.trigger()
    run.person.press(Key.Key_Return)
    run.person.until(lambda: not run.pane.run.exists)
    done = [one.command for one in run.events if isinstance(one, Commanded) and not one.refused]
    assert done == ["stop", "end"]
    assert not action.isEnabled()
