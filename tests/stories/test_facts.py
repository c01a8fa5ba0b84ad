"""The table of facts: what each digit is, edited in place; added, moved and deleted."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QHelpEvent, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.studio.base.paint.node_paint import chip_places
from smsl_studio.studio.features.draw.facts.cells import WIDE
from smsl_studio.studio.features.draw.facts.panel import Facts
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key = Qt.Key
REGISTRATION, HFSM = SAMPLES / "registration.json", SAMPLES / "hfsm.json"
ALT, SHIFT = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ShiftModifier


def facts(person: Person) -> Facts:
    """The panel, laid out as it is seen."""
    panel = person.window.facts
    person.until(lambda: not panel.view.isVisible() or not panel.view.rect_of(0, "name").isEmpty())
    return panel


def click_cell(person: Person, digit: int, kind: str, value: str = "") -> None:
    view = facts(person).view
    view.scrollTo(view.facts.index(digit))
    place = view.rect_of(digit, kind, value).center()
    assert view.viewport().rect().contains(place), f"{kind} of fact {digit} is not in view"
    QTest.mouseClick(view.viewport(), LEFT, pos=place)


def write(person: Person, text: str) -> None:
    """Type over the cell that is open, and press Enter."""
    field = facts(person).view.field
    person.until(field.isVisible)
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Key.Key_Return)


def note(person: Person, digit: int = 0) -> FactNote:
    found = person.blueprint[person.window.session.branch].fact_note(digit)
    return found or FactNote()


def test_a_click_on_a_cell_edits_it_as_one_step(sit: Sit) -> None:
    person = sit(REGISTRATION)
    before = person.blueprint.document.text
    for kind, value, text in (
        ("name", "", "Plan ready"),
        ("meaning", "1", "planned"),
        ("unit", "", "mm"),
        ("source", "", "probe, camera"),
        ("age", "", "0.5"),
    ):
        click_cell(person, 0, kind, value)
        write(person, text)
    assert note(person) == FactNote(
        name="Plan ready", values={"1": "planned"}, unit="mm", sensors=("probe", "camera"),
        max_age=0.5,
    )  # fmt: skip
    assert len(person.steps()) == 5
    line = facts(person).view.facts.lines[0]
    assert line.words == (
        "Plan ready, digit 0, 0, 1 planned, read by probe, camera, maximum age 0.5 s, unit mm"
    )
    for _ in range(5):
        person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_a_letter_begins_a_new_text_in_the_chosen_cell(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.window.actions_table["show_facts"].trigger()
    view = facts(person).view
    assert view.hasFocus()
    QTest.keyClicks(view, "d")
    QTest.keyClicks(view.field, "isk 1")
    QTest.keyClick(view.field, Key.Key_Tab)
    QTest.keyClick(view.field, Key.Key_Escape)
    assert note(person).name == "disk 1"
    person.ctrl(Key.Key_Z)
    assert note(person).name != "disk 1"


def test_tab_goes_through_the_cells_of_a_fact_and_on_to_the_next_fact(sit: Sit) -> None:
    person = sit(HFSM)
    click_cell(person, 0, "name")
    view = facts(person).view
    visited = []
    for text in ("Plan", "mm", "no", "yes"):
        assert view.looks.edited is not None
        visited.append(view.looks.edited)
        QTest.keyClicks(view.field, text)
        QTest.keyClick(view.field, Key.Key_Tab)
    assert visited == [(0, ("name", "")), (0, ("unit", "")), (0, ("meaning", "0")),
                       (0, ("meaning", "1"))]  # fmt: skip
    hints = []
    while view.looks.edited is not None and view.looks.edited[0] == 0:
        hints.append(view.field.placeholderText())
        QTest.keyClick(view.field, Key.Key_Tab)
    assert view.looks.edited == (1, ("name", ""))
    assert hints == ["sensor", "age"], "the open field says what is typed there"
    assert view.field.placeholderText() == "Fact 2"
    QTest.keyClicks(view.field, "Clamp")
    click_cell(person, 2, "name")
    QTest.keyClicks(view.field, "Door")
    click_cell(person, 1, "name")
    QTest.keyClicks(view.field, "Gate")
    QTest.keyClick(view.field, Key.Key_Return)
    branch = person.blueprint["SB1"]
    assert [branch.fact_name(digit) for digit in range(3)] == ["Plan", "Gate", "Door"]


def test_tab_names_one_fact_after_the_other_in_properties(sit: Sit) -> None:
    person = sit(HFSM)
    rows = person.window.properties.header.facts
    person.click(rows[0].name)
    rows[0].name.selectAll()
    for name in ("Plan", "Clamp"):
        person.type(name)
        person.press(Key.Key_Tab)
    person.until(rows[2].name.hasFocus)
    person.press(Key.Key_Backtab, [SHIFT])
    person.until(rows[1].name.hasFocus)
    person.type("Gate")
    person.press(Key.Key_Return)
    branch = person.blueprint["SB1"]
    assert [branch.fact_name(digit) for digit in range(2)] == ["Plan", "Gate"]


def test_tab_goes_to_the_next_cell_and_escape_gives_up(sit: Sit) -> None:
    person = sit(REGISTRATION)
    click_cell(person, 0, "name")
    view = facts(person).view
    QTest.keyClicks(view.field, "Plan")
    QTest.keyClick(view.field, Key.Key_Return)
    click_cell(person, 0, "unit")
    QTest.keyClicks(view.field, "mm")
    QTest.keyClick(view.field, Key.Key_Tab, SHIFT)
    assert view.looks.edited == (0, ("name", ""))
    QTest.keyClicks(view.field, "Something else")
    QTest.keyClick(view.field, Key.Key_Escape)
    assert (note(person).name, note(person).unit) == ("Plan", "mm")
    assert not view.field.isVisible()
    assert view.hasFocus()


def test_the_keyboard_alone_reaches_every_cell(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.ctrl(Key.Key_T)
    view = facts(person).view
    assert view.hasFocus()
    person.press(Key.Key_Down)
    person.press(Key.Key_Return)
    write(person, "Digitized")
    assert note(person, 1).name == "Digitized"
    person.press(Key.Key_Right)
    assert "harmed" in view.accessibleDescription()
    person.press(Key.Key_Space)
    assert note(person, 1).critical
    person.press(Key.Key_Left)
    assert view.accessibleDescription() == "The plain name of the fact: Digitized"
    person.ctrl(Key.Key_T)
    assert person.window.canvas.hasFocus()


def test_a_value_counts_as_on_or_as_a_failure(sit: Sit) -> None:
    person = sit(REGISTRATION)
    click_cell(person, 0, "value", "0")
    person.choose_in_menu("means failure")
    assert note(person).failure == ("0",)
    click_cell(person, 0, "value", "0")
    person.choose_in_menu("counts as on")
    assert note(person).on == "0"
    assert [one.kind for one in facts(person).view.facts.lines[0].values] == ["on", "off"]
    click_cell(person, 0, "value", "1")
    person.choose_in_menu("counts as on")
    assert note(person).on is None


def test_an_age_that_is_no_number_is_refused(sit: Sit) -> None:
    person = sit(REGISTRATION)
    told: list[str] = []
    person.window.session.refused.connect(lambda error: told.append(error.sentence))
    click_cell(person, 0, "age")
    write(person, "soon")
    assert told == ["'soon' is no number of seconds"]
    assert person.steps() == []


def test_a_sub_sb_stands_in_the_place_of_the_sensor_and_a_click_shows_it(sit: Sit) -> None:
    person = sit(HFSM)
    line = facts(person).view.facts.lines[1]
    assert (line.sub, line.age) == ("SB2", "")
    click_cell(person, 1, "digit")
    assert person.window.session.fact == ("SB1", 1)
    click_cell(person, 1, "sub")
    assert person.window.session.branch == "SB2"
    assert len(facts(person).view.facts.lines) == 1


def test_adding_a_fact_first_says_how_many_states_change(sit: Sit) -> None:
    person = sit(REGISTRATION)
    panel, before = facts(person), person.blueprint.document.text
    person.click(panel.add)
    assert panel.card.words.text() == "Digit 4 is added. 8 states change."
    assert panel.card.names[0].text() == "State_0000 → State_00000"
    assert panel.card.rest.text() == "and 4 more"
    assert person.blueprint.document.text == before
    person.click(panel.card.value)
    person.type("10")
    assert "could not be cut" in panel.card.words.text()
    assert not panel.card.agree.isEnabled()
    person.press(Key.Key_Backspace)
    person.press(Key.Key_Return)
    assert "State_00001" in person.blueprint["REGISTRATION"].table
    write(person, "Drape sealed")
    assert note(person, 4).name == "Drape sealed"
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_a_fact_is_deleted_after_its_effect_was_told(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "two.json"
    path.write_text(json.dumps({"A": {"State_00": {"go": "State_01"}, "State_01": {}}}))
    person = sit(path)
    panel = facts(person)
    click_cell(person, 0, "name")
    person.press(Key.Key_Escape)
    person.press(Key.Key_Down)
    person.press(Key.Key_Delete)
    assert "would have the same facts" in panel.card.words.text()
    person.press(Key.Key_Escape)
    assert not panel.card.isVisible()
    person.press(Key.Key_Up)
    person.press(Key.Key_Delete)
    assert panel.card.names[1].text() == "State_01 → State_1"
    person.press(Key.Key_Return)
    assert list(person.blueprint["A"].table) == ["State_0", "State_1"]
    assert person.steps() == ["Delete Fact 1 of A"]


def test_a_fact_is_moved_by_keys_and_by_the_pointer_after_its_effect_was_told(sit: Sit) -> None:
    person = sit(HFSM)
    panel, before = facts(person), person.blueprint.document.text
    click_cell(person, 1, "meaning", "1")
    person.press(Key.Key_Escape)
    person.press(Key.Key_Up, [ALT])
    assert panel.card.words.text() == "“Fact 2” becomes digit 0. 1 state changes."
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].subs == {0: "SB2"}
    assert panel.view.currentIndex().row() == 0
    drag_digit(person, 0, 1)
    person.until(panel.card.isVisible)
    person.click(panel.card.agree)
    assert person.blueprint.document.text == before
    assert person.steps()[-1] == "Move Fact 1 of SB1 to digit 1"


def drag_digit(person: Person, digit: int, place: int) -> None:
    """Drag the digit of a fact below another fact."""
    view = facts(person).view
    start = view.rect_of(digit, "digit").center()
    end = view.visualRect(view.facts.index(place)).bottomLeft() + QPoint(20, -4)
    kind = QEvent.Type
    for what, at in (
        (kind.MouseButtonPress, start), (kind.MouseMove, (start + end) / 2),
        (kind.MouseMove, end), (kind.MouseButtonRelease, end),
    ):  # fmt: skip
        held = Qt.MouseButton.NoButton if what == kind.MouseButtonRelease else LEFT
        acting = Qt.MouseButton.NoButton if what == kind.MouseMove else LEFT
        where = QPointF(view.viewport().mapToGlobal(at))
        none = Qt.KeyboardModifier.NoModifier
        QApplication.sendEvent(
            view.viewport(), QMouseEvent(what, QPointF(at), where, acting, held, none)
        )


def test_a_new_blueprint_may_begin_with_its_facts(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "new.json"
    path.write_text('{"A": {}}')
    person = sit(path)
    panel = person.window.facts
    person.until(panel.first.isVisible)
    assert (panel.none.text(), panel.first.text()) == ("No facts yet.", "Add the first fact")
    person.click(panel.first)
    write(person, "Clamp fixed")
    click_cell(person, 0, "meaning", "1")
    write(person, "fixed")
    assert note(person) == FactNote(name="Clamp fixed", values={"1": "fixed"})
    person.window.drawing.add_state()
    person.press(Key.Key_Return)
    assert list(person.blueprint["A"].table) == ["State0"]


def test_a_wide_panel_is_a_table_of_five_columns(sit: Sit) -> None:
    person = sit(HFSM)
    window, view = person.window, facts(person).view
    low = view.visualRect(view.facts.index(0)).height()
    window.resizeDocks([window.docks.left], [WIDE + 60], Qt.Orientation.Horizontal)
    person.until(lambda: view.looks.width >= WIDE)
    person.until(lambda: view.visualRect(view.facts.index(0)).height() < low)
    click_cell(person, 0, "name")
    write(person, "Clamp fixed")
    assert note(person).name == "Clamp fixed"


def test_thousands_of_states_and_names_of_10_000_characters(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "long.json"
    long = "State_" + "01" * 4_997
    wide: dict[str, dict[str, str]] = {f"State_{at:04}": {} for at in range(6_561)}
    path.write_text(json.dumps({"LONG": {long: {}}, "WIDE": wide, "ODD": {"a": {}, "bc": {}}}))
    person = sit(path)
    panel = facts(person)
    assert len(panel.view.facts.lines) == 200
    assert "The first 200 of 9,994 facts." in panel.hint.text()
    person.window.session.show_branch("WIDE")
    person.click(panel.add)
    assert panel.card.words.text() == "Digit 4 is added. 6,561 states change."
    person.press(Key.Key_Escape)
    person.window.session.show_branch("ODD")
    assert panel.first.isVisible()
    person.click(panel.first)
    assert panel.card.words.text() == (
        "Digit 0 is added. 2 states keep their names; the value stands beside."
    )
    person.click(panel.card.agree)
    assert person.blueprint["ODD"].facts("bc") == ("0",)


@pytest.mark.parametrize("text", ["<b>bold</b>", "a & b"])
def test_names_are_shown_as_they_are(sit: Sit, text: str) -> None:
    person = sit(HFSM)
    click_cell(person, 0, "name")
    write(person, text)
    assert note(person).name == text
    assert text in str(facts(person).view.facts.index(0).data())


def test_a_chip_on_the_canvas_tells_what_its_value_means(sit: Sit) -> None:
    person = sit(HFSM)
    click_cell(person, 0, "meaning", "1")
    write(person, "fixed")
    canvas = person.window.canvas
    sheet = canvas.sheet
    assert sheet is not None
    state = sheet.picture.index["State100"]
    chips = chip_places(sheet.picture.face(state), sheet.ink, float(sheet.full_widths[state]))

    def tip_at(digit: int) -> str:
        at = chips[digit].center() + QPointF(*sheet.at[state])
        place = person.on_canvas(at)
        person.move_to(place)
        viewport = canvas.viewport()
        rest = QHelpEvent(QEvent.Type.ToolTip, place, viewport.mapToGlobal(place))
        QApplication.sendEvent(viewport, rest)
        return QToolTip.text()

    assert tip_at(0) == "Fact 1: fixed (1)"
    assert tip_at(1) == "Fact 2: 0\nExpanded by SB2"
    person.move_to(person.place("State100") - QPoint(0, 14))
    assert canvas.viewport().toolTip() == "", "the node says it"


def test_words_instead_of_digits_are_a_view_that_is_remembered(sit: Sit) -> None:
    person = sit(HFSM)
    click_cell(person, 0, "meaning", "1")
    write(person, "fixed")
    text = person.blueprint.document.text
    action = person.window.actions_table["words"]
    action.trigger()
    assert shown_chips(person) == ["fixed", "Fact 2: 0", "0"]  # the third has no room
    assert action.isChecked()
    assert person.blueprint.document.text == text
    again = sit(HFSM)
    assert again.window.canvas.words
    again.window.actions_table["words"].trigger()
    assert shown_chips(again) == ["1", "0", "0"]


def test_where_no_fact_has_words_the_digits_stay_and_this_is_said(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    before = shown_chips(person)
    person.window.actions_table["words"].trigger()
    assert shown_chips(person) == before
    assert "has a name or a meaning yet" in person.window.canvas.overlays.word.text


def shown_chips(person: Person) -> list[str]:
    sheet = person.window.canvas.sheet
    assert sheet is not None
    return [chip.text for chip in sheet.picture.face(1).chips]


def test_facts_are_copied_and_pasted_as_a_table(sit: Sit) -> None:
    person = sit(HFSM)
    before = person.blueprint.document.text
    QGuiApplication.clipboard().setText("Clamp\t0 = open; 1 = fixed\nTool\nDrape\nLamp")
    click_cell(person, 0, "name")
    person.press(Key.Key_Escape)
    person.ctrl(Key.Key_V)
    card = facts(person).card
    assert card.words.text() == "4 facts are filled, 1 of them new. 4 states change."
    person.press(Key.Key_Return)
    shown = person.blueprint["SB1"]
    assert [shown.fact_name(digit) for digit in range(4)] == ["Clamp", "Tool", "Drape", "Lamp"]
    assert "State1110" in shown.table
    person.ctrl(Key.Key_C)
    assert "0\tClamp\t0 = open; 1 = fixed" in QGuiApplication.clipboard().text()
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before
    QGuiApplication.clipboard().setText("9999\tClamp")
    person.ctrl(Key.Key_V)
    assert "has 3 facts" in card.words.text()


def test_facts_are_in_sight_in_a_window_on_a_screen_of_1280(sit: Sit) -> None:
    person = sit(REGISTRATION, (1264, 768))
    person.until(lambda: person.window.width() == 1264)
    assert person.window.docks.left.isVisible()
    view = facts(person).view
    for value in "01":
        rect = view.rect_of(0, "meaning", value)
        assert view.viewport().rect().contains(rect)
    person.window.resize(1240, 768)
    person.until(lambda: not person.window.docks.left.isVisible())


def test_a_typed_meaning_moves_no_other_cell(sit: Sit) -> None:
    person = sit(REGISTRATION, (1280, 800))
    view = facts(person).view

    def places() -> list[object]:
        kinds = (("value", "0"), ("meaning", "0"), ("value", "1"), ("meaning", "1"), ("source", ""))
        return [view.rect_of(digit, *kind) for digit in (0, 1) for kind in kinds]

    before = places()
    for value, text in (("0", "no"), ("1", "yes"), ("0", "off now")):
        click_cell(person, 0, "meaning", value)
        write(person, text)
        assert places() == before
    click_cell(person, 0, "meaning", "1")
    write(person, "the landmarks are planned")
    assert note(person).values == {"0": "off now", "1": "the landmarks are planned"}
    first, second = (view.rect_of(0, "meaning", value) for value in "01")
    assert second.top() > first.bottom(), "a long meaning has a line of its own"
