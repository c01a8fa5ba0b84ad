"""Everything shown around a run belongs to that run, whatever is drawn or opened meanwhile."""

from __future__ import annotations

from pathlib import Path

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
