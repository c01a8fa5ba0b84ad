"""Align: from the button, the menus and the palette, as one step, without another digest."""

from __future__ import annotations

import random

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu, QToolButton

from smsl_studio.blueprint.digests import digests
from smsl_studio.studio.features.draw.canvas.align_verbs import WORDS
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, address

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE = SAMPLES / "registration.json"
SB = "REGISTRATION"


def states(person: Person) -> list[str]:
    return list(person.blueprint[SB].table)


def select(person: Person, count: int) -> list[str]:
    """Click the first states of the SB, with Shift from the second on."""
    chosen = states(person)[:count]
    # A click on a fact of a state that is selected already opens the values of the fact.
    person.window.session.select(())
    person.select(*(f"{SB}/{name}" for name in chosen))
    return chosen


def button(person: Person) -> QToolButton:
    action = person.window.actions_table["align"]
    return next(
        one for one in person.window.mode_bar.findChildren(QToolButton)
        if one.defaultAction() is action
    )  # fmt: skip


def open_menu(person: Person) -> QMenu:
    """The menu that is open; it opens in a moment."""

    def shown() -> list[QMenu]:
        return [menu for menu in person.window.findChildren(QMenu) if menu.isVisible()]

    person.until(lambda: bool(shown()))
    return shown()[0]


def row(menu: QMenu, words: str) -> QAction:
    return next(one for one in menu.actions() if one.text() == words)


def choose(person: Person, words: str) -> None:
    """Press the button Align and click a row of its menu."""
    person.click(button(person))
    menu = open_menu(person)
    QTest.mouseClick(
        menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(row(menu, words)).center()
    )
    person.until(lambda: not menu.isVisible())
    person.come_back()


def test_the_button_waits_for_two_states_and_has_every_way_in_its_menu(sit: Sit) -> None:
    person = sit(FILE)
    assert not button(person).isEnabled()
    select(person, 1)
    assert not button(person).isEnabled()
    select(person, 2)
    assert button(person).isEnabled()
    assert button(person).text().strip() == "Align"
    person.click(button(person))
    menu = open_menu(person)
    rows = {one.text(): one.isEnabled() for one in menu.actions() if not one.isSeparator()}
    assert list(rows) == [words for words, _ in WORDS.values()]
    assert [words for words, on in rows.items() if not on] == [
        "Distribute across",
        "Distribute down",
    ]
    menu.close()


def test_align_is_one_step_and_undo_gives_the_same_bytes(sit: Sit) -> None:
    person = sit(FILE)
    text, before = person.blueprint.document.text, person.window.canvas.positions
    meant = digests(person.blueprint)
    chosen = ["State_0000", "State_1010", "State_1100", "State_1111"]
    person.select(*(f"{SB}/{name}" for name in chosen))
    choose(person, "Align top")
    after = person.window.canvas.positions
    assert len({after[name][1] for name in chosen}) == 1
    assert all(after[name][0] == before[name][0] for name in chosen)
    assert {n: at for n, at in after.items() if n not in chosen} == {
        n: at for n, at in before.items() if n not in chosen
    }
    assert person.steps() == ["Align top: 4 states"]
    assert person.selected() == [f"{SB}/{name}" for name in chosen]
    assert digests(person.blueprint) == meant
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text
    assert person.window.canvas.positions == before


def test_a_second_time_makes_no_step_and_says_so(sit: Sit) -> None:
    person = sit(FILE)
    select(person, 3)
    choose(person, "Distribute across")
    choose(person, "Align middle")
    steps = person.steps()
    choose(person, "Align middle")
    assert person.steps() == steps
    assert person.window.canvas.overlays.word.text == "The selected states stand so already."


def test_a_row_on_one_vertical_line_becomes_a_column_that_covers_nothing(sit: Sit) -> None:
    person = sit(FILE)
    chosen = ["State_0000", "State_1000", "State_1100"]
    person.select(*(f"{SB}/{name}" for name in chosen))
    choose(person, "Align centre")
    places = [person.window.canvas.positions[name] for name in chosen]
    assert len({x for x, _ in places}) == 1
    assert [y - places[0][1] for _, y in places] == [0.0, 78.0, 156.0]


def test_keys_alone_open_the_menu_and_choose(sit: Sit) -> None:
    person = sit(FILE)
    person.ctrl(Key.Key_A)
    person.press(Key.Key_A, [Ctrl, Shift])
    menu = open_menu(person)
    for _ in range(3):
        QTest.keyClick(menu, Key.Key_Down)
    QTest.keyClick(menu, Key.Key_Return)
    person.until(lambda: not menu.isVisible())
    assert person.steps() == [f"Align right: {len(states(person))} states"]


def test_menu_palette_and_pointer_offer_the_same(sit: Sit) -> None:
    person = sit(FILE)
    window = person.window
    blueprint = next(m for m in window.findChildren(QMenu) if m.title() == "&Blueprint")
    blueprint.aboutToShow.emit()
    arrange = next(one for one in window.findChildren(QMenu) if one.title() == "Arrange")
    assert arrange.menuAction() in blueprint.actions()
    (offered,) = (one for one in arrange.actions() if one.text() == "Align…")
    assert not offered.isEnabled()
    chosen = select(person, 2)
    blueprint.aboutToShow.emit()
    assert offered.isEnabled()
    draw = window.features.draw
    where = address(f"{SB}/{chosen[0]}")
    menu = context_menu(
        window.session, draw.editor, window.actions_table, draw.clipping, where
    )  # fmt: skip
    (pointed,) = (one.menu() for one in menu.actions() if one.text() == "Align")
    assert isinstance(pointed, QMenu)
    row(pointed, "Align top").trigger()
    assert person.steps() == ["Align top: 2 states"]
    person.ctrl(Key.Key_K)
    person.type("space equally down")
    person.press(Key.Key_Return)
    person.until(lambda: len(person.steps()) == 2)
    assert person.steps()[1] == "Space equally down: 2 states"
    offered.trigger()
    shown = open_menu(person)
    assert row(shown, "Align left").isEnabled()
    shown.close()


@pytest.mark.parametrize("seed", range(3))
def test_any_arrangements_are_undone_to_the_same_bytes(sit: Sit, seed: int) -> None:
    person = sit(FILE)
    draws = random.Random(seed)
    text, session = person.blueprint.document.text, person.window.session
    meant = digests(person.blueprint)
    for _ in range(12):
        chosen = draws.sample(states(person), draws.randint(2, len(states(person))))
        session.select(address(f"{SB}/{name}") for name in chosen)
        person.window.actions_table[f"align_{draws.choice(list(WORDS))}"].trigger()
        assert digests(person.blueprint) == meant
    assert person.steps()
    while session.history.canUndo():
        person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text
