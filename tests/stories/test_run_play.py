"""Run mode: play, step, pause and stop, and what is shown meanwhile."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QDialog, QToolButton

from smsl_studio import front
from smsl_studio.runlog.events import Commanded
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, sample

Key = Qt.Key
HFSM, REGISTRATION = SAMPLES / "hfsm.json", SAMPLES / "registration.json"
HANOI = SAMPLES / "hanoi-corrected.json"


def test_play_reaches_the_goal_and_shows_the_way(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    assert run.phase == "No run"
    person.click(run.pane.transport.play)
    run.until_phase("Goal reached")
    assert run.active() == {"SB1": "State111", "SB2": "State1"}
    run.pane.canvas.show_branch("SB1")
    marks = run.pane.canvas.canvas.marks
    assert marks.active == "State111"
    assert marks.visited == {"State000", "State100"}
    assert [str(a) for a in marks.trail] == [
        "SB1/State000/Operation000",
        "SB1/State100/Operation100B",
    ]
    assert run.pane.facts.facts.rows[0].group
    assert ("Fact 1", "1", "1", "", "agrees") in run.facts(), "nothing of what is over has an age"
    assert [lane.label for lane in run.pane.timeline.lanes][:3] == ["SB1", "SB2", "Operation"]
    assert person.window.outline.tree.active == run.active()
    assert "World table | Seed 0" in person.window.status_line.words
    said = [run.pane.events.item(at).text() for at in range(run.pane.events.count())]
    assert any("Goal SB1/State111 reached" in line for line in said)


def test_step_carries_out_one_operation_and_time_stands_still(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    person.press(Key.Key_F10)
    run.until_done(1)
    assert run.phase == "Paused"
    assert run.active() == {"SB1": "State100", "SB2": "State0"}
    assert run.pane.canvas.canvas.marks.next_states == {"State111"}
    before = run.pane.run.time
    person.click(run.pane.transport.step)
    run.until_phase("Paused")
    person.qtbot.waitUntil(lambda: run.active()["SB1"] == "State111")
    assert run.pane.run.time > before
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")


def test_play_before_the_world_of_a_step_stands_goes_on_after_it(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    person.press(Key.Key_F10)
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    said = [event for event in run.events if isinstance(event, Commanded)]
    assert [(event.command, event.refused) for event in said] == [("step", ""), ("resume", "")]


def test_play_while_a_step_is_carried_out_goes_on_after_it(sit: Sit) -> None:
    person = sit(HANOI)
    run = AtRun(person)
    run.as_fast_as_it_goes()
    person.press(Key.Key_F10)
    run.until_runs()
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    said = [event for event in run.events if isinstance(event, Commanded)]
    assert [(event.command, event.refused) for event in said] == [("step", ""), ("resume", "")]


def test_a_pause_calls_off_the_play_that_came_before_it(sit: Sit) -> None:
    person = sit(HANOI)
    run = AtRun(person)
    person.press(Key.Key_F10)
    run.until_runs()
    person.press(Key.Key_F5)
    person.press(Key.Key_F6)
    run.until_phase("Paused")
    assert run.pane.run.status is not None
    assert run.pane.run.status.running is not None
    assert not run.pane.run.pausing


def test_pause_and_stop_by_their_keys(sit: Sit) -> None:
    person = sit(HANOI)
    run = AtRun(person)
    assert run.pane.transport.world.currentText() == "hanoi"
    person.press(Key.Key_F5)
    run.until_runs()
    person.press(Key.Key_F6)
    run.until_phase("Paused")
    stood = run.pane.run.status
    assert stood is not None
    assert stood.running is not None
    assert run.pane.canvas.canvas.marks.running is not None
    person.press(Key.Key_F5)
    run.until_phase("Running")
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    assert run.pane.run.exists
    assert run.pane.transport.play.text() == "Reset"
    person.press(Key.Key_F5)
    assert run.pane.possible.asking.words.startswith("Reset?")
    person.press(Key.Key_Escape)
    person.press(Key.Key_F5)
    person.press(Key.Key_Return)
    run.until_phase("Paused")
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    run.pane.run.end()
    person.qtbot.waitUntil(lambda: not run.pane.run.exists)
    assert run.phase == "Ended: stopped"
    # What was read last stands there, and claims no age.
    assert [row.sensed for row in run.pane.facts.facts.rows]
    assert {row.age for row in run.pane.facts.facts.rows} == {None}


def test_stop_is_there_in_every_mode_and_from_a_dialog(sit: Sit) -> None:
    person = sit(HANOI)
    window = person.window
    run = AtRun(person)
    place = run.pane.transport.stop.geometry()
    assert (place.width(), place.height()) == (136, 40)
    person.press(Key.Key_F5)
    run.until_runs()
    assert run.pane.transport.stop.isVisible()
    person.ctrl(Key.Key_1)
    assert window.mode_bar.stop.isVisible()
    assert window.mode_bar.stop.isEnabled()
    window.show_shortcuts()
    dialog = window.findChild(QDialog)
    assert dialog is not None
    person.qtbot.waitUntil(dialog.isActiveWindow)
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    assert dialog.isVisible()
    dialog.close()
    assert window.mode_bar.stop.isVisible(), run.pane.run.sentence
    run.pane.run.end()
    person.qtbot.waitUntil(lambda: not window.mode_bar.stop.isVisible())


def test_the_drawing_moves_on_and_the_run_keeps_its_version(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    person.press(Key.Key_F10)
    run.until_done(1)
    assert run.pane.canvas.banner == ""
    person.ctrl(Key.Key_1)
    person.double_click_canvas(QPoint(120, person.window.canvas.height() - 60))
    person.type("State011")
    person.press(Key.Key_Return)
    added = set(person.blueprint["SB1"].table) - set(sample("hfsm.json")["SB1"].table)
    assert len(added) == 1
    person.ctrl(Key.Key_2)
    assert "The drawing has moved on" in run.pane.canvas.banner
    assert not added & set(run.pane.canvas.canvas.positions)
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert "These are the results of the version that ran" in run.pane.canvas.banner
    assert not added & set(run.pane.canvas.canvas.positions)
    person.click(run.pane.canvas.to_drawing)
    assert run.pane.canvas.banner == ""
    run.pane.canvas.show_branch("SB1")
    assert added <= set(run.pane.canvas.canvas.positions)
    assert person.window.session.edited


def test_another_file_is_not_shown_with_the_run_of_the_last(sit: Sit) -> None:
    person = sit(HFSM)
    run = AtRun(person)
    person.click(run.pane.transport.play)
    run.until_phase("Goal reached")
    assert person.window.files.open_copy(HANOI)
    assert run.phase == "No run"
    assert not run.facts()
    assert not run.pane.timeline.lanes
    assert not run.pane.events.count()
    assert not person.window.outline.tree.active
    person.click(run.pane.transport.step)
    run.until_done(1)
    assert person.window.outline.tree.active
    assert person.window.files.open_copy(HFSM)
    assert run.phase == "Paused"
    assert not person.window.outline.tree.active


def test_long_names_are_read_whole_where_there_is_room(sit: Sit) -> None:
    person = sit(SAMPLES / "three-roots.json")
    run = AtRun(person)
    person.click(run.pane.transport.play)
    run.until_phase("Goal reached")
    person.window.resize(1920, 1080)
    person.until(lambda: run.pane.facts.columnWidth(0) > 110)
    wide = [button.text() for button in run.pane.canvas.findChildren(QToolButton)]
    assert "ROBOT  11" in wide
    person.window.resize(1280, 800)
    person.until(lambda: run.pane.facts.columnWidth(0) < 110)
    narrow = [button.text() for button in run.pane.canvas.findChildren(QToolButton)]
    assert "ROBOT" in narrow


def test_the_window_tells_the_same_story_as_a_headless_run(sit: Sit) -> None:
    person = sit(REGISTRATION)
    run = AtRun(person)
    run.as_fast_as_it_goes()
    person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    read = front.read(REGISTRATION)
    headless = front.run(read, "registration", goal="State_1111", start="State_0000")
    assert [e.line() for e in run.events] == [e.line() for e in headless.events]
