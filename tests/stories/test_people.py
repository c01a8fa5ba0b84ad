"""People in the loop: two who must agree, one who is late, levels that are set before a run."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.runlog.events import Commanded, TaskAnswered
from smsl_studio.studio.features.people.persons_dialog import PersonsDialog
from smsl_studio.studio.running.persons import Person as Named
from tests.stories.at_tasks import NURSE, SURGEON, AtTasks, asking
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_window import check_named, check_whole

Key = Qt.Key
TWO = {"confirm": ["surgeon", "nurse"], "title": "Drill"}
MAY_BEGIN = "Drill: may it begin?"


def test_two_persons_agree_and_the_run_goes_on(sit: Sit, tmp_path: Path) -> None:
    room = AtTasks(sit(asking(tmp_path, go=TWO)), NURSE, SURGEON)
    room.start()
    room.until_asked(MAY_BEGIN)
    room.until_phase("waiting")
    assert not any(row.isChecked() for row in room.card.options)
    assert not room.card.answer.button.isEnabled()

    # The nurse works here: a letter chooses, Enter decides.
    room.person.press(Key.Key_C)
    assert room.card.options[0].isChecked()
    assert not [e for e in room.events if isinstance(e, TaskAnswered)]
    room.person.press(Key.Key_Return)
    room.person.until(lambda: any(p.answered for p in room.shown.persons))
    assert [p.name for p in room.shown.persons] == ["", "L. Brandt"]
    assert not any(row.isChecked() for row in room.card.options)
    assert room.active() == {"SB": "State_0"}

    # The surgeon takes the seat and says who they are.
    assert room.card.answer.button.text() == "Say who you are"
    room.answer_as(SURGEON)
    room.choose("Confirm")
    room.decide()
    room.until_said("agreed: Confirm")
    room.until_phase("goal_reached")
    assert room.outcomes == ["answered"]
    by = {e.by: e.role for e in room.events if isinstance(e, TaskAnswered) and not e.refused}
    assert by == {"L. Brandt": "nurse", "A. Okafor": "surgeon"}


def test_answers_that_differ_are_no_yes(sit: Sit, tmp_path: Path) -> None:
    room = AtTasks(sit(asking(tmp_path, go=TWO)), NURSE, SURGEON.with_pin("2468"))
    room.start()
    room.until_asked(MAY_BEGIN)
    room.choose("Confirm")
    room.decide()
    room.person.until(lambda: any(p.answered for p in room.shown.persons))
    room.answer_as(SURGEON, pin="2468")
    room.choose("Do not begin")
    room.decide()
    room.until_said("The answers differ")
    (line,) = room.words
    assert "L. Brandt: Confirm" in line
    assert "A. Okafor: Do not begin" in line
    room.until_phase("fault_hold")
    assert room.active() == {"SB": "State_0"}
    room.person.click(room.card.lines.rows[0].close_button)
    assert room.card.isHidden()


def test_time_runs_out_it_is_no_yes_and_a_late_answer_is_refused(sit: Sit, tmp_path: Path) -> None:
    notes = {"actor": "human", "question": "Fix the head", "answer_within": 20,
             "escalates_to": "surgeon"}  # fmt: skip
    room = AtTasks(sit(asking(tmp_path, go=notes)), NURSE)
    room.person.window.features.run.pane.transport.speed.setCurrentText("Max")
    room.start()
    room.until_said("Fix the head Nobody answered in time. This is no yes.")
    room.until_phase("fault_hold")
    assert "task_escalated" in [event.event for event in room.events]
    assert room.active() == {"SB": "State_0"}
    assert room.card.frame.isHidden()
    # The hand was faster than the eye: the answer comes when the task is over.
    room.run.answer("task-1", "done", "nurse", by="L. Brandt")
    room.until_said("The answer of L. Brandt does not count: it is too late")
    assert room.active() == {"SB": "State_0"}
    refused = [e for e in room.events if isinstance(e, Commanded) and e.refused]
    assert refused[-1].by == "L. Brandt"


def test_a_task_is_in_sight_in_every_mode_and_one_key_leads_to_it(sit: Sit, tmp_path: Path) -> None:
    room = AtTasks(sit(asking(tmp_path, go={"actor": "human", "question": "Fix it"})), NURSE)
    badge, window = room.people.badge, room.person.window
    room.start()
    room.until_asked("Fix it")
    assert badge.isHidden()
    stop = window.mode_bar.stop
    for key, mode in ((Key.Key_1, "draw"), (Key.Key_2, "run")):
        room.person.ctrl(key)
        assert window.mode == mode
        assert badge.isVisible()
        assert badge.text() == "Your decision is needed"
        assert stop.isVisible() or window.features.run.pane.transport.stop.isVisible()
    room.person.press(Key.Key_F4)
    assert window.mode == "supervise"
    assert badge.isHidden()
    assert room.card.options[0].hasFocus()
    assert not any(row.isChecked() for row in room.card.options)
    room.person.press(Key.Key_D)
    room.person.press(Key.Key_Return)
    room.until_phase("goal_reached")


def test_letters_command_and_choose_nobody_while_the_choice_of_persons_has_the_keys(
    sit: Sit, tmp_path: Path
) -> None:
    surgeon_only = {"confirm": ["surgeon"], "title": "Drill"}
    room = AtTasks(sit(asking(tmp_path, go=surgeon_only)), NURSE, Named("Sun", "surgeon"))
    room.start()
    room.until_asked(MAY_BEGIN)
    room.person.press(Key.Key_F4)
    who = room.card.answer.who
    assert who.choice.hasFocus(), "a nurse may not answer this: the choice of persons has the keys"
    before = who.choice.currentText()
    room.person.press(Key.Key_S)
    assert who.choice.currentText() == before
    room.person.press(Key.Key_V)
    assert room.person.window.features.supervise.pane.step_in.asking.isVisible(), (
        "V asks for a veto"
    )
    assert who.choice.currentText() == before


def test_levels_set_before_the_run_are_obeyed_and_stay_as_they_were(
    sit: Sit, tmp_path: Path
) -> None:
    room = AtTasks(sit(asking(tmp_path)), NURSE)
    continuum = room.people.continuum
    assert continuum.rows[0].view.words == "4 automatic"
    room.person.click(continuum.edit)
    editor = room.people.editor
    assert editor is not None
    editor.search.setText("go operation")
    editor.table.selectAll()
    room.person.click(editor.buttons["human"])
    room.person.click(editor.use_button)
    assert continuum.rows[0].view.words == "1 of 4 human"
    assert "1 level set for the next run" in continuum.note.text()
    assert room.person.steps() == []

    room.start()
    room.until_asked("go: please carry it out")
    assert continuum.note.text() == (
        "Levels were set before the run and are part of its record. "
        "Where nobody is named as acting, it counts as automatic."
    )
    assert not continuum.edit.isEnabled()
    assert not room.person.window.actions_table["levels"].isEnabled()
    room.choose("Done")
    room.decide()
    room.until_phase("goal_reached")
    assert continuum.edit.isEnabled()


def test_who_works_here_is_in_the_record_of_every_command(sit: Sit, tmp_path: Path) -> None:
    room = AtTasks(sit(asking(tmp_path, go={"actor": "human"})), NURSE)
    room.start()
    room.until_asked("go: please carry it out")
    room.person.press(Key.Key_F8)
    room.person.until(lambda: any(isinstance(e, Commanded) for e in room.events))
    (stop,) = [e for e in room.events if isinstance(e, Commanded)]
    assert (stop.command, stop.by) == ("stop", "L. Brandt")
    room.person.until(lambda: room.card.card is None)
    assert room.outcomes == ["withdrawn"]


def test_a_letter_typed_into_a_reason_chooses_no_answer(sit: Sit, tmp_path: Path) -> None:
    room = AtTasks(sit(asking(tmp_path, go={"actor": "human"})), NURSE.with_pin("dddd"))
    room.start()
    room.until_asked("go: please carry it out")
    room.person.click(room.card.answer.who.pin)
    QTest.keyClicks(room.card.answer.who.pin, "dddd")
    assert not any(row.isChecked() for row in room.card.options)
    room.choose("Done")
    assert room.card.answer.button.isEnabled()


def test_a_person_accepts_what_inspection_found_before_anything_moves(
    sit: Sit, tmp_path: Path
) -> None:
    room = AtTasks(sit(asking(tmp_path)), SURGEON)
    room.people.levels.put({"inspection": "human", "supervision": "human"})
    room.start()
    room.until_asked("Shall the run start?")
    assert room.active() in ({}, {"SB": "State_0"})
    assert "operation_started" not in [event.event for event in room.events]
    room.choose("Start")
    room.decide()
    room.until_asked("go: shall it begin?")
    room.choose("Go on")
    room.decide()
    room.until_asked("on: shall it begin?")
    room.choose("Pause the run")
    room.decide()
    room.until_phase("paused")
    assert room.active() == {"SB": "State_1"}


def tall(tmp_path: Path) -> Path:
    """A file in which people are asked more than a window is high."""
    values = {str(n): f"Answer {n}, of which there is a lot to say " * 2 for n in range(8)}
    facts = {"0": {"values": values, "aggregation": "human", "question": "How is it? " * 20}}
    return asking(tmp_path, facts=facts)


def test_give_back_is_in_view_while_people_are_asked(sit: Sit) -> None:
    room = AtTasks(sit(SAMPLES / "registration-people.json", (1440, 900)), NURSE)
    room.start()
    room.until_asked("Is the head fixed in the clamp?")
    supervise = room.person.window.features.supervise.pane
    supervise.setFocus()
    room.person.press(Key.Key_T)
    room.person.press(Key.Key_Return)
    room.until_phase("taken_over")
    supervise.setFocus()
    room.person.press(Key.Key_T)
    room.person.press(Key.Key_Return)
    room.person.until(lambda: room.card.card is not None)
    supervise.setFocus()
    room.person.press(Key.Key_T)
    asking = supervise.step_in.asking
    room.person.until(lambda: asking.isVisible() and room.card.isVisible())
    for part in (supervise.step_in.hand, *asking.findChildren(QPushButton)):
        assert part.visibleRegion().boundingRect() == part.rect(), part.text()


def test_a_card_without_persons_has_a_button_that_leads_to_them(sit: Sit) -> None:
    room = AtTasks(sit(SAMPLES / "registration-people.json", (1280, 800)))
    room.start()
    room.until_asked("Is the head fixed in the clamp?")
    enter = room.card.answer.enter
    room.person.until(lambda: enter.visibleRegion().boundingRect() == enter.rect())
    room.person.click(enter)
    (dialog,) = room.person.window.findChildren(PersonsDialog)
    assert dialog.isVisible()
    room.person.windows.persons.put(NURSE)
    room.person.until(lambda: not enter.isVisible())
    dialog.close()


def test_a_tall_card_shows_its_button_before_and_after_a_choice(sit: Sit, tmp_path: Path) -> None:
    room = AtTasks(sit(tall(tmp_path), (1280, 800)), NURSE)
    room.start()
    room.person.until(lambda: room.card.card is not None)
    button = room.card.answer.button
    # The question scrolls by itself; the button that decides stays in view.
    room.person.until(lambda: not button.visibleRegion().isEmpty())
    room.person.press(Key.Key_A)
    room.person.until(button.hasFocus)
    assert not button.visibleRegion().isEmpty()


def test_everything_of_a_card_can_be_read_at_1280(sit: Sit) -> None:
    room = AtTasks(sit(SAMPLES / "registration-people.json", (1280, 800)), NURSE)
    room.start()
    room.until_asked("Is the head fixed in the clamp?")
    window = room.person.window
    room.person.until(lambda: window.size().width() == 1280)
    for widget in (*room.card.findChildren(QWidget), *room.people.continuum.findChildren(QWidget)):
        if widget.isVisible():
            check_named(widget)
            check_whole(widget)
    assert room.people.continuum.width() >= room.people.continuum.minimumSizeHint().width()


def test_why_a_run_holds_is_said_once(sit: Sit, tmp_path: Path) -> None:
    notes = {"confirm": ["nurse"], "title": "Drill", "answer_within": 0.5}
    room = AtTasks(sit(asking(tmp_path, go=notes)), NURSE)
    room.start()
    room.until_phase("fault_hold")
    supervise = room.person.window.features.supervise.pane
    assert "within 0.5 s" in room.run.sentence
    room.person.until(supervise.hold.isVisible)
    assert supervise.step_in.refusal == ""


def test_enter_decides_while_the_choice_of_the_person_has_the_focus(
    sit: Sit, tmp_path: Path
) -> None:
    room = AtTasks(sit(asking(tmp_path, go={"actor": "human"})), NURSE, SURGEON)
    room.start()
    room.until_asked("go: please carry it out")
    who = room.card.answer.who
    room.person.click(who.choice)
    view = who.choice.view()
    room.person.until(view.isVisible)
    QTest.keyClick(view, Key.Key_Escape)
    who.choice.setFocus()
    room.person.press(Key.Key_Return)
    assert room.card.card is not None, "without an answer Enter decides nothing"
    room.choose("Done")
    room.answer_as(SURGEON)
    who.choice.setFocus()
    assert room.card.answer.button.text() == "Done: press Enter"
    room.person.press(Key.Key_Return)
    room.until_said("A. Okafor: Done.")


def test_enter_after_a_letter_never_changes_the_answer_that_it_chose(sit: Sit) -> None:
    room = AtTasks(sit(SAMPLES / "registration-people.json"))
    room.start()
    room.until_asked("Is the head fixed in the clamp?")
    for one in (NURSE, SURGEON):
        room.person.windows.persons.put(one)
    room.card.answer.who.ask_again()
    answers = room.card.answers
    first, second = answers.rows[:2]
    assert room.card.answer.who.person is None
    first.setFocus()
    room.person.type(second.option.letter.lower())
    assert answers.chosen == second.option
    room.person.press(Key.Key_Return)
    assert answers.chosen == second.option, "the focus had stayed on the first row"
    assert room.card.answer.who.choice.hasFocus()
