"""Run mode: prune an operation on the canvas, and press what a held run offers."""

from __future__ import annotations

from functools import partial

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QToolButton

from smsl_studio.runlog.events import Commanded, OperationPruned
from smsl_studio.studio.running import operation_time
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
HANOI = SAMPLES / "hanoi-corrected.json"


def _prune(run: AtRun, operation: str, reason: str) -> None:
    for row in run.pane.possible.row_widgets():
        for button in row.findChildren(QToolButton):
            if button.accessibleName() == f"Prune {operation}":
                run.person.click(button)
                run.person.type(reason)
                run.person.press(Key.Key_Return)
                return
    raise AssertionError(f"{operation} cannot be pruned: {run.possible()}")


def _offer(run: AtRun, words: str) -> None:
    button = next(b for b in run.pane.possible.hold.buttons() if b.accessibleName() == words)
    run.person.click(button)
    assert words.split(maxsplit=1)[0] in run.pane.possible.asking.words
    run.person.press(Key.Key_Return)


def test_a_run_that_goes_on_takes_no_question_about_a_prune_away(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", 3.0)
    run = AtRun(sit(HANOI))
    run.choose(world="table")
    run.person.press(Key.Key_F5)
    session, asking = run.pane.run, run.pane.possible.asking
    run.person.until(lambda: session.status is not None and session.status.running is not None)
    button = next(
        button
        for row in run.pane.possible.row_widgets()
        for button in row.findChildren(QToolButton)
        if button.accessibleName().startswith("Prune ")
    )
    words = button.accessibleName()
    run.person.click(button)
    run.person.type("the tip")
    first = session.status
    assert first is not None
    run.person.until(lambda: session.status is not None and session.status.running != first.running)
    assert asking.words.startswith(f"{words}?")
    assert asking.reason.text() == "the tip"
    run.person.press(Key.Key_Return)
    run.person.qtbot.waitUntil(partial(_has_pruned, run, 1))


def test_the_keys_of_a_question_are_named_only_where_they_act(sit: Sit) -> None:
    run = AtRun(sit(HANOI))
    run.choose(world="table")
    run.person.press(Key.Key_F10)
    run.until_done(1)
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    hold, asking = run.pane.possible.hold, run.pane.possible.asking
    run.person.click(hold.buttons()[0])
    named = [part for part in asking.findChildren(QLabel) if part.text() in ("Enter", "Esc")]
    assert [part.isVisible() for part in named] == [True, True]
    run.pane.canvas.canvas.setFocus()
    assert [part.isVisible() for part in named] == [False, False]
    asking.do.setFocus()
    run.person.press(Key.Key_Escape)
    assert not asking.isVisible()


def test_everything_is_cut_an_offer_restores_and_the_run_goes_on(sit: Sit) -> None:
    run = AtRun(sit(HANOI))
    run.choose(world="table")
    run.person.press(Key.Key_F10)
    run.until_done(1)
    for at, operation in enumerate(("Op_1a", "Op_1b", "Op_2b"), 1):
        _prune(run, operation, "the tip is blunt")
        run.person.qtbot.waitUntil(partial(_has_pruned, run, at))
    assert set(_pruned(run)) == {"the tip is blunt"}
    run.person.press(Key.Key_F5)
    run.until_phase("No route")
    assert not run.pane.possible.hold.isHidden()
    _offer(run, "Restore Op_2b")
    run.person.qtbot.waitUntil(lambda: "restore" in _commands(run))
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert run.pane.possible.hold.isHidden()


def test_escape_leaves_pruning_undone(sit: Sit) -> None:
    run = AtRun(sit(HANOI))
    run.choose(world="table")
    run.person.press(Key.Key_F10)
    run.until_done(1)
    asking = run.pane.possible.asking
    run.pane.possible.list.prune_wanted.emit(
        next(p.address for p in run.pane.run.status.possible) if run.pane.run.status else None
    )
    assert asking.reason.hasFocus()
    run.person.press(Key.Key_Return)
    assert "A reason is needed" in asking.words
    run.person.press(Key.Key_Escape)
    assert asking.isHidden()
    assert _pruned(run) == []


def test_a_stop_is_latched_until_it_is_reset(sit: Sit) -> None:
    run = AtRun(sit(HANOI))
    run.choose(world="table")
    run.person.press(Key.Key_F10)
    run.until_done(1)
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    _offer(run, "Reset")
    run.until_phase("Paused")
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    _offer(run, "End run")
    run.person.qtbot.waitUntil(lambda: not run.pane.run.exists)


def _has_pruned(run: AtRun, count: int) -> bool:
    return len(_pruned(run)) == count


def _pruned(run: AtRun) -> list[str]:
    return [event.reason for event in run.events if isinstance(event, OperationPruned)]


def _commands(run: AtRun) -> list[str]:
    return [event.command for event in run.events if isinstance(event, Commanded)]
