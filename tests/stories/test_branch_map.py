"""The map of branches: all SBs of the file, and the way into each."""

from __future__ import annotations

from PySide6.QtCore import Qt

from smsl_studio.blueprint.editing import add_state
from smsl_studio.studio.features.branch_map.map_window import MapWindow
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Modifier = Qt.Key, Qt.KeyboardModifier
LEVELS = SAMPLES / "three-levels.json"


def opened(person: Person) -> MapWindow:
    """Open the map by its key."""
    person.press(Key.Key_O, (Modifier.ControlModifier, Modifier.ShiftModifier))
    shown = person.window.features.branch_map.part()
    person.until(shown.isVisible)
    return shown


def test_a_click_on_a_card_goes_into_its_branch(sit: Sit) -> None:
    person = sit(LEVELS)
    shown = opened(person)
    assert list(shown.view.cards) == ["SURGERY", "REGISTRATION", "DIGITIZATION"]
    person.click(shown.view.cards["DIGITIZATION"])
    assert person.window.session.branch == "DIGITIZATION"
    assert not shown.isVisible()


def test_the_keys_go_from_card_to_card_and_into_a_branch(sit: Sit) -> None:
    person = sit(LEVELS)
    shown = opened(person)
    assert shown.view.cards["SURGERY"].hasFocus()
    person.press(Key.Key_Tab)
    person.press(Key.Key_Space)
    assert person.window.session.branch == "REGISTRATION"
    assert person.window.mode == "draw"


def test_enter_goes_into_a_branch_as_space_does(sit: Sit) -> None:
    person = sit(LEVELS)
    shown = opened(person)
    person.press(Key.Key_Tab)
    person.press(Key.Key_Return)
    assert person.window.session.branch == "REGISTRATION"
    assert not shown.isVisible()


def test_an_edit_and_undo_are_followed_while_the_map_is_open(sit: Sit) -> None:
    person = sit(LEVELS)
    shown = opened(person)
    before = shown.view.cards["SURGERY"].card
    person.window.session.show_branch("SURGERY")
    assert shown.view.cards["SURGERY"].current
    person.window.session.edit("Add", lambda bp: add_state(bp, "SURGERY", "State101"))
    person.until(lambda: shown.view.cards["SURGERY"].card.states == before.states + 1)
    person.window.session.history.undo()
    person.until(lambda: shown.view.cards["SURGERY"].card == before)


def test_another_theme_reaches_the_map(sit: Sit) -> None:
    person = sit(LEVELS)
    shown = opened(person)
    light = shown.view.grab().toImage()
    person.windows.set_theme("dark")
    person.until(lambda: shown.view.grab().toImage() != light)


def test_a_new_drawing_without_branches_has_no_map(sit: Sit) -> None:
    person = sit()
    there = bool(person.blueprint.branches)
    assert person.window.actions_table["branch_map"].isEnabled() == there
