"""A name being edited on the canvas is taken over when a key of the window is pressed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit

from smsl_studio.studio.base.controls import Field
from tests.stories.at_outline import click_line, texts
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
KEPT = [Key.Key_S, Key.Key_J, Key.Key_Plus]
"""With Ctrl: keys of the window that leave the focus where it is."""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return Path(shutil.copy(SAMPLES / "hfsm.json", tmp_path))


@pytest.mark.parametrize("key", KEPT)
def test_after_a_state_is_named_and_saved_the_keys_act_on_it(
    sit: Sit, file: Path, key: Qt.Key
) -> None:
    person = sit(file)
    person.select("SB1/State100")
    person.press(Key.Key_F2)
    person.type("State112")
    person.ctrl(key)
    assert person.steps() == ["Rename State100 to State112"]
    assert person.window.canvas.hasFocus()
    person.press(Key.Key_F2)
    assert isinstance(QApplication.focusWidget(), QLineEdit)
    person.press(Key.Key_Escape)
    person.press(Key.Key_Delete)
    assert person.steps()[-1] == "Delete State112"


def test_after_a_new_state_is_saved_while_it_is_named_the_keys_act_on_it(
    sit: Sit, file: Path
) -> None:
    person = sit(file)
    modifiers = [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]
    person.press(Key.Key_N, modifiers)
    person.type("State113")
    person.ctrl(Key.Key_S)
    person.press(Key.Key_Delete)
    assert person.steps() == ["Add State113", "Delete State113"]


def test_after_an_operation_is_named_and_saved_the_keys_act_on_it(sit: Sit, file: Path) -> None:
    person = sit(file)
    person.select("SB1/State100/Operation100A")
    person.press(Key.Key_F2)
    person.type("Op_new")
    person.ctrl(Key.Key_S)
    person.press(Key.Key_Delete)
    assert person.steps() == ["Rename Operation100A to Op_new", "Delete Op_new"]


def test_a_key_that_leads_elsewhere_takes_a_name_over_and_leads_there(sit: Sit, file: Path) -> None:
    person = sit(file)
    person.select("SB1/State100")
    person.press(Key.Key_F2)
    person.type("State101")
    person.ctrl(Key.Key_H)
    assert person.steps() == ["Rename State100 to State101"]
    assert person.window.history.hasFocus()


@pytest.mark.parametrize("key", KEPT)
def test_after_a_state_branch_is_named_and_saved_the_outline_has_the_keys(
    sit: Sit, file: Path, key: Qt.Key
) -> None:
    person = sit(file)
    tree = person.window.outline.tree
    click_line(tree, "SB2")
    person.press(Key.Key_F2)
    person.type("Clamp")
    person.ctrl(key)
    person.until(lambda: "Clamp" in texts(tree))
    assert tree.hasFocus()
    person.press(Key.Key_F2)
    assert tree.naming
    person.press(Key.Key_Escape)


def test_a_click_into_a_form_takes_the_keys_there(sit: Sit, file: Path) -> None:
    person = sit(file)
    person.select("SB1/State100")
    person.press(Key.Key_F2)
    elsewhere = name_in_form(person)
    person.click(elsewhere)
    assert QApplication.focusWidget() is elsewhere
    QTest.keyClick(elsewhere, Key.Key_End)
    person.type("1")
    assert elsewhere.text() == "State1001"
    QTest.keyClick(elsewhere, Key.Key_Escape)


def test_a_name_that_a_click_into_the_form_takes_over_leaves_the_keys_there(
    sit: Sit, file: Path
) -> None:
    person = sit(file)
    person.select("SB1/State100")
    person.press(Key.Key_F2)
    person.type("State112")
    elsewhere = name_in_form(person)
    person.click(elsewhere)
    assert person.steps() == ["Rename State100 to State112"]
    assert QApplication.focusWidget() is elsewhere
    assert elsewhere.text() == "State112"


@pytest.mark.parametrize("element", ["SB1/State100", "SB1/State100/Operation100A"])
def test_after_a_name_is_given_in_the_form_it_still_has_the_keys(
    sit: Sit, file: Path, element: str
) -> None:
    person = sit(file)
    person.select(element)
    field = name_in_form(person)
    person.click(field)
    field.selectAll()
    person.type("State112")
    person.press(Key.Key_Return)
    assert len(person.steps()) == 1
    assert QApplication.focusWidget() is field
    person.ctrl(Key.Key_Z)
    assert person.selected() == [element]
    assert field.text() == element.rpartition("/")[2]


def name_in_form(person: Person) -> Field:
    fields = person.window.properties.findChildren(Field)
    return next(f for f in fields if f.isVisible() and f.accessibleName() == "Name")
