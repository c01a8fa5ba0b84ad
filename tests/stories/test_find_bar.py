"""Find in the drawing, from hit to hit, with the bar above the canvas."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import Level
from smsl_studio.studio.features.draw.find.bar import DrawingFindBar
from smsl_studio.studio.features.draw.find.drawing_index import EVERYTHING, FACTS_TOO
from tests.graph.test_layout import hanoi
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"
SHIFT = [Qt.KeyboardModifier.ShiftModifier]


@pytest.fixture
def noted(tmp_path: Path) -> Path:
    """A file with titles, a note, facts with meanings, and a hazard."""
    values = json.loads(HFSM.read_text())
    values["SB1"]["_states"] = {
        "State100": {"title": "Table", "note": "The drape sensor drifts when warm"},
        "State110": {"title": "Tracker and tool"},
    }
    values["SB1"]["_operations"] = {"Operation100A": {"title": "Mount tool"}}
    meanings = {"0": "open", "1": "fixed"}
    values["SB1"]["_facts"] = {"0": {"name": "Clamp", "values": meanings}, "2": {"name": "Drape"}}
    values["SB2"]["_states"] = {"State1": {"title": "Tool is locked"}}
    values["_hazards"] = [{"name": "Drape off", "facts": {"SB1/2": "1"}}]
    path = tmp_path / "noted.json"
    path.write_text(json.dumps(values, indent=4))
    return path


def bar_of(person: Person) -> DrawingFindBar:
    return person.window.features.draw.search.bar


def find(person: Person, text: str) -> DrawingFindBar:
    """Type into the bar, and wait until it was searched."""
    bar = bar_of(person)
    if bar.isHidden():
        person.ctrl(Key.Key_F)
    person.until(bar.field.hasFocus)
    bar.field.selectAll()
    person.type(text)
    settle(person)
    return bar


def settle(person: Person) -> None:
    """Wait until no search is due."""
    search = person.window.features.draw.search
    person.until(lambda: not search.due)


def is_in_the_middle(person: Person, address: str) -> bool:
    place, view = person.place(address), person.window.canvas.viewport().rect()
    return (place - view.center()).manhattanLength() <= 3


def test_typing_goes_to_a_hit_and_enter_to_the_next_across_branches(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    bar = find(person, "tool")
    assert bar.count.text() == "1 of 3"
    assert bar.found.words == "Found in title “Tracker and tool”"
    assert person.selected() == ["SB1/State110"]
    person.press(Key.Key_Return)
    assert (bar.count.text(), bar.found.words) == ("2 of 3", "Found in title “Mount tool”")
    assert person.selected() == ["SB1/State100/Operation100A"]
    person.press(Key.Key_Return)
    assert person.window.session.branch == "SB2"
    assert person.selected() == ["SB2/State1"]
    person.press(Key.Key_Return)
    assert bar.count.text() == "1 of 3", "after the last comes the first"
    person.press(Key.Key_Return, SHIFT)
    assert bar.count.text() == "3 of 3"
    person.click(bar.back)
    assert bar.count.text() == "2 of 3"
    person.click(bar.on)
    assert bar.count.text() == "3 of 3"
    assert person.steps() == [], "to find changes nothing"


def test_typing_stays_in_the_branch_that_is_shown(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    bar = find(person, "locked")
    assert person.window.session.branch == "SB1"
    assert bar.found.words == "None in SB1. Enter goes to SB2"
    person.press(Key.Key_Return)
    assert person.window.session.branch == "SB2"
    assert bar.count.text() == "1 of 1"


def test_a_hit_is_in_the_middle_and_the_zoom_rises_only_if_it_is_low(sit: Sit) -> None:
    person = sit(HANOI)
    canvas = person.window.canvas
    canvas.zoom_to(0.3)
    person.until(lambda: abs(canvas.zoom - 0.3) < 0.001)
    find(person, "State_ccc")
    person.until(lambda: is_in_the_middle(person, "SB1/State_ccc"))
    assert canvas.zoom == pytest.approx(0.7)
    canvas.zoom_to(1.5)
    person.until(lambda: canvas.zoom == pytest.approx(1.5))
    find(person, "State_aaa")
    person.until(lambda: is_in_the_middle(person, "SB1/State_aaa"))
    assert canvas.zoom == pytest.approx(1.5)


def test_an_operation_is_in_the_middle_too(sit: Sit) -> None:
    person = sit(HANOI)
    canvas = person.window.canvas
    canvas.zoom_to(0.3)
    person.until(lambda: abs(canvas.zoom - 0.3) < 0.001)
    find(person, "Op_3c")
    (shown,) = person.selected()
    person.until(lambda: is_in_the_middle(person, shown))


def test_the_hit_and_the_others_are_marked_until_escape_which_keeps_the_place(
    sit: Sit, noted: Path
) -> None:
    person = sit(noted)
    bar = find(person, "tool")
    marks = person.window.canvas.marks
    assert marks.hit == Address("SB1", "State110")
    assert set(map(str, marks.found)) == {"SB1/State110", "SB1/State100/Operation100A"}
    person.press(Key.Key_Escape)
    assert bar.isHidden()
    assert person.window.canvas.hasFocus()
    assert person.selected() == ["SB1/State110"]
    assert person.window.canvas.zoom == 1.0
    marks = person.window.canvas.marks
    assert (marks.hit, marks.found) == (None, ())
    person.ctrl(Key.Key_F)
    assert (bar.field.text(), bar.count.text()) == ("tool", "1 of 3"), "it goes on from there"


def test_what_is_found_nowhere_is_said_in_the_words_of_the_scope(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    bar = find(person, "zebra")
    assert bar.found.words == "No state or operation has “zebra”"
    assert bar.count.text() == "0 of 0"
    assert not bar.on.isEnabled()
    person.press(Key.Key_Return)
    assert person.selected() == []
    bar.scope.setCurrentIndex(FACTS_TOO)
    person.until(lambda: bar.found.words == "No state, operation, fact or note has “zebra”")


@pytest.mark.parametrize(
    ("scope", "typed", "said"),
    [
        (FACTS_TOO, "drifts", "Found in description “The drape sensor drifts when warm”"),
        (FACTS_TOO, "fixed", "Found in fact, meanings “open, fixed”"),
        (EVERYTHING, "drape off", "Found in hazard, name “Drape off”"),
        (EVERYTHING, "SB2", "Found in state branch, name “SB2”"),
    ],
)
def test_the_scope_adds_facts_notes_hazards_and_branches(
    sit: Sit, noted: Path, scope: int, typed: str, said: str
) -> None:
    person = sit(noted)
    find(person, typed)
    bar = bar_of(person)
    assert said != bar.found.words
    bar.scope.setCurrentIndex(scope)
    settle(person)
    if bar.found.words != said:
        bar.field.setFocus()
        person.press(Key.Key_Return)
    assert bar.found.words == said
    assert bar.field.hasFocus()


def test_findings_and_the_library_are_found(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    find(person, "R15")
    bar = bar_of(person)
    bar.scope.setCurrentIndex(EVERYTHING)
    settle(person)
    bar.field.setFocus()
    person.press(Key.Key_Return)
    assert bar.found.words == "Found in finding, rule “R15”"
    assert person.selected()[0].startswith("SB1/State_cb")
    offered = person.window.library.offered[0]
    find(person, offered)
    person.press(Key.Key_Return)
    while not bar.found.words.startswith("Found in library"):
        person.press(Key.Key_Return)
        assert not bar.count.text().startswith("1 of"), "all hits were shown"
    chosen = person.window.library.list.currentIndex()
    assert chosen.data() == offered


def test_states_are_found_by_the_values_of_their_facts(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    bar = find(person, "clamp = fixed")
    assert bar.count.text() == "1 of 3"
    assert bar.found.words == "Found in facts “Clamp is fixed”"
    bar = find(person, "clamp = 1, drape != 1")
    assert bar.count.text().endswith("of 2")
    bar = find(person, "clamp = 7")
    assert bar.found.words == "Clamp is never “7”. Its values: 0, 1"
    bar = find(person, "lamp = 1")
    assert bar.found.words == "No fact is called “lamp”. Facts here: Clamp, Fact 2, Drape"


def test_the_hits_follow_edits_and_undo(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    bar = find(person, "tool")
    session = person.window.session
    address = Address("SB1", "State110")
    session.edit("Rename", lambda bp: editing.rename(bp, address, "State_tooth"))
    person.until(lambda: bar.count.text() == "3" or bar.count.text().endswith("of 3"))
    session.edit("Delete", lambda bp: editing.delete(bp, (Address("SB1", "State_tooth"),)))
    person.until(lambda: bar.count.text().split()[-1] == "1")
    assert "Mount" not in bar.found.words
    session.history.undo()
    session.history.undo()
    person.until(lambda: bar.count.text().split()[-1] == "3")
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/State110"]


def test_a_narrow_window_has_the_words_in_a_second_row_and_nothing_is_cut(
    sit: Sit, noted: Path
) -> None:
    person = sit(noted, size=(900, 560))
    bar = find(person, "tool")
    for part in (bar.field, bar.back, bar.on, bar.scope, bar.found, bar.shut):
        assert part.isVisible(), part.accessibleName()
        left, right = part.mapTo(bar, QPoint(0, 0)), part.mapTo(bar, part.rect().bottomRight())
        assert bar.rect().contains(left), part.accessibleName()
        assert bar.rect().contains(right), part.accessibleName()
    assert bar.height() == 80
    person.window.resize(1440, 900)
    person.until(lambda: bar.height() == 40)


def test_a_large_blueprint_answers_and_shows_dots_from_afar(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "large.json"
    path.write_text(json.dumps({"SB1": {"HEADER": {}, **hanoi(6)}}))
    person = sit(path)
    canvas = person.window.canvas
    bar = find(person, "Fact 2 = b")
    assert bar.count.text() == "1 of 243"
    canvas.fit(smooth=False)
    assert canvas.sheet is not None
    assert canvas.sheet.level < Level.COMPACT
    assert len(canvas.marks.found) == 243
    find(person, "Op")
    assert bar.count.text() == "1 of 2,184"
    assert not canvas.marks.found, "too many operations for a sign each"


def test_ctrl_f_opens_the_bar_from_every_panel_and_the_source_keeps_its_own(sit: Sit) -> None:
    person = sit(HFSM)
    window = person.window
    bar, source = bar_of(person), window.source
    for tab in ("Facts", "Library", "Outline", "Properties", "Findings", "History"):
        window.show_tab(tab)
        window.docks.panel(tab).setFocus()
        person.ctrl(Key.Key_F)
        assert bar.isVisible(), tab
        assert bar.field.hasFocus()
        person.press(Key.Key_Escape)
        assert bar.isHidden()
    window.show_tab("Source")
    source.editor.setFocus()
    person.ctrl(Key.Key_F)
    assert bar.isHidden()
    inside = QApplication.focusWidget()
    assert inside is not None
    assert source.isAncestorOf(inside)


def test_the_bar_has_its_keys_and_f3_stays_with_the_findings(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    bar = find(person, "State_aaa")
    person.ctrl(Key.Key_F)
    assert bar.field.selectedText() == "State_aaa"
    person.press(Key.Key_F3)
    assert person.selected()[0].startswith("SB1/State_cb")
    bar.field.setFocus()
    person.press(Key.Key_Tab)
    assert bar.back.hasFocus()
    person.press(Key.Key_Escape)
    assert bar.isHidden()


@pytest.mark.parametrize("closed", [True, False])
def test_alt_and_left_lead_back_to_where_the_find_began(
    sit: Sit, noted: Path, closed: bool
) -> None:
    person = sit(noted)
    canvas = person.window.canvas
    canvas.camera.motion = False
    person.select("SB1/State100")
    canvas.zoom_to(1.25)
    canvas.camera.pan(40.0, -30.0)
    before = canvas.camera.stand
    find(person, "locked")
    person.press(Key.Key_Return)
    assert person.window.session.branch == "SB2"
    if closed:
        person.press(Key.Key_Escape)
    person.press(Key.Key_Left, [Qt.KeyboardModifier.AltModifier])
    assert bar_of(person).isHidden()
    assert person.window.session.branch == "SB1"
    assert person.selected() == ["SB1/State100"]
    assert canvas.camera.stand == before
    assert canvas.hasFocus()
    assert not person.window.actions_table["find_back"].isEnabled()


def test_the_zoom_stays_if_a_hit_can_be_read_at_it(sit: Sit) -> None:
    person = sit(HANOI)
    canvas = person.window.canvas
    canvas.camera.motion = False
    canvas.zoom_to(0.5)
    find(person, "State_ccc")
    assert canvas.viewport().rect().contains(person.place("SB1/State_ccc"))
    assert canvas.zoom == 0.5


def test_a_hit_that_is_in_view_does_not_move_the_drawing(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    canvas = person.window.canvas
    canvas.fit(smooth=False)
    bar = find(person, "state")
    before, shown = canvas.camera.stand, set()
    for _ in range(8):
        shown |= set(person.selected())
        person.press(Key.Key_Return)
        if person.window.session.branch != "SB1":
            break
        assert canvas.camera.stand == before
        assert canvas.outside == 0
    assert len(shown) > 3
    person.press(Key.Key_Escape)
    assert bar.isHidden()


def test_a_hit_below_the_zoom_control_gets_to_the_middle(sit: Sit, noted: Path) -> None:
    person = sit(noted)
    canvas = person.window.canvas
    canvas.camera.motion = False
    canvas.zoom_to(1.0)
    corner = canvas.overlays.map.geometry().center()
    canvas.camera.pan(*(corner - person.place("SB1/State110")).toTuple())
    find(person, "State110")
    assert is_in_the_middle(person, "SB1/State110")
