"""Adding a state does not change which state is activating, and the window says so."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.rules.finding import Severity
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE = SAMPLES / "hanoi-corrected.json"


def errors(person: Person) -> set[str]:
    """The states that have errors."""
    person.until_inspected()
    found = person.window.findings.findings
    return {finding.address.state for finding in found if finding.severity is Severity.ERROR}


def test_an_added_state_does_not_become_the_activating_one_unsaid(sit: Sit) -> None:
    person = sit(FILE)
    before, text = errors(person), person.blueprint.document.text
    held = person.blueprint["SB1"].activating
    person.press(Key.Key_N, [Ctrl, Shift])
    person.type("State_aab2")
    person.press(Key.Key_Return)
    assert len(person.blueprint["SB1"].table) == 28
    assert person.blueprint["SB1"].activating == held
    toast = person.window.toast
    assert toast.words.startswith(f"{held} stays the activating state of SB1")
    assert errors(person) - before <= {"State_aab2"}
    assert len(person.steps()) == 1
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text
    assert not toast.isVisible()


def test_the_message_covers_neither_the_new_state_nor_its_operation(sit: Sit) -> None:
    person = sit(FILE)
    canvas, toast = person.window.canvas, person.window.toast
    low = QPoint(canvas.viewport().width() // 2, canvas.viewport().height() - 90)
    person.double_click_canvas(low)
    person.type("State_aab2")
    person.press(Key.Key_Return)
    assert toast.isVisible()
    covered = QRect(toast.mapToGlobal(QPoint()), toast.size())
    node = canvas.place_of(Address("SB1", "State_aab2"))
    assert QRect(canvas.viewport().mapToGlobal(QPoint()), canvas.viewport().size()).contains(node)
    assert not covered.intersects(node)


def test_what_is_pasted_or_drawn_to_empty_canvas_takes_nothing_over(sit: Sit) -> None:
    person = sit(FILE)
    held = person.blueprint["SB1"].activating
    person.select("SB1/State_aaa")
    person.ctrl(Key.Key_D)
    person.press(Key.Key_Return)
    assert len(person.blueprint["SB1"].table) == 28
    assert person.blueprint["SB1"].activating == held
    person.ctrl(Key.Key_Z)
    person.select("SB1/State_aaa")
    person.press(Key.Key_Slash)
    person.press(Key.Key_Return)
    assert len(person.blueprint["SB1"].table) == 28
    assert person.blueprint["SB1"].activating == held


def test_in_a_new_drawing_it_is_said_once_that_the_last_state_is_activating(sit: Sit) -> None:
    person = sit()
    person.double_click_canvas(QPoint(200, 200))
    told = []
    for name in "ABCDEF":
        person.type(name)
        person.press(Key.Key_Return)
        told.append("listed last" in person.window.toast.words)
        if name != "F":
            person.press(Key.Key_Tab)
            person.type(f"Op{name}")
            person.press(Key.Key_Tab)
    assert told.count(True) == 1
    assert person.blueprint["SB1"].activating == "F"


def test_in_a_new_drawing_a_state_beside_the_way_takes_nothing_over(sit: Sit) -> None:
    person = sit()
    person.double_click_canvas(QPoint(200, 200))
    person.type("A")
    person.press(Key.Key_Tab)
    person.type("go")
    person.press(Key.Key_Tab)
    person.type("B")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].activating == "B"
    for at, name in ((QPoint(200, 420), "Aborted"), (QPoint(420, 420), "Parked")):
        person.double_click_canvas(at)
        person.type(name)
        person.press(Key.Key_Return)
        assert person.blueprint["SB1"].activating == "B"
        told = "B stays the activating state of SB1" in person.window.toast.words
        assert told is (name == "Aborted"), "it is said once"
