"""Tab adds only what was typed: a person who walks through the window by Tab draws nothing."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QWidget

from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, SHIFT = Qt.Key, Qt.KeyboardModifier.ShiftModifier
HFSM = SAMPLES / "hfsm.json"


def focus() -> QWidget:
    found = QApplication.focusWidget()
    assert found is not None
    return found


def is_outside(person: Person) -> bool:
    """Whether the keyboard focus is neither on the canvas nor on a card over the drawing."""
    canvas = person.window.canvas
    return focus() is not canvas and not isinstance(focus().parentWidget(), ConnectCard | NameField)


def test_many_tabs_add_nothing_and_come_to_the_other_parts(sit: Sit) -> None:
    person = sit(HFSM)
    text = person.blueprint.document.text
    person.select("SB1/State110")
    seen = set()
    for _ in range(45):
        person.press(Key.Key_Tab)
        if is_outside(person):
            seen.add(id(focus()))
    assert person.steps() == []
    assert person.blueprint.document.text == text
    assert len(seen) > 15, "Tab came to the other parts of the window"


@pytest.mark.parametrize("key", [Key.Key_Tab, Key.Key_Backtab])
def test_a_form_in_which_nothing_was_typed_is_left_by_tab(sit: Sit, key: Qt.Key) -> None:
    person = sit(HFSM)
    modifiers = [SHIFT] * (key == Key.Key_Backtab)
    person.select("SB1/State111")
    person.press(Key.Key_Slash)
    assert isinstance(person.window.editor.field, ConnectCard)
    person.press(key, modifiers)
    if key == Key.Key_Tab:
        assert isinstance(person.window.editor.field, ConnectCard), "first to the target"
        person.press(key, modifiers)
    assert person.window.editor.field is None
    assert is_outside(person)
    assert person.window.canvas.gestures.drawn is None, "the line is gone, too"
    assert person.steps() == []


def test_an_emptied_name_is_left_and_a_typed_one_is_added(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State111")
    person.press(Key.Key_Tab)
    person.type("One")
    person.press(Key.Key_Tab)
    person.type("StateA11")
    person.press(Key.Key_Tab)
    assert person.steps() == ["Connect State111 to StateA11"]
    card = person.window.editor.field
    assert isinstance(card, ConnectCard), "a chain goes on"
    person.press(Key.Key_Backspace)
    person.press(Key.Key_Tab)
    person.press(Key.Key_Tab)
    assert is_outside(person)
    assert len(person.steps()) == 1


def test_a_choice_from_the_list_counts_as_typed(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State111")
    person.press(Key.Key_Tab)
    person.press(Key.Key_Down)
    person.press(Key.Key_Tab)
    person.press(Key.Key_Tab)
    assert len(person.steps()) == 1


def test_a_name_that_stays_as_it_was_is_left_by_tab(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State111")
    person.press(Key.Key_F2)
    person.press(Key.Key_Tab)
    assert person.window.editor.field is None
    assert is_outside(person)
    person.window.canvas.setFocus()
    person.window.session.select(())
    person.window.actions_table["add_state"].trigger()
    assert isinstance(person.window.editor.field, NameField)
    person.press(Key.Key_Tab)
    assert person.window.editor.field is None
    assert is_outside(person)
    assert person.steps() == []


def test_the_fields_say_what_they_are_for_and_how_to_leave(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State111")
    person.press(Key.Key_Tab)
    card = person.window.editor.field
    assert isinstance(card, ConnectCard)
    for field, begin in ((card.operation, "New operation."), (card.target, "To which state")):
        told = field.accessibleDescription()
        assert told.startswith(begin)
        assert "Enter adds it" in told
        assert "Tab leaves, and adds nothing" in told


def test_tab_goes_from_the_numbers_of_the_header_to_the_facts(sit: Sit) -> None:
    person = sit(HFSM)
    header = person.window.properties.header
    header.num_states.setFocus()
    names = [fact.name for fact in header.facts]
    for name in names:
        person.press(Key.Key_Tab)
        assert focus() is name
    # The rows of facts that come later stand there, too.
    person.window.session.show_branch("SB2")
    person.window.session.show_branch("SB1")
    header.num_states.setFocus()
    person.press(Key.Key_Tab)
    assert focus() is header.facts[0].name
