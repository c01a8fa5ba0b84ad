"""The dialog of persons: typed values count at once, or are refused with a reason."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.features.people.persons_dialog import PersonsDialog
from smsl_studio.studio.running.persons import Person, Persons


@pytest.fixture
def persons(tmp_path: Path) -> Persons:
    return Persons(Settings(tmp_path))


@pytest.fixture
def dialog(qtbot: QtBot, persons: Persons) -> PersonsDialog:
    made = PersonsDialog(persons)
    qtbot.addWidget(made)
    made.show()
    return made


def _add(dialog: PersonsDialog, name: str, role: str = "") -> None:
    dialog.new_name.setText(name)
    dialog.new_role.setText(role)
    dialog.add.click()


def test_persons_are_added_chosen_renamed_and_removed(
    dialog: PersonsDialog, persons: Persons
) -> None:
    _add(dialog, " L.  Brandt ", "supervisor")
    _add(dialog, "A. Okafor", "surgeon")
    assert [one.words for one in persons.all] == ["L. Brandt, supervisor", "A. Okafor, surgeon"]
    dialog.rows[1].mine.click()
    assert persons.me.name == "A. Okafor"
    dialog.rows[1].role.setText("lead surgeon")
    dialog.rows[1].role.editingFinished.emit()
    assert persons.me.words == "A. Okafor, lead surgeon"
    dialog.rows[0].remove.click()
    assert [one.name for one in persons.all] == ["A. Okafor"]


def test_one_person_has_one_name(dialog: PersonsDialog, persons: Persons) -> None:
    _add(dialog, "")
    assert dialog.refusal.text() == "A person has a name. Type one."
    _add(dialog, "L. Brandt")
    _add(dialog, "l. brandt")
    assert dialog.refusal.text().startswith("There is a person L. Brandt already")
    assert len(persons.all) == 1


def test_a_pin_is_typed_twice_and_locks_the_person(dialog: PersonsDialog, persons: Persons) -> None:
    _add(dialog, "L. Brandt")
    row = dialog.rows[0]
    row.pin_button.click()
    for new, again, why in (("12", "12", "4 characters"), ("1234", "1235", "PINs differ")):
        row.new.setText(new)
        row.again.setText(again)
        row.keep.click()
        assert why in row.refusal.text()
    row.again.setText("1234")
    row.keep.click()
    assert persons.me.opens_with("1234")
    row = dialog.rows[0]
    assert not row.remove.isEnabled()
    assert not row.name.isEnabled()
    row.pin_button.click()
    row.old.setText("4321")
    row.old.returnPressed.emit()
    assert "not the PIN" in row.refusal.text()
    assert row.keep.isHidden()
    row.old.setText("1234")
    row.old.returnPressed.emit()
    assert row.remove.isEnabled()
    row.keep.click()
    assert persons.me == Person("L. Brandt")


def test_nobody_works_as_one_who_has_a_pin(dialog: PersonsDialog, persons: Persons) -> None:
    _add(dialog, "L. Brandt")
    persons.put(Person("A. Okafor").with_pin("2468"))
    again = PersonsDialog(persons)
    assert not again.rows[1].mine.isEnabled()
    again.deleteLater()


def test_an_empty_list_says_so_and_a_pin_is_typed_with_enter_alone(
    dialog: PersonsDialog, persons: Persons
) -> None:
    assert dialog.nobody.isVisible()
    _add(dialog, "L. Brandt")
    assert dialog.nobody.isHidden()
    row = dialog.rows[0]
    row.pin_button.click()
    QTest.keyClicks(row.new, "1234")
    QTest.keyClick(row.new, Qt.Key.Key_Return)
    QTest.keyClicks(dialog.focusWidget(), "1234")
    QTest.keyClick(dialog.focusWidget(), Qt.Key.Key_Return)
    assert persons.me.has_pin
