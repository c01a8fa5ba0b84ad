"""The task card: an answer takes two acts, none is preset, and the next person sees nothing of
it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.dispatch.people.task import Answered, Option
from smsl_studio.runlog.events import TaskAnswered, TaskClosed
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.features.people.task_card import TaskCard
from smsl_studio.studio.features.people.who import Who
from smsl_studio.studio.running.persons import Person, Persons
from tests.front.views.test_card_view import TASK

BRANDT, OKAFOR = Person("L. Brandt", "supervisor"), Person("A. Okafor", "surgeon")
Show = Callable[..., TaskCard]
Key = Qt.Key


@pytest.fixture
def show(qtbot: QtBot, tmp_path: Path) -> Show:
    """A card at which these persons work, in a window of its own."""

    def shown(*people: Person) -> TaskCard:
        persons = Persons(Settings(tmp_path))
        for person in people:
            persons.put(person)
        card = TaskCard(persons, LIGHT)
        qtbot.addWidget(card)
        card.show_tasks((TASK,), 28.0)
        card.show()
        card.activateWindow()
        qtbot.waitUntil(card.isActiveWindow)
        return card

    return shown


def _said(card: TaskCard) -> list[tuple[str, str, str, str]]:
    found: list[tuple[str, str, str, str]] = []
    card.answered.connect(lambda *answer: found.append(answer))
    return found


def _press(widget: QWidget, key: Qt.Key) -> None:
    QTest.keyClick(QApplication.focusWidget() or widget, key)


def test_without_a_task_there_is_no_card(show: Show) -> None:
    card = show()
    assert card.isVisible()
    card.show_tasks((), 30.0)
    assert card.isHidden()
    assert card.card is None


def test_no_answer_is_chosen_and_the_button_waits_for_one(show: Show) -> None:
    card = show(BRANDT)
    assert not any(row.isChecked() for row in card.options)
    assert not card.answer.button.isEnabled()
    assert card.answer.button.text() == "Choose an answer"


def test_a_letter_chooses_and_enter_decides(show: Show, qtbot: QtBot) -> None:
    card = show(BRANDT)
    said = _said(card)
    card.take_focus()
    _press(card, Key.Key_D)
    assert [row.isChecked() for row in card.options] == [False, True, False]
    assert said == []
    assert card.answer.button.text() == "Digitise a landmark again: press Enter"
    _press(card, Key.Key_Return)
    assert said == [("task-1", "again", "L. Brandt", "supervisor")]


def test_escape_takes_a_choice_back_and_letters_choose_again(show: Show) -> None:
    card = show(BRANDT, OKAFOR)
    card.take_focus()
    _press(card, Key.Key_D)
    _press(card, Key.Key_Escape)
    assert not any(row.isChecked() for row in card.options)
    assert not card.answer.button.isEnabled()
    _press(card, Key.Key_I)
    _press(card, Key.Key_Return)
    assert card.hasFocus()
    assert card.answer.who.person is None
    _press(card, Key.Key_A)
    assert card.answer.who.person is None


def test_enter_on_a_row_chooses_and_one_enter_more_decides(show: Show) -> None:
    card = show(BRANDT)
    said = _said(card)
    card.take_focus()
    _press(card, Key.Key_Return)
    assert said == []
    assert card.options[0].isChecked()
    _press(card, Key.Key_Return)
    assert len(said) == 1


def test_the_next_person_sees_nothing_and_says_who_they_are(show: Show) -> None:
    card = show(BRANDT, OKAFOR)
    said = _said(card)
    card.press_letter("M")
    card.answer.button.click()
    assert len(said) == 1
    assert not any(row.isChecked() for row in card.options)
    assert card.answer.who.person is None
    card.show_tasks((replace(TASK, answered=(Answered("L. Brandt", "supervisor", 29.0),)),), 30.0)
    card.press_letter("I")
    assert not card.answer.button.isEnabled()
    assert card.answer.button.text() == "Say who you are"
    who = card.answer.who
    who.choice.activated.emit(who.choice.findText("A. Okafor, surgeon"))
    card.press_letter("I")
    card.answer.button.click()
    assert said[-1] == ("task-1", "no", "A. Okafor", "surgeon")


def test_one_who_has_a_pin_answers_only_with_it(show: Show) -> None:
    card = show(OKAFOR.with_pin("2468"))
    said = _said(card)
    card.press_letter("M")
    assert card.answer.button.text() == "Type your PIN"
    card.answer.who.pin.setText("2469")
    assert not card.answer.button.isEnabled()
    card.answer.who.pin.setText("2468")
    card.answer.button.click()
    assert said == [("task-1", "yes", "A. Okafor", "surgeon")]
    assert card.answer.who.pin.text() == ""


def test_a_letter_in_the_pin_chooses_nothing(show: Show) -> None:
    card = show(OKAFOR.with_pin("mmmm"))
    card.answer.who.pin.setFocus()
    QTest.keyClicks(card.answer.who.pin, "mmmm")
    assert not any(row.isChecked() for row in card.options)
    assert card.answer.who.pin.text() == "mmmm"


def test_an_answer_chosen_for_one_task_is_none_of_another(show: Show) -> None:
    card = show(BRANDT)
    other = replace(TASK, name="task-2", deadline=60.0, options=(Option("done", "Done", yes=True),))
    card.press_letter("M")
    card.show_tasks((other,), 31.0)
    assert not any(row.isChecked() for row in card.options)
    assert not card.answer.button.isEnabled()


def test_another_task_does_not_replace_a_card_that_is_in_use(show: Show) -> None:
    """A more urgent task waits in the queue while this one is open."""
    card = show(BRANDT)
    card.press_letter("M")
    urgent = replace(TASK, name="task-2", deadline=40.0)
    card.show_tasks((TASK, urgent), 31.0)
    assert card.card is not None
    assert card.card.task == "task-1"
    assert card.options[0].isChecked()
    card.show_tasks((urgent,), 32.0)
    assert card.card.task == "task-2"


def test_how_it_ended_stays_until_it_is_dismissed(show: Show) -> None:
    card = show(BRANDT)
    card.tell((TaskClosed(t=31.0, task="task-1", outcome="timed_out"),))
    card.show_tasks((), 31.0)
    assert card.isVisible()
    assert card.frame.isHidden()
    assert card.lines.words == (
        "Match patient and scan now? Nobody answered in time. This is no yes.",
    )
    late = TaskAnswered(t=32.0, task="task-1", by="L. Brandt", role="", refused="it is too late")
    card.tell((late,))
    assert "does not count: it is too late" in card.lines.words[0]
    card.lines.rows[0].close_button.click()
    assert card.isHidden()


def test_both_themes_can_be_worn(show: Show) -> None:
    card = show(BRANDT)
    card.tell((TaskClosed(t=31.0, task="task-9", outcome="answered", answers={"A": "Done"}),))
    card.set_tokens(DARK)
    assert not card.grab().isNull()


def test_who_may_not_answer_is_led_to_the_choice_of_persons(show: Show) -> None:
    card = show(Person("N. Kaya", "nurse"), OKAFOR)
    card.show_tasks((replace(TASK, roles=("surgeon",), answered=()),), 28.0)
    assert card.card is not None
    assert card.card.objection
    assert card.answer.button.text() == "Say who you are"
    card.take_focus()
    assert card.answer.who.choice.hasFocus()
    _press(card, Key.Key_Down)
    card.take_focus()
    assert card.options[0].hasFocus(), "who may answer is led to the answers"


def test_who_enters_the_first_name_answers_under_it(qtbot: QtBot, tmp_path: Path) -> None:
    persons = Persons(Settings(tmp_path))
    who = Who(persons)
    qtbot.addWidget(who)
    assert who.person == Person("a person", "")
    persons.put(OKAFOR)
    assert who.person == OKAFOR
    persons.put(BRANDT)
    assert who.person == OKAFOR
    who.ask_again()
    persons.put(Person("N. Kaya", "nurse"))
    assert who.person is None, "who is asked to say so is asked until then"


def test_after_an_answer_is_chosen_the_keys_go_to_the_pin_that_is_asked(show: Show) -> None:
    card = show(OKAFOR.with_pin("1234"))
    said = _said(card)
    card.take_focus()
    _press(card, Key.Key_M)
    assert card.answer.who.pin.hasFocus()
    QTest.keyClicks(card.answer.who.pin, "1234")
    _press(card, Key.Key_Return)
    assert not said, "the PIN is no decision yet"
    _press(card, Key.Key_Return)
    assert [one[2] for one in said] == ["A. Okafor"]


def test_the_enter_that_ends_a_pin_reaches_nothing_around_the_card(
    show: Show, qtbot: QtBot
) -> None:
    """Supervise presses the button that has the focus on Enter: that would decide at once."""
    heard: list[int] = []

    class Around(QWidget):
        def keyPressEvent(self, event: QKeyEvent) -> None:
            heard.append(event.key())

    card = show(OKAFOR.with_pin("1234"))
    around = Around()
    qtbot.addWidget(around)
    QVBoxLayout(around).addWidget(card)
    around.show()
    around.activateWindow()
    qtbot.waitUntil(around.isActiveWindow)
    card.take_focus()
    _press(card, Key.Key_M)
    QTest.keyClicks(card.answer.who.pin, "1234")
    QTest.keyClick(card.answer.who.pin, Key.Key_Return)
    assert card.answer.button.hasFocus()
    assert Key.Key_Return not in heard
