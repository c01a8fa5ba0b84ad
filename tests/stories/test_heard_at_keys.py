"""What a screen reader says after keys that change nothing that is selected."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.shell.accessible_factory import install
from tests.stories.conftest import Heard, Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
HFSM = SAMPLES / "hfsm.json"


def words(heard: Heard) -> list[str]:
    """What was said since the last question."""
    said = [one for one, _ in heard]
    heard.clear()
    return said


def test_keys_that_need_something_selected_say_so(sit: Sit, heard: Heard) -> None:
    person = sit(HFSM)
    words(heard)
    for key in (Key.Key_F2, Key.Key_Delete, Key.Key_D, Key.Key_B):
        person.press(key)
        assert [one[:19] for one in words(heard)] == ["Nothing is selected"], key
    for key in (Key.Key_C, Key.Key_X, Key.Key_D, Key.Key_G):
        person.ctrl(key)
        assert [one[:19] for one in words(heard)] == ["Nothing is selected"], key
    assert person.steps() == []


def test_letting_go_moving_and_undo_are_told(sit: Sit, heard: Heard) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    words(heard)
    person.press(Key.Key_Down)
    assert words(heard) == ["State110 moved down by 8."]
    person.press(Key.Key_Left, [SHIFT])
    assert words(heard) == ["State110 moved left by 1."]
    person.press(Key.Key_Escape)
    assert words(heard) == ["Nothing is selected."]
    (step,) = person.steps()
    person.ctrl(Key.Key_Z)
    assert words(heard) == [f"Undone: {step}."]
    person.press(Key.Key_Z, [CTRL, SHIFT])
    assert words(heard) == [f"Done again: {step}."]
    person.ctrl(Key.Key_A)
    assert words(heard) == ["4 states selected."]
    person.press(Key.Key_Right)
    assert words(heard) == ["4 states moved right by 8."]


def test_a_fix_says_what_it_did(sit: Sit, heard: Heard) -> None:
    person = sit(HFSM)
    person.until_inspected()
    words(heard)
    person.ctrl(Key.Key_Period)
    (step,) = person.steps()
    assert any(one.startswith(f"Done: {step}.") for one in words(heard))


def test_the_search_in_the_drawing_says_each_hit(sit: Sit, heard: Heard) -> None:
    person = sit(HFSM)
    person.ctrl(Key.Key_F)
    words(heard)
    person.type("State1")
    person.until(lambda: person.selected() == ["SB1/State100"])
    told = words(heard)[-1]
    assert told.startswith("1 of 4. State100, ")
    assert "Found in name" in told
    person.press(Key.Key_Return)
    (found,) = person.selected()
    assert words(heard)[-1].startswith(f"2 of 4. {found.split('/')[-1]}, ")
    person.type("xyz")
    person.until(lambda: bool(heard))
    assert "No state or operation has" in words(heard)[-1]


def rows_of(person: Person) -> list[str]:
    """The rows of the history as they are read."""
    read = QAccessible.queryAccessibleInterface(person.window.history)
    return [read.child(at).text(QAccessible.Text.Name) for at in range(read.childCount())]


def test_the_history_is_read_by_arrows_and_gone_to_by_enter(
    sit: Sit, heard: Heard, qapp: QApplication
) -> None:
    install(qapp)
    person = sit(HFSM)
    form = person.window.properties.state
    person.select("SB1/State110")
    for name in ("State010", "State011"):
        person.write(form.name, name)
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_H)
    history = person.window.history
    person.until(history.hasFocus)
    first, second = "Rename State110 to State010", "Rename State010 to State011"
    assert rows_of(person) == ["As it was opened", first, f"{second}, present step"]
    inside = QAccessible.queryAccessibleInterface(history).focusChild()
    assert inside.text(QAccessible.Text.Name) == f"{second}, present step"
    words(heard)
    person.press(Key.Key_Up)
    assert "State011" in person.blueprint["SB1"].table, "reading undoes nothing"
    person.press(Key.Key_Return)
    assert "State010" in person.blueprint["SB1"].table
    assert rows_of(person)[1:] == [f"{first}, present step", f"{second}, undone"]
    assert words(heard) == [f"Undone: {second}."]


def test_an_undo_in_another_branch_is_told_once(sit: Sit, heard: Heard) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    person.press(Key.Key_Delete)
    person.window.session.show_branch("SB2")
    words(heard)
    person.ctrl(Key.Key_Z)
    told = [one for one in words(heard) if one.startswith("Undone")]
    assert len(told) == 1
    assert told[0].endswith("in SB1")
