"""Values of facts: one is renamed after a preview, and a chip gives a state another value."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.studio.base.paint.node_paint import chip_places
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key = Qt.Key
HFSM, HANOI = SAMPLES / "hfsm.json", SAMPLES / "hanoi.json"
DOOR = {
    "SB1": {
        "State_0a": {"open": "State_1a"},
        "State_1a": {"close": "State_0a", "go": "State_1b"},
        "State_1b": {},
        "_facts": {"0": {"name": "Door", "values": {"0": "shut", "1": "open"}}},
    }
}


@pytest.fixture
def door(sit: Sit, tmp_path: Path) -> Person:
    path = tmp_path / "door.json"
    path.write_text(json.dumps(DOOR, indent=4))
    person = sit(path)
    person.window.canvas.zoom_to(1.0)
    return person


def chip(person: Person, state: str, digit: int) -> QPoint:
    """The middle of a chip on the canvas."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    at = sheet.picture.index[state]
    places = chip_places(sheet.picture.face(at), sheet.ink, float(sheet.full_widths[at]))
    return person.on_canvas(places[digit].center() + QPointF(*sheet.at[at]))


def rows(menu: QMenu) -> list[str]:
    return [entry.text() for entry in menu.actions() if not entry.isSeparator()]


def opened(person: Person) -> QMenu:
    """The menu that is open."""
    person.until(lambda: isinstance(QApplication.activePopupWidget(), QMenu))
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    return menu


def open_values(person: Person, digit: int, value: str) -> None:
    """Go to a value in the table of facts by keys, and press F2."""
    person.ctrl(Key.Key_T)
    view = person.window.facts.view
    person.until(view.hasFocus)
    for _ in range(digit):
        person.press(Key.Key_Down)
    for _ in range(20):
        if view.looks.cursor == (digit, ("value", value)):
            break
        person.press(Key.Key_Right)
    person.press(Key.Key_F2)


# A value is renamed


def test_a_value_is_renamed_after_its_effect_was_told(door: Person) -> None:
    before = door.blueprint.document.text
    open_values(door, 0, "0")
    card = door.window.facts.card
    door.until(card.isVisible)
    assert card.words.text() == "Another name for the value “0” of “Door”?"
    assert not card.agree.isEnabled()
    assert card.value.hasFocus()
    door.type("1")
    assert "has the value '1' already, in State_1a" in card.words.text()
    assert not card.agree.isEnabled()
    door.press(Key.Key_Backspace)
    door.type("s")
    assert card.words.text() == "“0” of “Door” becomes “s”. 1 state changes."
    assert card.names[0].text() == "State_0a → State_sa"
    assert door.blueprint.document.text == before
    door.press(Key.Key_Return)
    shown = door.blueprint["SB1"]
    assert list(shown.table) == ["State_sa", "State_1a", "State_1b"]
    assert shown.table["State_1a"]["close"] == "State_sa"
    note = shown.fact_note(0)
    assert note is not None
    assert dict(note.values) == {"s": "shut", "1": "open"}
    assert door.steps() == ["Rename value 0 of Door to s"]
    door.ctrl(Key.Key_Z)
    assert door.blueprint.document.text == before


def test_sensors_that_go_on_saying_the_old_value_are_told_before(sit: Sit) -> None:
    person = sit(HANOI)
    open_values(person, 0, "a")
    card = person.window.facts.card
    person.until(card.isVisible)
    person.type("q")
    assert "The code of its sensor disk_1_peg stays: if it says “a”" in card.words.text()
    assert card.agree.isEnabled()


def test_a_value_is_renamed_from_its_menu_and_escape_leaves_all_as_it_is(door: Person) -> None:
    before = door.blueprint.document.text
    view = door.window.facts.view
    door.until(lambda: not view.rect_of(1, "value", "b").isEmpty())
    QTest.mouseClick(view.viewport(), LEFT, pos=view.rect_of(1, "value", "b").center())
    door.choose_in_menu("Rename b…")
    card = door.window.facts.card
    door.until(card.isVisible)
    door.type("c")
    door.press(Key.Key_Escape)
    assert card.value.text() == ""
    door.press(Key.Key_Escape)
    assert not card.isVisible()
    assert door.blueprint.document.text == before


# A chip is clicked


def test_a_click_on_a_chip_of_a_selected_state_gives_it_another_value(door: Person) -> None:
    before = door.blueprint.document.text
    door.select("SB1/State_1b")
    door.click_canvas(chip(door, "State_1b", 0))
    menu = opened(door)
    assert rows(menu) == ["0  shut", "1  open", "Another value…", "What Door means…"]
    assert [entry.isChecked() for entry in menu.actions()][:2] == [False, True]
    door.choose_in_menu("0  shut")
    assert list(door.blueprint["SB1"].table) == ["State_0a", "State_1a", "State_0b"]
    assert door.blueprint["SB1"].table["State_1a"]["go"] == "State_0b"
    assert door.selected() == ["SB1/State_0b"]
    assert door.steps() == ["Set digit 0 of State_1b to 0"]
    door.ctrl(Key.Key_Z)
    assert door.blueprint.document.text == before


def test_a_value_that_makes_two_states_alike_is_refused(door: Person) -> None:
    door.select("SB1/State_1a")
    door.click_canvas(chip(door, "State_1a", 0))
    door.choose_in_menu("0  shut")
    assert "State_0a has these facts already." in door.window.toast.words
    assert "give it another value first" in door.window.toast.words
    assert door.steps() == []


def test_the_keyboard_alone_changes_a_fact(door: Person) -> None:
    door.select("SB1/State_1b")
    door.press(Key.Key_D)
    menu = opened(door)
    assert rows(menu) == ["0  Door: open (1)", "1  Fact 2: b"]
    closed = [below for one in menu.actions() if isinstance(below := one.menu(), QMenu)]
    assert [one.activeAction() for one in closed] == [None, None], "closed menus say nothing"
    for key in (Key.Key_Down, Key.Key_Down, Key.Key_Right):
        QTest.keyClick(menu, key)
    door.until(lambda: QApplication.activePopupWidget() is not menu)
    inner = opened(door)
    assert rows(inner)[:2] == ["a", "b"]
    QTest.keyClick(inner, Key.Key_Down)
    while inner.activeAction().text() != "Another value…":
        QTest.keyClick(inner, Key.Key_Down)
    QTest.keyClick(inner, Key.Key_Return)
    door.come_back()
    field = door.window.drawing.values.field
    assert field is not None
    QTest.keyClicks(field.field, "bb")
    QTest.keyClick(field.field, Key.Key_Return)
    assert "has one character" in field.complaint
    QTest.keyClick(field.field, Key.Key_Backspace)
    QTest.keyClick(field.field, Key.Key_Backspace)
    QTest.keyClicks(field.field, "c")
    QTest.keyClick(field.field, Key.Key_Return)
    assert list(door.blueprint["SB1"].table) == ["State_0a", "State_1a", "State_1c"]
    assert door.window.drawing.values.field is None
    assert door.window.canvas.hasFocus()


def test_a_double_click_on_the_chip_of_a_sub_sb_still_shows_the_sub_sb(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.canvas.zoom_to(1.0)
    person.select("SB1/State110")
    person.double_click_canvas(chip(person, "State110", 1))
    assert person.window.session.branch == "SB2"
    assert not person.window.drawing.values.waiting
    assert QApplication.activePopupWidget() is None
    assert person.steps() == []


def test_one_click_on_the_chip_of_a_sub_sb_opens_its_values_a_moment_later(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.canvas.zoom_to(1.0)
    person.select("SB1/State110")
    person.click_canvas(chip(person, "State110", 1))
    assert person.window.drawing.values.waiting
    menu = opened(person)
    assert rows(menu) == ["0", "1", "Another value…", "Show SB2", "What Fact 2 means…"]
    person.choose_in_menu("Show SB2")
    assert person.window.session.branch == "SB2"


# Several states


def test_several_states_show_what_they_share_and_change_together(door: Person) -> None:
    before = door.blueprint.document.text
    door.select("SB1/State_1a", "SB1/State_1b")
    chips = door.window.properties.state.chips
    assert chips.accessibleName() == "Door: open (1), Fact 2: various (a, b)"
    door.window.repaint()
    QTest.mouseClick(chips, LEFT, pos=chips.place_of(0).center().toPoint())
    assert rows(opened(door))[:2] == ["0  shut", "1  open"]
    door.choose_in_menu("Another value…")
    field = door.window.drawing.values.field
    assert field is not None
    QTest.keyClicks(field.field, "2")
    QTest.keyClick(field.field, Key.Key_Return)
    assert list(door.blueprint["SB1"].table) == ["State_0a", "State_2a", "State_2b"]
    assert door.steps() == ["Set digit 0 of 2 states to 2"]
    assert door.selected() == ["SB1/State_2a", "SB1/State_2b"]
    door.ctrl(Key.Key_Z)
    assert door.blueprint.document.text == before


def test_without_facts_or_states_the_key_does_nothing(sit: Sit, tmp_path: Path) -> None:
    person = sit(HANOI)
    person.press(Key.Key_D)
    assert QApplication.activePopupWidget() is None
    assert not person.window.actions_table["set_value"].isEnabled()
    person.select("SB1/State_aaa")
    assert person.window.actions_table["set_value"].isEnabled()
