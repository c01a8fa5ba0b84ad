"""The ways between two selected states."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"


def told(person: Person) -> str:
    """What Properties tell about the ways."""
    labels = person.window.properties.several.findChildren(QLabel)
    return next((one.text() for one in labels if one.isVisible() and " to " in one.text()), "")


def lit(person: Person) -> set[str]:
    return set(map(str, person.window.canvas.marks.ways))


def test_the_ways_there_and_back_are_lit_and_told_until_another_selection(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100", "SB1/State110")
    person.click(person.window.properties.several.ways)
    assert told(person) == (
        "State100 to State110: 1 operation, cost 1.\nState110 to State100: 1 operation, cost 1."
    )
    assert lit(person) == {"SB1/State100/Operation100A", "SB1/State110/Operation110A"}
    person.select("SB1/State100")
    assert lit(person) == set()
    assert told(person) == ""
    assert person.steps() == []


def test_no_way_is_said_and_only_two_states_have_ways(sit: Sit) -> None:
    person = sit(HFSM)
    action = person.window.actions_table["show_ways"]
    person.select("SB1/State000")
    assert not action.isEnabled()
    person.select("SB1/State000", "SB1/State111")
    action.trigger()
    assert told(person) == (
        "State000 to State111: 2 operations, cost 2.\nState111 to State000: no way."
    )
    person.select("SB1/State000", "SB1/State111", "SB1/State110")
    assert not action.isEnabled()
    assert lit(person) == set()


def test_the_ways_follow_edits_and_undo(sit: Sit) -> None:
    person = sit(HANOI)
    person.select("SB1/State_aaa", "SB1/State_baa")
    person.window.actions_table["show_ways"].trigger()
    assert lit(person) == {"SB1/State_aaa/Op_1b", "SB1/State_baa/Op_1a"}
    session = person.window.session
    shortcut = (Address("SB1", "State_aaa", "Op_1b"),)
    session.edit("Delete", lambda bp: editing.delete(bp, shortcut))
    assert "SB1/State_aaa/Op_1c" in lit(person)
    assert told(person).startswith("State_aaa to State_baa: 2 operations")
    session.history.undo()
    assert lit(person) == {"SB1/State_aaa/Op_1b", "SB1/State_baa/Op_1a"}
    start = Address("SB1", "State_aaa")
    session.edit("Rename", lambda bp: editing.rename(bp, start, "State_first"))
    assert lit(person) == {"SB1/State_first/Op_1b", "SB1/State_baa/Op_1a"}
    gone = (Address("SB1", "State_first"),)
    session.edit("Delete", lambda bp: editing.delete(bp, gone))
    assert lit(person) == set()


def test_the_ways_are_told_over_the_canvas_while_another_tab_is_shown(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.show_tab("Source")
    person.window.canvas.setFocus()
    person.select("SB1/State100", "SB1/State110")
    person.window.actions_table["show_ways"].trigger()
    assert "State100 to State110: 1 operation" in person.window.toast.words
    person.press(Qt.Key.Key_Escape)
    assert lit(person) == set()
