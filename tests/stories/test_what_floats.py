"""Floating parts over the drawing close when their element is gone or moved."""

from __future__ import annotations

from PySide6.QtCore import Qt

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Modifier = Qt.Key, Qt.KeyboardModifier
HFSM = SAMPLES / "hfsm.json"


def rest_on(person: Person, state: str) -> None:
    """Rest the pointer on a state until its buttons show."""
    pad = person.window.canvas.overlays.pad
    person.move_to(person.place(state))
    person.until(lambda: pad.address == person.blueprint.resolve(state))


def test_the_buttons_of_a_state_go_when_it_is_undone(sit: Sit) -> None:
    person = sit()
    person.press(Key.Key_N, [Modifier.ControlModifier, Modifier.ShiftModifier])
    person.press(Key.Key_Return)
    rest_on(person, "SB1/State0")
    person.ctrl(Key.Key_Z)
    assert not person.blueprint["SB1"].table
    assert person.window.canvas.overlays.pad.isHidden()


def test_the_buttons_of_a_state_go_when_it_is_moved_back(sit: Sit) -> None:
    person = sit(HFSM)
    centre = person.place("SB1/State100")
    person.drag(centre, centre + (person.place("SB1/State000") - centre) / 4)
    rest_on(person, "SB1/State100")
    person.ctrl(Key.Key_Z)
    assert person.window.canvas.overlays.pad.isHidden()


def test_a_connection_that_was_begun_ends_where_another_state_branch_is_shown(sit: Sit) -> None:
    person = sit(HFSM)
    overlays = person.window.canvas.overlays
    rest_on(person, "SB1/State000")
    person.click(overlays.pad.connect_to)
    assert "Click the target state" in overlays.word.text
    person.press(Key.Key_Return)
    assert person.window.session.branch == "SB2"
    assert overlays.word.text == ""
    person.click_canvas(person.place("SB2/State1"))
    assert person.window.editor.field is None
    assert person.steps() == []


def test_why_a_move_was_refused_stays_beside_the_state(sit: Sit) -> None:
    person = sit(HFSM)
    session = person.window.session
    centre = person.place("SB1/State100")
    text = session.blueprint.document.text
    session.write("Type", text.replace('"State000"', '"State', 1))
    assert session.broken is not None
    person.drag(centre, centre + (person.place("SB1/State000") - centre) / 4)
    assert person.window.canvas.overlays.word.text
