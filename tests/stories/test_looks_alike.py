"""No two states look alike: neither a proposed name nor a drawn one."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt

from smsl_studio.blueprint.editing import add_state
from smsl_studio.blueprint.facts import fact_string
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, sample

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE = SAMPLES / "hanoi-corrected.json"


def _low(person: Person) -> QPoint:
    view = person.window.canvas.viewport()
    return QPoint(view.width() // 2, view.height() - 90)


def _facts(person: Person) -> list[str]:
    return [fact_string(state, None) for state in person.blueprint["SB1"].table]


def test_the_name_after_a_typed_one_has_facts_of_its_own(sit: Sit) -> None:
    person = sit(FILE)
    person.double_click_canvas(_low(person))
    person.type("dda")
    person.press(Key.Key_Return)
    person.press(Key.Key_Tab)
    person.press(Key.Key_Return)
    person.press(Key.Key_Escape)
    facts = _facts(person)
    assert len(set(facts)) == len(facts)
    person.press(Key.Key_N, [Ctrl, Shift])
    person.press(Key.Key_Return)
    more = _facts(person)
    assert len(more) == len(facts) + 1
    assert len(set(more)) == len(more)


def test_two_states_with_the_same_facts_are_drawn_with_their_names(sit: Sit) -> None:
    person = sit(FILE)
    person.window.session.edit("Add", lambda bp: add_state(bp, "SB1", "aaa"))
    sheet = person.window.canvas.sheet
    assert sheet is not None
    picture = sheet.picture
    shown = {face.name: face.short for face in map(picture.face, range(len(picture.names)))}
    assert (shown["aaa"], shown["State_aaa"]) == ("aaa", "State_aaa")
    assert shown["State_baa"] == "baa"


def test_a_sample_is_shortened_as_before() -> None:
    branch = sample("hanoi-corrected.json")["SB1"]
    facts = [fact_string(state, None) for state in branch.table]
    assert len(set(facts)) == len(facts)
