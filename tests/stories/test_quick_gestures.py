"""Quick gestures: siblings by a key, operations by two clicks, and buttons that cover no label."""

from __future__ import annotations

import itertools

import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, Qt
from PySide6.QtTest import QTest

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from tests.stories.at_canvas import Drawer
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Modifier, Button = Qt.Key, Qt.KeyboardModifier, Qt.MouseButton
HFSM = SAMPLES / "hfsm.json"


# Siblings


def test_shift_tab_adds_siblings_of_the_operation_that_was_just_added(hfsm: Drawer) -> None:
    text = hfsm.session.blueprint.document.text
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    hfsm.write("One", Key.Key_Tab)
    hfsm.write("StateA11")
    for operation, state in (("Two", "StateB11"), ("Three", "StateC11")):
        hfsm.key(Key.Key_Backtab, Modifier.ShiftModifier)
        hfsm.write(operation, Key.Key_Tab)
        hfsm.write(state)
        assert hfsm.selected() == [f"State111/{operation}"]
        assert hfsm.hands_on.rect().contains(hfsm.place(state))
    assert hfsm.table()["State111"] == {"One": "StateA11", "Two": "StateB11", "Three": "StateC11"}
    assert hfsm.steps() == 3
    places = [hfsm.canvas.positions[f"State{letter}11"] for letter in "ABC"]
    assert len({x for x, _ in places}) == 1, "siblings stand in one column"
    while hfsm.steps():
        hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text


def test_the_sibling_of_a_state_starts_where_an_operation_leads_to_the_state(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State110"))
    hfsm.key(Key.Key_Backtab, Modifier.ShiftModifier)
    hfsm.write("Also", Key.Key_Tab)
    hfsm.write("StateA10")
    assert hfsm.table()["State100"]["Also"] == "StateA10"


def test_a_state_to_which_nothing_leads_has_no_sibling_and_that_is_said(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State000"))
    hfsm.key(Key.Key_Backtab, Modifier.ShiftModifier)
    assert "No operation leads to State000" in hfsm.canvas.overlays.word.text
    assert hfsm.editor.field is None
    hfsm.session.select(Address("SB1", name) for name in ("State100", "State110"))
    hfsm.key(Key.Key_Backtab, Modifier.ShiftModifier)
    assert "Select one state" in hfsm.canvas.overlays.word.text


def test_a_sibling_of_a_loop_stands_beside_its_state(hfsm: Drawer) -> None:
    state = Address("SB1", "State110")
    hfsm.editor.new_operation.ask(state, state, hfsm.canvas.mapToScene(QPoint(300, 300)))
    hfsm.write("Again")
    assert hfsm.selected() == ["State110/Again"]
    hfsm.canvas.setFocus()
    hfsm.key(Key.Key_Backtab, Modifier.ShiftModifier)
    hfsm.write("Also", Key.Key_Tab)
    hfsm.write("StateA10")
    assert hfsm.table()["State110"]["Also"] == "StateA10"


# Connect by two clicks


def click_canvas(person: Person, state: str) -> None:
    person.move_to(person.place(state))
    person.click_canvas(person.place(state))


def card_of(person: Person) -> ConnectCard:
    card = person.window.editor.field
    assert isinstance(card, ConnectCard)
    return card


def test_c_then_a_click_on_the_source_and_one_on_the_target_connect(sit: Sit) -> None:
    person = sit(HFSM)
    person.press(Key.Key_C)
    word = person.window.canvas.overlays.word
    assert "where the operation starts" in word.text
    click_canvas(person, "SB1/State111")
    assert "target state" in word.text
    assert person.window.canvas.hand.busy
    person.move_to(person.place("SB1/State000"))
    assert person.window.canvas.gestures.drawn is not None
    click_canvas(person, "SB1/State000")
    assert not person.window.canvas.hand.busy
    person.type("Reset")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State111"] == {"Reset": "State000"}
    assert person.selected() == ["SB1/State111/Reset"]
    assert len(person.steps()) == 1


def test_the_button_connect_works_with_clicks_and_ends_on_empty_canvas(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    person.window.actions_table["connect"].trigger()
    person.click_canvas(QPoint(40, 300))
    assert person.window.editor.field is None, "empty canvas is no source"
    click_canvas(person, "SB1/State111")
    person.move_to(QPoint(500, 560))
    person.click_canvas(QPoint(500, 560))
    assert card_of(person).target.isVisible()
    person.press(Key.Key_Escape)
    assert person.steps() == []


def test_in_the_tool_a_drag_connects_as_well(sit: Sit) -> None:
    person = sit(HFSM)
    person.press(Key.Key_C)
    person.drag(person.place("SB1/State111"), person.place("SB1/State000"))
    person.type("Reset")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State111"] == {"Reset": "State000"}


def test_a_second_click_on_the_source_makes_a_loop(sit: Sit) -> None:
    person = sit(HFSM)
    person.press(Key.Key_C)
    click_canvas(person, "SB1/State111")
    click_canvas(person, "SB1/State111")
    person.type("Wait")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State111"] == {"Wait": "State111"}


@pytest.mark.parametrize("clicks", [0, 1])
def test_escape_and_the_right_button_leave_the_tool(sit: Sit, clicks: int) -> None:
    person = sit(HFSM)
    canvas, shape = person.window.canvas, Qt.CursorShape
    for right in (False, True):
        person.press(Key.Key_C)
        assert canvas.viewport().cursor().shape() is shape.CrossCursor
        for _ in range(clicks):
            click_canvas(person, "SB1/State111")
        if right:
            QTest.mousePress(canvas.viewport(), Button.RightButton, pos=QPoint(40, 300))
        else:
            person.press(Key.Key_Escape)
        assert not canvas.hand.busy
        assert canvas.gestures.drawn is None
        assert canvas.viewport().cursor().shape() is shape.ArrowCursor
        assert canvas.overlays.word.text == ""
    person.select("SB1/State000")
    assert person.window.editor.field is None
    assert person.steps() == []


def test_two_selected_states_are_connected_at_once_and_the_tool_needs_no_mouse(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State111", "SB1/State000")
    person.press(Key.Key_C)
    person.type("Reset")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State111"] == {"Reset": "State000"}
    person.select("SB1/State000")
    person.press(Key.Key_C)
    assert "Enter: State000" in person.window.canvas.overlays.word.text
    person.press(Key.Key_Return)
    person.ctrl(Key.Key_Right)
    person.press(Key.Key_Return)
    person.type("Go")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State000"]["Go"] == "State100"


def test_a_click_on_a_state_becomes_the_target_while_the_operation_is_named(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    hfsm.click(hfsm.place("State000"))
    card = hfsm.editor.field
    assert isinstance(card, ConnectCard)
    assert card.target.text() == "State000"
    assert hfsm.steps() == 0, "nobody has named it yet"
    hfsm.write("Reset", None)
    hfsm.click(hfsm.place("State100"))
    assert hfsm.editor.field is None
    assert hfsm.table()["State111"] == {"Reset": "State100"}
    assert hfsm.selected() == ["State111/Reset"]
    assert hfsm.steps() == 1


def test_a_fixed_target_is_not_replaced_by_a_click(hfsm: Drawer) -> None:
    hfsm.editor.new_operation.ask(
        Address("SB1", "State111"), Address("SB1", "State000"), hfsm.canvas.mapToScene(QPoint(9, 9))
    )
    hfsm.click(hfsm.place("State100"))
    assert hfsm.editor.field is None
    assert hfsm.selected() == ["State100"]


@pytest.mark.parametrize("state", ["State000", "State110", "State111"])
def test_the_card_of_a_new_state_covers_neither_it_nor_others(hfsm: Drawer, state: str) -> None:
    hfsm.click(hfsm.place(state))
    hfsm.key(Key.Key_Tab)
    card, drawn = hfsm.editor.field, hfsm.canvas.gestures.drawn
    assert card is not None
    assert drawn is not None
    new = QRect(0, 0, 108, 54)
    new.moveCenter(hfsm.at(drawn.end))
    assert not card.geometry().intersects(new)
    away = card.geometry().center() - new.center()
    assert abs(away.x()) < 220, "it is beside the new state, or above or below"
    assert abs(away.y()) < 220
    for name in hfsm.canvas.positions:
        assert not card.geometry().contains(hfsm.place(name))


def test_a_card_in_place_of_another_shows_its_own_new_state(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    hfsm.canvas.setFocus()
    hfsm.key(Key.Key_Tab)
    assert hfsm.canvas.gestures.drawn is not None


# The buttons beside a state


@pytest.mark.parametrize("zoom", [0.8, 1.0, 1.4])
def test_the_buttons_of_a_state_cover_no_label_and_no_node(hanoi: Drawer, zoom: float) -> None:
    canvas, pad, found = hanoi.canvas, hanoi.canvas.overlays.pad, 0
    canvas.zoom_to(zoom)
    for name, place in canvas.positions.items():
        canvas.camera.go(QPointF(*place), zoom, False)
        hanoi.hover(hanoi.place(name))
        at = pad.place_for(Address("SB1", name))
        if at is None:
            continue
        found += 1
        area, sheet = canvas.mapToScene(at).boundingRect(), hanoi.sheet
        assert not sheet.states_in(area.left(), area.top(), area.right(), area.bottom())
        labels = [label.rect for label in canvas.lit_layer.shown().values()]
        labels += [one for edge in range(78) if (one := sheet.geometry.label(edge)) is not None]
        for left, top, right, bottom in labels:
            assert not (left < area.right() and area.left() < right
                        and top < area.bottom() and area.top() < bottom), name  # fmt: skip
    assert found > 20, "most states have their buttons"


# Chains


def test_a_chain_by_tab_goes_on_in_the_next_row_and_back(sit: Sit) -> None:
    person = sit()
    view = person.window.canvas.viewport()
    person.double_click_canvas(QPoint(view.width() // 2, view.height() // 2))
    names = [f"S{number}" for number in range(12)]
    for number, name in enumerate(names):
        person.type(name)
        person.press(Key.Key_Return)
        if name != names[-1]:
            person.press(Key.Key_Tab)
            person.type(f"Op{number}")
            person.press(Key.Key_Tab)
    places = person.window.canvas.positions
    assert list(places) == names
    rows = [[name for name in names if places[name][1] == y]
            for y in dict.fromkeys(y for _, y in places.values())]  # fmt: skip
    assert len(rows) > 1
    assert max(map(len, rows)) <= max(4, view.width() // 218)
    for row, after in itertools.pairwise(rows):
        assert places[row[-1]][0] == places[after[0]][0], "the next row begins below"
    steps = [places[b][0] - places[a][0] for row in rows[:2] for a, b in itertools.pairwise(row)]
    assert steps[0] > 0 > steps[-1], "and leads back"
