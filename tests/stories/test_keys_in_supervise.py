"""In Supervise, keys act wherever no text is typed, also if the focused widget is gone."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QLineEdit, QWidget

from tests.stories.at_run import AtRun
from tests.stories.at_supervise import AtSupervise
from tests.stories.at_tasks import NURSE, SURGEON, AtTasks, asking
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HFSM, HANOI = SAMPLES / "hfsm.json", SAMPLES / "hanoi.json"


def focus() -> QWidget:
    found = QApplication.focusWidget()
    assert found is not None, "no widget has the keys"
    return found


def test_keys_act_after_a_run_has_ended_under_a_question(sit: Sit) -> None:
    at = AtSupervise(sit(HFSM))
    at.start_paused()
    at.press(Key.Key_1, Key.Key_P)
    assert at.pane.step_in.asking.reason.hasFocus()
    at.press(Key.Key_F5)
    at.until_phase("Goal reached")
    assert focus() is at.pane
    at.press(Key.Key_F10)
    at.until_phase("Paused")
    assert focus() is at.pane
    for key, words in ((Key.Key_1, "Carry out"), (Key.Key_V, "Veto"), (Key.Key_P, "Prune"),
                       (Key.Key_T, "Take over")):  # fmt: skip
        at.press(key)
        assert at.asked.startswith(words)
        at.press(Key.Key_Escape)
        assert at.asked == ""
        assert at.person.window.mode == "supervise"
    at.press(Key.Key_Space)
    assert at.person.window.mode == "supervise"


def test_keys_act_on_every_stop_of_tab_but_in_a_field(sit: Sit) -> None:
    at = AtSupervise(sit(HFSM))
    at.start_paused()
    stops: list[QWidget] = []
    while focus() not in stops:
        stops.append(focus())
        if not isinstance(focus(), QLineEdit):
            for key, words in ((Key.Key_P, "Prune"), (Key.Key_1, "Carry out")):
                at.press(key)
                assert at.asked.startswith(words), focus().accessibleName()
                at.press(Key.Key_Escape)
                assert at.asked == ""
            stops[-1].setFocus()
        at.press(Key.Key_Tab)
    segments = at.person.window.mode_bar.segments
    assert any(segments.isAncestorOf(one) for one in stops), "the bar is among them"
    assert any(card in stops for card in at.pane.board.cards)


def test_after_a_question_the_keys_are_never_left_on_a_mode_button(sit: Sit) -> None:
    at = AtSupervise(sit(HFSM))
    at.start_paused()
    segments = at.person.window.mode_bar.segments
    while not segments.isAncestorOf(focus()):
        at.press(Key.Key_Tab)
    at.press(Key.Key_V, Key.Key_Escape)
    assert focus() is at.pane


def test_keys_act_when_the_choice_of_persons_has_gone_with_its_card(
    sit: Sit, tmp_path: Path
) -> None:
    room = AtTasks(sit(asking(tmp_path, go={"confirm": ["surgeon"], "title": "Drill"})), NURSE,
                   SURGEON)  # fmt: skip
    room.start()
    room.until_asked("Drill: may it begin?")
    room.card.answer.who.choice.setFocus()
    room.person.press(Key.Key_F8)
    room.until_phase("stopped")
    room.person.until(lambda: not room.card.frame.isVisible())
    assert focus() is room.person.window.features.supervise.pane


def run_with_a_question(person: Person) -> AtRun:
    """In Run, a person is about to write why they prune."""
    run = AtRun(person)
    run.choose(world="table")
    person.press(Key.Key_F10)
    run.until_done(1)
    possible = run.pane.possible
    possible.list.prune_wanted.emit(person.window.features.run.pane.run.status.route[0])  # type: ignore[union-attr]
    assert possible.asking.reason.hasFocus()
    return run


def test_in_run_the_canvas_has_the_keys_when_a_question_goes(sit: Sit) -> None:
    person = sit(HANOI)
    run = run_with_a_question(person)
    canvas = run.pane.canvas.canvas
    person.press(Key.Key_Escape)
    assert focus() is canvas
    run.pane.possible.list.prune_wanted.emit(run.pane.run.status.route[0])  # type: ignore[union-attr]
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    person.until(lambda: not run.pane.possible.asking.isVisible())
    assert focus() is canvas


def test_the_board_has_the_keys_when_why_a_run_holds_has_gone(sit: Sit) -> None:
    at = AtSupervise(sit(HFSM))
    at.start_paused()
    at.press(Key.Key_F8)
    at.until_phase("Stopped")
    (reset, *_) = at.pane.hold.buttons()
    reset.setFocus()
    at.press(Key.Key_Return, Key.Key_Return)
    at.until_phase("Paused")
    assert focus() is at.pane
    at.press(Key.Key_1)
    assert at.asked.startswith("Carry out")
