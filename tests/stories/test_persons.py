"""Who works here: persons are named in a dialog, and later commands carry their name."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.runlog.events import Commanded
from smsl_studio.studio.features.people.persons_dialog import PersonsDialog
from smsl_studio.studio.running import persons
from tests.stories.at_tasks import AtTasks, asking
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_window import check_named, check_whole

Key = Qt.Key


def _open(person: Person) -> PersonsDialog:
    """Open the dialog from its row in the table of actions."""
    person.window.actions_table["persons"].trigger()
    person.until(lambda: bool(_dialogs(person)))
    (dialog,) = _dialogs(person)
    dialog.activateWindow()
    person.until(dialog.isActiveWindow)
    return dialog


def _dialogs(person: Person) -> list[PersonsDialog]:
    return [one for one in person.window.findChildren(PersonsDialog) if one.isVisible()]


def test_a_person_is_named_by_keyboard_and_stops_a_run_in_that_name(
    sit: Sit, tmp_path: Path
) -> None:
    person = sit(asking(tmp_path, go={"actor": "human"}), (1280, 800))
    room = AtTasks(person)
    dialog = _open(person)
    for name, role in (("L. Brandt", "supervisor"), ("A. Okafor", "surgeon")):
        dialog.new_name.setFocus()
        QTest.keyClicks(dialog.new_name, name)
        QTest.keyClick(dialog.new_name, Key.Key_Tab)
        assert dialog.new_role.hasFocus()
        QTest.keyClicks(dialog.new_role, role)
        QTest.keyClick(dialog.new_role, Key.Key_Return)
    person.until(lambda: len(dialog.rows) == 2)
    assert dialog.isVisible(), "Enter adds a person and closes nothing"
    for widget in dialog.findChildren(QWidget):
        if widget.isVisible():
            check_named(widget)
            check_whole(widget)

    # The second person works here from now on, and locks the name with a PIN.
    person.click(dialog.rows[1].mine)
    person.click(dialog.rows[1].pin_button)
    row = dialog.rows[1]
    assert row.new.hasFocus()
    for field in (row.new, row.again):
        QTest.keyClicks(field, "2468")
    QTest.keyClick(row.again, Key.Key_Return)
    person.until(lambda: dialog.rows[1].pin_button.text() == "Unlock")
    assert dialog.rows[1].mine.isChecked()
    QTest.keyClick(dialog, Key.Key_Escape)
    person.until(lambda: not _dialogs(person))
    person.window.activateWindow()
    person.until(person.window.isActiveWindow)

    room.start()
    room.until_asked("go: please carry it out")
    assert person.window.features.supervise.pane.bar.person == "A. Okafor"
    person.press(Key.Key_F8)
    person.until(lambda: any(isinstance(e, Commanded) for e in room.events))
    (stop,) = [e for e in room.events if isinstance(e, Commanded)]
    assert (stop.command, stop.by) == ("stop", "A. Okafor")


def test_close_takes_over_who_is_typed_and_says_what_it_cannot(sit: Sit) -> None:
    person = sit()
    dialog = _open(person)
    person.click(dialog.new_name)
    QTest.keyClicks(dialog.new_name, "L. Brandt")
    person.click(dialog.new_role)
    QTest.keyClicks(dialog.new_role, "surgeon")
    person.click(_close(dialog))
    assert not dialog.isVisible()
    assert [one.words for one in person.windows.persons.all] == ["L. Brandt, surgeon"]

    # A name that is taken is said, and stays until it is another one or Close is pressed again.
    again = _open(person)
    person.click(again.new_name)
    QTest.keyClicks(again.new_name, "L. Brandt")
    person.click(_close(again))
    assert again.isVisible()
    assert "already" in again.refusal.text()
    again.new_name.selectAll()
    QTest.keyClicks(again.new_name, "A. Okafor")
    person.click(_close(again))
    assert not again.isVisible()
    assert [one.name for one in person.windows.persons.all] == ["L. Brandt", "A. Okafor"]

    # A PIN that is typed once is no PIN yet; typed twice it is kept.
    third = _open(person)
    row = third.rows[0]
    person.click(row.pin_button)
    QTest.keyClicks(row.new, "2468")
    person.click(_close(third))
    assert third.isVisible()
    assert "differ" in row.refusal.text()
    QTest.keyClicks(row.again, "2468")
    person.click(_close(third))
    assert not third.isVisible()
    first = person.windows.persons.all[0]
    assert first.has_pin
    assert first.opens_with("2468")

    # What nobody can take over does not hold a person in the dialog.
    last = _open(person)
    QTest.keyClicks(last.new_role, "nurse")
    person.click(_close(last))
    assert last.isVisible()
    person.click(_close(last))
    assert not last.isVisible()
    assert len(person.windows.persons.all) == 2


def _close(dialog: PersonsDialog) -> QPushButton:
    (found,) = (one for one in dialog.findChildren(QPushButton) if one.text() == "Close")
    return found


def test_what_the_next_run_cannot_ask_for_is_told_before_it_begins(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-people.json")
    person.ctrl(Qt.Key.Key_2)
    canvas = person.window.features.run.pane.canvas
    assert "ask for nurse and surgeon, and nobody with this role" in canvas.banner
    person.windows.persons.put(persons.Person("L. Brandt", "nurse"))
    person.windows.persons.put(persons.Person("A. Okafor", "Surgeon"))
    assert canvas.banner == ""
