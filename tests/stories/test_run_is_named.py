"""Everything shown around a run belongs to that run, whatever is drawn or opened meanwhile."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt, QTimer

from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_files import copy_of
from tests.stories.test_several_files import answer

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"


def choices(run: AtRun) -> tuple[str, ...]:
    transport = run.pane.transport
    return (transport.world.currentText(), transport.start.currentText(),
            transport.goal.currentText())  # fmt: skip


def title(person: Person) -> str:
    return person.window.menu_row.title


def held(sit: Sit, path: Path) -> AtRun:
    """A run that has carried out one operation and is paused."""
    run = AtRun(sit(path))
    run.person.press(Key.Key_F10)
    run.until_done(1)
    return run


def test_a_new_blueprint_in_a_run_changes_nothing_of_what_the_run_shows(sit: Sit) -> None:
    run = held(sit, HFSM)
    person, before, rows = run.person, choices(run), run.facts()
    person.ctrl(Key.Key_N)
    assert title(person) == "hfsm.json"
    assert person.window.windowTitle() == "hfsm.json · SMSL Studio"
    assert choices(run) == before
    assert run.facts() == rows
    assert "untitled.json is open in Draw mode now. This is the run of hfsm.json" in (
        run.pane.canvas.banner
    )
    person.ctrl(Key.Key_1)
    assert title(person) == "untitled.json"
    person.ctrl(Key.Key_3)
    assert title(person) == "hfsm.json"
    person.ctrl(Key.Key_2)
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert (title(person), choices(run)) == ("hfsm.json", before)
    assert not run.pane.transport.goal.isEnabled()
    assert run.active() == {"SB1": "State111", "SB2": "State1"}
    # It follows the run, and shows the SB in which it last saw an operation.
    canvas = run.pane.canvas
    assert canvas.canvas.marks.active == run.active()[canvas.branch]
    person.click(run.pane.canvas.to_drawing)
    assert title(person) == "untitled.json"
    assert run.phase == "No run"
    assert not run.pane.canvas.to_drawing.isVisible()
    assert run.pane.transport.goal.isEnabled()


def test_the_goal_of_a_run_stays_when_the_drawing_loses_it(sit: Sit) -> None:
    person = sit(HFSM)
    person.double_click_canvas(QPoint(120, person.window.canvas.height() - 60))
    person.type("State011")
    person.press(Key.Key_Return)
    run = AtRun(person)
    goal = run.pane.transport.goal
    (added,) = [goal.itemText(at) for at in range(goal.count()) if "011" in goal.itemText(at)]
    run.choose(goal=added)
    person.click(run.pane.transport.by_hand)
    person.press(Key.Key_F5)
    person.until(lambda: run.pane.run.status is not None)
    before = choices(run)
    person.ctrl(Key.Key_1)
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_2)
    assert choices(run) == before
    assert before[2] == added


def test_a_question_that_outlives_the_run_leaves_its_results(sit: Sit, tmp_path: Path) -> None:
    run = held(sit, copy_of("hfsm.json", tmp_path))
    person, window = run.person, run.person.window
    person.ctrl(Key.Key_1)
    person.double_click_canvas(QPoint(120, window.canvas.height() - 60))
    person.press(Key.Key_Return)
    person.ctrl(Key.Key_2)

    def end() -> None:
        window.features.run.pane.play()
        run.until_phase("Goal reached")
        answer(person, "Discard changes")

    QTimer.singleShot(50, window, end)
    person.ctrl(Key.Key_N)
    assert window.files.name == "untitled.json"
    assert (run.phase, title(person)) == ("Goal reached", "hfsm.json")
    assert run.facts()
    assert run.pane.timeline.lanes
    assert run.pane.events.count()


def behind(sit: Sit, tmp_path: Path) -> AtRun:
    """A run of hfsm.json is paused, and hanoi-2.json is open in Draw mode."""
    run = held(sit, copy_of("hfsm.json", tmp_path))
    run.person.ctrl(Key.Key_1)
    run.person.window.open_path(copy_of("hanoi-2.json", tmp_path))
    assert title(run.person) == "hanoi-2.json"
    return run


@pytest.mark.parametrize("key", [Key.Key_F5, Key.Key_F10])
def test_a_key_in_draw_asks_before_the_run_of_another_file_goes_on(
    sit: Sit, tmp_path: Path, key: Qt.Key
) -> None:
    run = behind(sit, tmp_path)
    person, told = run.person, list[str]()
    answer(person, "Cancel", told)
    person.press(key)
    assert "hfsm.json" in told[0]
    assert "hanoi-2.json" in told[0]
    assert (run.phase, person.window.mode) == ("Paused", "draw")
    person.come_back()
    answer(person, "Go on with hfsm.json")
    person.press(key)
    person.until(lambda: run.pane.run.status is not None and run.pane.run.status.operations > 1)
    assert person.window.mode == "run"


def test_a_run_that_ends_while_it_is_asked_begins_no_other(sit: Sit, tmp_path: Path) -> None:
    run = behind(sit, tmp_path)
    person = run.person

    def end() -> None:
        run.pane.play()
        run.until_phase("Goal reached")
        answer(person, "Go on with hfsm.json")

    QTimer.singleShot(50, person.window, end)
    person.press(Key.Key_F5)
    assert (run.phase, person.window.mode) == ("Goal reached", "draw")
    assert not run.pane.run.exists


def test_in_run_and_for_the_own_file_no_key_asks(sit: Sit, tmp_path: Path) -> None:
    run = held(sit, copy_of("hfsm.json", tmp_path))
    run.person.ctrl(Key.Key_1)
    run.person.press(Key.Key_F10)
    run.until_done(3)
    run.person.window.open_path(copy_of("hanoi-2.json", tmp_path))
    run.person.ctrl(Key.Key_2)
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")


def test_stop_asks_nothing_and_a_pause_says_of_which_run_it_was(sit: Sit, tmp_path: Path) -> None:
    run = behind(sit, tmp_path)
    person = run.person
    person.press(Key.Key_F6)
    assert "hfsm.json" in person.window.toast.words
    person.press(Key.Key_F8)
    run.until_phase("Stopped")


def test_the_badge_names_the_file_of_a_run_that_is_not_the_drawing(
    sit: Sit, tmp_path: Path
) -> None:
    run = held(sit, copy_of("hfsm.json", tmp_path))
    person, badge = run.person, run.person.window.mode_bar.phase
    person.ctrl(Key.Key_1)
    assert badge.text() == "Paused"
    person.window.open_path(copy_of("hanoi-2.json", tmp_path))
    assert badge.text() == "Paused: hfsm.json"
    assert badge.accessibleName() == "The run of hfsm.json: Paused"
    assert "hfsm.json" in badge.toolTip()
    person.window.resize(900, 800)
    person.until(lambda: badge.text() == "Paused")
    assert "hfsm.json" in badge.toolTip()


def test_the_outline_marks_no_state_that_is_no_longer_drawn(sit: Sit) -> None:
    run = held(sit, HFSM)
    person, tree = run.person, run.person.window.outline.tree
    active = dict(tree.active)
    sb, state = next(iter(active.items()))
    person.ctrl(Key.Key_1)
    person.select(f"{sb}/{state}")
    person.press(Key.Key_Delete)
    person.until(lambda: state not in person.blueprint[sb].table)
    person.until(lambda: sb not in tree.active)
    person.ctrl(Key.Key_Z)
    person.until(lambda: tree.active == active)
