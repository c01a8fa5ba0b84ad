"""The beginning of an operation's line is dragged to another state."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.canvas.gesture_layer import DrawnOperation
from smsl_studio.studio.base.canvas.handles import tail_of
from tests.stories.at_canvas import LEFT, NONE, SAMPLES, Drawer
from tests.stories.conftest import Sit

Key = Qt.Key
STATE, OP, OTHER = "State000", "Operation000", "State111"
"""An operation of the sample, and a state without operations."""


def tail(drawer: Drawer, state: str, operation: str) -> QPoint:
    edge = drawer.sheet.picture.edge(Address("SB1", state, operation))
    at = tail_of(drawer.sheet, edge)
    assert at is not None
    return drawer.at(at)


def along(drawer: Drawer, state: str, operation: str, pixels: float) -> QPoint:
    """A point on the line, so far from its beginning."""
    shape = drawer.sheet.geometry.shape(
        drawer.sheet.picture.edge(Address("SB1", state, operation)))  # fmt: skip
    return drawer.at(QPointF(*shape.at(pixels / drawer.canvas.zoom)))


def taken(drawer: Drawer, state: str, operation: str) -> None:
    """Press on the beginning of a line, with a pointer that came along the line."""
    for pixels in (60.0, 40.0, 25.0, 15.0):
        drawer.hover(along(drawer, state, operation, pixels))
    at = tail(drawer, state, operation)
    QTest.mouseMove(drawer.hands_on, at)
    QTest.mousePress(drawer.hands_on, LEFT, NONE, at)


def over(drawer: Drawer, place: QPoint) -> DrawnOperation | None:
    """Move what is pressed there; what is drawn then."""
    for by in (QPoint(9, 9), QPoint()):
        QTest.mouseMove(drawer.hands_on, place + by)
        QApplication.processEvents()
    return drawer.canvas.gestures.drawn


def add(blueprint: Blueprint, state: str) -> Blueprint:
    return editing.add_operation(blueprint, "SB1", state, OP, state)


def let_go(drawer: Drawer, place: QPoint) -> None:
    QTest.mouseRelease(drawer.hands_on, LEFT, NONE, place)
    QApplication.processEvents()


@pytest.mark.parametrize("selected", [True, False])
def test_an_operation_starts_where_its_beginning_is_dropped(hfsm: Drawer, selected: bool) -> None:
    target, before = hfsm.table()[STATE][OP], hfsm.session.blueprint
    if selected:
        hfsm.session.select((Address("SB1", STATE, OP),))
    taken(hfsm, STATE, OP)
    tip = QPointF(*hfsm.sheet.geometry.shape(
        hfsm.sheet.picture.edge(Address("SB1", STATE, OP))).tip)  # fmt: skip
    drawn = over(hfsm, hfsm.place(OTHER))
    assert drawn is not None
    assert (drawn.end, drawn.refused) == (tip, False), "it is shown before"
    let_go(hfsm, hfsm.place(OTHER))
    assert OP not in hfsm.table()[STATE]
    assert hfsm.table()[OTHER] == {OP: target}
    assert hfsm.session.selection == (Address("SB1", OTHER, OP),)
    assert hfsm.steps() == 1
    hfsm.session.history.undo()
    assert hfsm.session.blueprint == before
    assert hfsm.session.selection == (Address("SB1", STATE, OP),)


def test_a_state_that_has_the_name_refuses_it_with_words(hfsm: Drawer) -> None:
    hfsm.session.edit("Add", lambda bp: add(bp, OTHER))
    said: list[str] = []
    hfsm.canvas.say = lambda text, at=None: said.append(text)  # type: ignore[method-assign]
    taken(hfsm, STATE, OP)
    drawn = over(hfsm, hfsm.place(OTHER))
    assert drawn is not None
    assert drawn.refused
    assert said[-1] == f"{OTHER} has an operation {OP} already. Rename one of the two first."
    let_go(hfsm, hfsm.place(OTHER))
    assert OP in hfsm.table()[STATE]
    assert hfsm.steps() == 1


def test_on_empty_canvas_and_with_escape_nothing_changes(hfsm: Drawer) -> None:
    taken(hfsm, STATE, OP)
    drawn = over(hfsm, QPoint(20, 650))
    assert drawn is not None
    assert drawn.refused
    let_go(hfsm, QPoint(20, 650))
    taken(hfsm, STATE, OP)
    over(hfsm, hfsm.place(OTHER))
    QTest.keyClick(hfsm.canvas, Key.Key_Escape)
    assert hfsm.canvas.gestures.drawn is None
    let_go(hfsm, hfsm.place(OTHER))
    assert hfsm.steps() == 0


def test_properties_let_it_start_from_another_state_by_keys_alone(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.window.session.select((Address("SB1", STATE, OP),))
    form = person.window.properties.operation
    form.start.setFocus()
    assert form.start.currentText() == STATE
    person.choose(form.start, "State110")
    assert person.selected() == [f"SB1/State110/{OP}"]
    assert form.start.currentText() == "State110"
    assert person.steps() == [f"Let {OP} start from State110"]
    person.window.session.edit("Add", lambda bp: add(bp, OTHER))
    person.choose(form.start, OTHER)
    assert person.selected() == [f"SB1/State110/{OP}"]
    assert form.start.currentText() == "State110", "it was refused, and said so"
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert OP in person.blueprint["SB1"].table[STATE]


def test_a_pointer_from_the_state_still_draws_a_new_operation(hfsm: Drawer) -> None:
    hfsm.session.select((Address("SB1", STATE, OP),))
    hfsm.connect(STATE, OTHER, "New")
    assert hfsm.table()[STATE] == {OP: hfsm.table()[STATE][OP], "New": OTHER}


def test_the_beginning_of_the_selected_operation_is_taken_from_wherever_one_comes(
    hfsm: Drawer,
) -> None:
    """After a rename nothing was hovered, and the same drag drew a new operation."""
    hfsm.hover(along(hfsm, STATE, OP, 60.0))
    new = Address("SB1", STATE, "Travel")
    hfsm.session.edit("Rename", lambda bp: editing.rename(bp, Address("SB1", STATE, OP), "Travel"))
    hfsm.session.select((new,))
    at = tail(hfsm, STATE, "Travel")
    QTest.mouseMove(hfsm.hands_on, QPoint(5, 5))
    QTest.mouseMove(hfsm.hands_on, at)
    QTest.mousePress(hfsm.hands_on, LEFT, NONE, at)
    over(hfsm, hfsm.place(OTHER))
    let_go(hfsm, hfsm.place(OTHER))
    assert hfsm.editor.field is None, "no new operation is asked for"
    assert hfsm.session.selection == (Address("SB1", OTHER, "Travel"),)
    assert hfsm.steps() == 2
