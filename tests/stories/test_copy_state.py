"""Ctrl+D on a state: the copy is proposed with the next free facts, and made by Enter."""

from __future__ import annotations

import random

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.features.draw.canvas.copy_card import CopyCard
from smsl_studio.studio.features.draw.canvas.state_copy import StateCopy
from tests.stories.at_canvas import Drawer, sample
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.studio.base.canvas.test_canvas import alike, on_screen, painted_anew

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"


def card_of(person: Person) -> CopyCard:
    card = person.window.editor.field
    assert isinstance(card, CopyCard)
    return card


def propose(person: Person, state: str) -> CopyCard:
    """Select a state and press Ctrl+D."""
    person.select(state)
    person.ctrl(Key.Key_D)
    return card_of(person)


def test_the_next_free_facts_are_proposed_and_enter_makes_the_copy(sit: Sit) -> None:
    person = sit(HFSM)
    text = person.blueprint.document.text
    card = propose(person, "SB1/State100")
    assert card.name.text() == "State101"
    assert card.chips is not None
    assert card.chips.values == ("1", "0", "1")
    assert card.chips.hasFocus()
    sketch = person.window.canvas.gestures.sketch
    assert sketch is not None
    assert sketch.states[0][1] == "State101"
    assert person.blueprint.document.text == text, "nothing is made yet"
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State101"] == {}
    assert person.selected() == ["SB1/State101"]
    assert person.steps() == ["Duplicate State100 as State101"]
    assert person.window.canvas.gestures.sketch is None
    assert person.window.canvas.viewport().rect().contains(person.place("SB1/State101"))
    rect = person.window.canvas.rect_of(Address("SB1", "State101"))
    assert rect is not None
    assert rect.center() == sketch.states[0][0].center()
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text


def test_keys_change_the_facts_and_the_name_follows(sit: Sit) -> None:
    person = sit(HFSM)
    card = propose(person, "SB1/State100")
    assert card.chips is not None
    person.press(Key.Key_Up)
    assert card.name.text() == "State100"
    assert "already a state State100" in card.complaint
    person.press(Key.Key_Return)
    assert person.steps() == [], "the name is taken"
    person.press(Key.Key_Left)
    person.press(Key.Key_Left)
    person.press(Key.Key_Space)
    person.press(Key.Key_Right)
    person.type("1")
    assert card.chips.values == ("0", "1", "0")
    assert card.complaint == ""
    assert "Fact 2: 1" in card.chips.accessibleName()
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/State010"]


def test_clicks_change_the_facts(sit: Sit) -> None:
    person = sit(HFSM)
    card = propose(person, "SB1/State100")
    assert card.chips is not None
    person.click(card.chips, card.chips.place_of(0).center().toPoint())
    assert card.name.text() == "State001"
    sketch = person.window.canvas.gestures.sketch
    assert sketch is not None
    assert sketch.states[0][1] == "State001"
    person.click(card.chips, card.chips.place_of(0).center().toPoint())
    assert card.name.text() == "State101"


def test_a_name_can_be_typed_and_the_chips_follow_it(sit: Sit) -> None:
    person = sit(HFSM)
    card = propose(person, "SB1/State100")
    person.press(Key.Key_Tab)
    person.type("State011")
    assert card.chips is not None
    assert card.chips.values == ("0", "1", "1")
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/State011"]


@pytest.mark.parametrize("tabs", [0, 1])
def test_escape_gives_the_copy_up(sit: Sit, tabs: int) -> None:
    person = sit(HFSM)
    propose(person, "SB1/State100")
    for _ in range(tabs):
        person.press(Key.Key_Tab)
    person.press(Key.Key_Escape)
    assert person.window.editor.field is None
    assert person.window.canvas.gestures.sketch is None
    assert person.steps() == []
    assert person.selected() == ["SB1/State100"]
    assert person.window.canvas.hasFocus()


def test_a_press_elsewhere_gives_up_a_proposal_that_nobody_changed(sit: Sit) -> None:
    person = sit(HFSM)
    card = propose(person, "SB1/State100")
    person.click_canvas(QPoint(20, 300))
    assert person.window.editor.field is None
    assert card.isHidden()
    assert person.steps() == []


def test_several_states_and_operations_are_duplicated_at_once_as_before(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100", "SB1/State110")
    person.ctrl(Key.Key_D)
    assert person.window.editor.field is None
    assert person.steps() == ["Duplicate 2 states"]
    person.select("SB1/State000/Operation000")
    person.ctrl(Key.Key_D)
    assert len(person.steps()) == 2


def test_a_state_whose_name_shows_no_facts_gets_a_name_alone(qtbot: QtBot) -> None:
    person = Drawer(qtbot)
    for name, x in (("Idle", 200), ("Moving", 500)):
        person.double_click(QPoint(x, 300))
        person.write(name)
    person.session.select((Address("SB1", "Idle"),))
    StateCopy(person.editor).ask()
    card = person.editor.field
    assert isinstance(card, CopyCard)
    assert card.chips is None
    person.write("Waiting")
    assert person.selected() == ["Waiting"]


def test_the_sketch_of_a_copy_leaves_nothing_stale_on_the_screen(qtbot: QtBot) -> None:
    person = Drawer(qtbot, sample("hfsm.json"))
    person.session.select((Address("SB1", "State100"),))
    StateCopy(person.editor).ask()
    assert alike(painted_anew(person), on_screen(person))
    QTest.keyClick(QApplication.focusWidget() or person.canvas, Key.Key_Escape)
    assert person.editor.field is None
    QApplication.processEvents()
    seen = on_screen(person)
    assert alike(painted_anew(person), seen)


@pytest.mark.parametrize("seed", range(3))
def test_any_copies_are_undone_to_the_same_bytes(qtbot: QtBot, seed: int) -> None:
    person, chance = Drawer(qtbot, sample("hanoi-corrected.json")), random.Random(seed)
    text = person.session.blueprint.document.text
    keys = (Key.Key_Up, Key.Key_Down, Key.Key_Left, Key.Key_Right, Key.Key_B, Key.Key_Tab)
    for _ in range(8):
        name = chance.choice([*person.canvas.positions])
        person.session.select((Address("SB1", name),))
        StateCopy(person.editor).ask()
        for _ in range(chance.randrange(6)):
            person.key(chance.choice(keys))
        before = person.steps()
        person.key(Key.Key_Return)
        assert person.steps() - before in (0, 1)
        if person.editor.field is not None:
            person.key(Key.Key_Escape)
        assert person.editor.field is None
    while person.steps():
        person.session.history.undo()
    assert person.session.blueprint.document.text == text
