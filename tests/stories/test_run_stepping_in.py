"""Run mode: prune an operation on the canvas, and press what a held run offers."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from smsl_studio.runlog.events import Commanded, OperationPruned
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
