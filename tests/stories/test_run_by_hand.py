"""By hand: a person chooses each operation, by its arrow or in the list; refusals give reasons."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QPushButton

from smsl_studio.runlog.events import Commanded, OperationStarted
from tests.plugin_folder import write_plugin
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"

FAILING = """
def register(library):
    @library.world("bench", engine="table")
    def build(world, blueprint, seed):
        return world

    @library.arrange("bench")
    def arrange(world, facts):
        world.set_facts(facts)

    @library.sensor("peg_{n}", fact="{n}")
    def peg(world, n: int):
        return world.fact("SB1", n - 1)

    tried = []

    @library.operation("Op_{disk}{peg}")
    def move(world, disk: int, peg: str):
        yield
        tried.append(disk)
        if len(tried) <= 2:
            return False
        world.set_facts({("SB1", disk - 1): peg})
"""


def _by_hand(sit: Sit, path: Path) -> AtRun:
    run = AtRun(sit(path))
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    return run


def test_an_arrow_is_clicked_and_an_operation_is_chosen_from_the_list(sit: Sit) -> None:
    run = _by_hand(sit, HFSM)
    run.click_arrow("SB1/State000/Operation000")
    run.until_done(1)
    assert run.active()["SB1"] == "State100"
    run.click_in_list("Operation100B")
    run.until_done(3)
    assert run.active() == {"SB1": "State111", "SB2": "State1"}
    assert run.phase == "Ready"


def test_the_second_press_of_a_double_click_carries_out_no_other_operation(sit: Sit) -> None:
    run = _by_hand(sit, HFSM)
    first = run.button("Operation000")
    at = first.mapToGlobal(first.rect().center())
    _press_at(first, at, 1_000)
    run.until_done(1)
    # The next operation has come below the pointer.
    second = run.button("Operation100B")
    _press_at(second, at, 1_220)
    # The run takes commands in their order, so another choice would stand before the pause.
    run.person.press(Key.Key_F6)
    run.person.until(lambda: "pause" in asked(run))
    assert asked(run).count("ask") == 1


def asked(run: AtRun) -> list[str]:
    return [one.command for one in run.events if isinstance(one, Commanded)]


def _press_at(button: QPushButton, at: QPoint, moment: int) -> None:
    """Press and let go at a point of the screen, at a moment (milliseconds)."""
    for kind in (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonRelease):
        held = LEFT if kind == QEvent.Type.MouseButtonPress else Qt.MouseButton.NoButton
        event = QMouseEvent(
            kind, QPointF(button.rect().center()), QPointF(at), LEFT, held,
            Qt.KeyboardModifier.NoModifier,
        )  # fmt: skip
        event.setTimestamp(moment)
        QApplication.sendEvent(button, event)


def test_a_held_key_steps_and_plays_once(sit: Sit) -> None:
    actions = sit(HFSM).window.actions_table
    assert not actions["run_step"].autoRepeat()
    assert not actions["run_play"].autoRepeat()
    assert actions["undo"].autoRepeat()


def test_the_focus_stays_in_the_list_when_its_rows_are_made_again(sit: Sit) -> None:
    run = _by_hand(sit, HFSM)
    run.click_in_list("Operation000")
    run.until_done(1)
    rows = run.pane.possible.list
    # The rows are made again a moment after the run has told its news.
    run.person.until(lambda: QApplication.focusWidget() is rows)

    chosen = run.button("Operation100B")
    chosen.setFocus()
    run.person.windows.set_theme("dark")
    run.person.until(lambda: run.button("Operation100B") is not chosen)
    assert QApplication.focusWidget() is run.button("Operation100B")


def test_what_is_not_possible_says_why(sit: Sit) -> None:
    run = _by_hand(sit, HFSM)
    run.click_arrow("SB1/State100/Operation100B")
    run.person.qtbot.waitUntil(lambda: "SB1 is in State000" in run.word())
    assert run.active()["SB1"] == "State000"
    why = [row for row in run.possible() if row.startswith("Operation0 ")]
    assert why
    assert "has no rise of digit 1" in why[0]


def test_play_goes_on_by_itself(sit: Sit) -> None:
    run = _by_hand(sit, HFSM)
    run.person.click(run.pane.transport.play)
    run.until_phase("Goal reached")
    assert not run.pane.transport.by_hand.isChecked()


def test_a_failed_operation_holds_says_why_and_can_be_restored(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_plugin(tmp_path, "bench", FAILING)
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(tmp_path))
    run = AtRun(sit(SAMPLES / "hanoi-2.json"))
    run.choose(world="bench")
    run.person.press(Key.Key_F5)
    run.until_phase("Fault hold")
    tried = {e.address for e in run.events if isinstance(e, OperationStarted)}
    assert run.pane.canvas.banner.startswith(
        "Fault hold: Only risky operations lead to SB1/State_cc"
    )
    assert {str(a) for a in run.pane.canvas.canvas.marks.risky} == tried
    assert run.pane.run.exists
    run.click_in_list("Restore")
    run.person.qtbot.waitUntil(lambda: len(run.pane.canvas.canvas.marks.risky) == 1)
    run.person.click(run.pane.transport.play)
    run.until_phase("Goal reached")
    assert run.pane.canvas.banner == ""


def test_stop_ends_the_runs_of_every_window(sit: Sit) -> None:
    first, second = _by_hand(sit, HFSM), _by_hand(sit, HFSM)
    second.person.press(Key.Key_F8)
    first.until_phase("Stopped")
    second.until_phase("Stopped")
