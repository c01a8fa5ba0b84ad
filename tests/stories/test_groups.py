"""Groups: a frame with a title around states; dragged, renamed, dissolved, and undone."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu, QPushButton

from smsl_studio.blueprint.annotations import Group
from smsl_studio.blueprint.digests import digests
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from smsl_studio.studio.features.draw.find.drawing_index import FACTS_TOO
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE, SB = SAMPLES / "hfsm.json", "SB1"
PAIR = ("State100", "State110")


@pytest.fixture
def person(sit: Sit) -> Person:
    return sit(FILE)


def groups(person: Person) -> dict[str, Group]:
    return dict(person.blueprint[SB].drawn.groups)


def chosen(person: Person) -> DrawnKey | None:
    return person.window.canvas.drawn.chosen


def keep(person: Person, title: str) -> None:
    """Type a title into the open field, and press Enter."""
    field = person.window.features.draw.notes.field
    assert isinstance(field, NameField)
    person.until(field.field.hasFocus)
    field.field.selectAll()
    person.type(title)
    person.press(Key.Key_Return)


def group(person: Person, *states: str, title: str = "One fact missing") -> str:
    """Group states by keys; returns the key of the group."""
    before = groups(person)
    person.select(*(f"{SB}/{state}" for state in states))
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_G)
    keep(person, title)
    (key,) = groups(person).keys() - before.keys()
    return key


def title_of(person: Person, key: str) -> QPoint:
    """The middle of a title, in pixels of the canvas."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    rect = sheet.drawn.title_rect(DrawnKey("group", key))
    assert rect is not None
    return person.on_canvas(rect.center())


def test_selected_states_get_a_frame_by_keys_alone(person: Person) -> None:
    before = digests(person.blueprint)
    key = group(person, *PAIR)
    assert groups(person)[key] == Group("One fact missing", PAIR)
    assert person.steps() == ["Group 2 states"]
    assert chosen(person) == DrawnKey("group", key)
    assert digests(person.blueprint) == before
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == FILE.read_text()
    assert chosen(person) is None


def test_a_drag_of_the_title_moves_the_states_as_one_step(person: Person) -> None:
    key = group(person, *PAIR)
    places = person.window.canvas.positions
    start = title_of(person, key)
    person.drag(start, start + QPoint(48, 80))
    after = person.window.canvas.positions
    moved = {name for name in after if after[name] != places[name]}
    assert moved == set(PAIR)
    zoom = person.window.canvas.zoom
    for name in PAIR:
        step = after[name][0] - places[name][0], after[name][1] - places[name][1]
        assert abs(step[0] - 48 / zoom) <= 8.0
        assert abs(step[1] - 80 / zoom) <= 8.0
    assert person.steps() == ["Group 2 states", "Move 2 states"]
    assert title_of(person, key) != start
    person.ctrl(Key.Key_Z)
    assert person.window.canvas.positions == places
    assert title_of(person, key) == start


def test_the_frame_follows_a_state_that_is_moved(person: Person) -> None:
    key = group(person, *PAIR)
    sheet = person.window.canvas.sheet
    assert sheet is not None
    before = sheet.drawn.rect(DrawnKey("group", key))
    state = person.place(f"{SB}/State110")
    person.drag(state, state + QPoint(0, -64))
    after = sheet.drawn.rect(DrawnKey("group", key))
    assert before is not None
    assert after is not None
    assert after.top() < before.top()
    assert after.bottom() == before.bottom()


def test_a_double_click_on_the_title_renames_it(person: Person) -> None:
    key = group(person, *PAIR)
    person.double_click_canvas(title_of(person, key))
    keep(person, "Two facts")
    assert groups(person)[key].title == "Two facts"
    assert person.steps()[-1] == "Rename the group One fact missing to Two facts"
    person.press(Key.Key_F2)
    keep(person, "Three")
    assert groups(person)[key].title == "Three"
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert groups(person)[key].title == "One fact missing"


def test_it_is_dissolved_and_its_states_stay(person: Person) -> None:
    key = group(person, *PAIR)
    person.press(Key.Key_G, [Ctrl, Shift])
    assert not groups(person)
    assert sorted(person.selected()) == [f"{SB}/{name}" for name in PAIR]
    person.ctrl(Key.Key_Z)
    person.select(f"{SB}/State110")
    person.press(Key.Key_G, [Ctrl, Shift])
    assert not groups(person)
    person.ctrl(Key.Key_Z)
    person.click_canvas(title_of(person, key))
    person.press(Key.Key_Delete)
    assert not groups(person)
    assert len(person.blueprint[SB].table) == 4
    assert person.steps()[-1] == "Dissolve the group One fact missing"


def test_a_state_stands_in_one_group(person: Person) -> None:
    one = group(person, *PAIR)
    two = group(person, "State110", "State111", title="Other")
    assert groups(person)[one].states == ("State100",)
    assert groups(person)[two].states == ("State110", "State111")
    group(person, "State100", title="Third")
    assert one not in groups(person) or groups(person)[one].title == "Third"


def test_arrows_move_its_states_as_one_step(person: Person) -> None:
    group(person, *PAIR)
    places = person.window.canvas.positions
    for _ in range(3):
        person.press(Key.Key_Right)
    after = person.window.canvas.positions
    assert {name: (x + 24.0, y) for name, (x, y) in places.items() if name in PAIR} == {
        name: after[name] for name in PAIR
    }
    assert person.steps() == ["Group 2 states", "Move 2 states"]


def test_tidy_and_align_keep_notes_and_groups(person: Person) -> None:
    key = group(person, *PAIR)
    state = person.place(f"{SB}/State110")
    person.drag(state, state + QPoint(0, 90))
    person.press(Key.Key_T, [Ctrl, Shift])
    assert groups(person)[key].states == PAIR
    person.select(*(f"{SB}/{name}" for name in PAIR))
    person.window.actions_table["align_top"].trigger()
    assert groups(person)[key].states == PAIR


def test_a_copied_group_is_a_group_of_its_own(person: Person) -> None:
    key = group(person, *PAIR)
    person.press(Key.Key_Escape)
    person.click_canvas(title_of(person, key))
    person.ctrl(Key.Key_D)
    assert len(groups(person)) == 2
    assert not set(groups(person)[key].states) & set(groups(person)["2"].states)


def test_the_menu_at_a_title_and_the_find_bar_know_it(person: Person) -> None:
    key = group(person, *PAIR)
    window = person.window
    window.canvas.drawn_menu_wanted.emit(DrawnKey("group", key), QPoint(5, 5))
    menu = next(one for one in window.findChildren(QMenu) if one.isVisible())
    words = [one.text().partition("\t")[0] for one in menu.actions() if one.text()]
    assert words == ["Rename the group", "Cut", "Copy", "Duplicate", "Dissolve the group"]
    menu.close()
    person.come_back()
    window.canvas.setFocus()
    bar, search = window.features.draw.search.bar, window.features.draw.search
    person.ctrl(Key.Key_F)
    person.until(bar.field.hasFocus)
    bar.scope.setCurrentIndex(FACTS_TOO)
    bar.field.selectAll()
    person.type("fact missing")
    person.until(lambda: not search.due)
    assert search.hits[0].kind == "Group"
    person.press(Key.Key_Return)
    assert chosen(person) == DrawnKey("group", key)


def test_without_a_state_there_is_nothing_to_group(person: Person) -> None:
    actions = person.window.actions_table
    person.window.session.select(())
    actions.refresh()
    assert not actions["group"].isEnabled()
    assert not actions["ungroup"].isEnabled()
    person.select(f"{SB}/State100")
    actions.refresh()
    assert actions["group"].isEnabled()
    assert not actions["ungroup"].isEnabled()


def frame(person: Person, key: str) -> QRectF:
    """The frame of a group, in scene units."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    rect = sheet.drawn.rect(DrawnKey("group", key))
    assert rect is not None
    return rect


def held(person: Person, state: str, to: QPoint) -> None:
    """Drag a state without letting go."""
    hands = person.window.canvas.viewport()
    start = person.place(f"{SB}/{state}")
    QTest.mousePress(hands, Qt.MouseButton.LeftButton, pos=start)
    for share in (0.1, 0.5, 1.0):
        QTest.mouseMove(hands, start + (to - start) * share)


def test_a_state_dragged_into_the_frame_belongs_to_the_group(person: Person) -> None:
    key = group(person, *PAIR)
    before, text = digests(person.blueprint), person.blueprint.document.text
    inside = person.on_canvas(frame(person, key).center())
    word = person.window.canvas.overlays.word
    held(person, "State111", inside)
    assert frame(person, key).contains(QPointF(*person.window.canvas.positions["State111"]))
    assert word.text == "State111 into One fact missing"
    QTest.mouseRelease(person.window.canvas.viewport(), Qt.MouseButton.LeftButton, pos=inside)
    assert word.text == ""
    assert groups(person)[key].states == (*PAIR, "State111")
    assert person.steps() == ["Group 2 states", "Move State111"]
    assert digests(person.blueprint) == before
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text


def test_a_state_dragged_out_of_the_frame_leaves_the_group(person: Person) -> None:
    key = group(person, *PAIR)
    text, whole = person.blueprint.document.text, frame(person, key)
    start = person.place(f"{SB}/State110")
    away = start + QPoint(0, -300)
    held(person, "State110", away)
    assert person.window.canvas.overlays.word.text == "State110 out of One fact missing"
    assert frame(person, key).width() < whole.width()
    QTest.mouseRelease(person.window.canvas.viewport(), Qt.MouseButton.LeftButton, pos=away)
    assert groups(person)[key].states == ("State100",)
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text
    held(person, "State110", away)
    person.press(Key.Key_Escape)
    assert person.blueprint.document.text == text
    assert frame(person, key) == whole


def test_a_state_goes_from_one_group_into_another(person: Person) -> None:
    one = group(person, *PAIR)
    two = group(person, "State111", title="Other")
    inside = person.on_canvas(frame(person, two).center())
    person.drag(person.place(f"{SB}/State110"), inside)
    assert groups(person)[one].states == ("State100",)
    assert groups(person)[two].states == ("State111", "State110")


def test_a_group_that_is_dragged_with_all_its_states_stays_one(person: Person) -> None:
    key = group(person, *PAIR)
    other = group(person, "State111", title="Other")
    person.select(*(f"{SB}/{name}" for name in PAIR))
    inside = person.on_canvas(frame(person, other).center())
    person.drag(person.place(f"{SB}/State110"), inside)
    assert groups(person)[key].states == PAIR
    assert groups(person)[other].states == ("State111",)


def test_copies_of_several_states_stand_beside_them(sit: Sit) -> None:
    """They stood 32 pixels aside, on top of the states they were copied from."""
    person = sit(SAMPLES / "hfsm.json")
    canvas = person.window.canvas
    # A drag writes all places, so that the copies have some, too.
    start = person.place("SB1/State000")
    person.drag(start, start + QPoint(-40, 30))
    before = dict(canvas.positions)
    person.select("SB1/State110", "SB1/State111")
    canvas.setFocus()
    person.ctrl(Key.Key_D)
    copies = [name for name in canvas.positions if name not in before]
    assert len(copies) == 2
    for name in copies:
        x, y = canvas.positions[name]
        away = [(abs(x - a), abs(y - b)) for n, (a, b) in canvas.positions.items() if n != name]
        assert all(dx >= 108 or dy >= 54 for dx, dy in away), name
    person.ctrl(Key.Key_Z)
    assert canvas.positions == before


def test_properties_show_the_selected_group_and_lead_to_its_states(person: Person) -> None:
    key = group(person, *PAIR)
    form = person.window.properties.drawn
    person.until(form.isVisible)
    assert form.title.field.text() == "One fact missing"
    person.write(form.title.field, "Ready")
    assert groups(person)[key].title == "Ready"
    assert chosen(person) == DrawnKey("group", key)
    person.click_row(form.states, "State110")
    assert person.selected() == [f"{SB}/State110"]
    assert not form.isVisible()
    person.click_canvas(title_of(person, key))
    person.until(form.isVisible)
    (dissolve,) = (one for one in form.findChildren(QPushButton) if one.text() == "Dissolve")
    person.click(dissolve)
    assert not groups(person)
    assert not form.isVisible()
