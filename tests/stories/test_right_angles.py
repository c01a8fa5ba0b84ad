"""A line with right angles keeps them when a person drags a piece or a corner of it."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.studio.base.canvas.right_angles import corners_of
from tests.stories.at_canvas import LEFT, Drawer, sample
from tests.stories.test_bends import handles, layout, shape, words
from tests.studio.base.canvas.test_canvas import alike, on_screen, painted_anew

LANE = ("State_0000", "Op_UsePrevReg")
Corners = list[tuple[float, float]]


@pytest.fixture
def person(qtbot: QtBot) -> Drawer:
    """A canvas at 100 % on a procedure whose first line runs in a lane above its row."""
    drawer = Drawer(qtbot, sample("registration.json"))
    drawer.canvas.resize(1300, 800)
    drawer.canvas.camera.keep("")
    x, y = drawer.canvas.positions[LANE[0]]
    drawer.canvas.camera.go(QPointF(x + 400.0, y + 100.0), 1.0, smooth=False)
    QApplication.processEvents()
    return drawer


def corners(person: Drawer, state: str = LANE[0], operation: str = LANE[1]) -> Corners:
    found = corners_of(shape(person, state, operation), person.sheet.unit)
    assert found is not None, "the line has other angles than right ones"
    return found


def select(person: Drawer, state: str = LANE[0], operation: str = LANE[1]) -> None:
    person.session.select((Address(person.session.branch, state, operation),))
    QApplication.processEvents()


def on_piece(person: Drawer, piece: int, share: float = 0.3) -> QPoint:
    """A point of the view on a piece of the lane, off its label."""
    a, b = corners(person)[piece : piece + 2]
    return person.at((a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share))


def lane(person: Drawer) -> EdgeLayout:
    return layout(person, *LANE)


def test_a_drag_of_a_piece_moves_it_in_one_step(person: Drawer) -> None:
    text, before = person.session.blueprint.document.text, corners(person)
    select(person)
    at = on_piece(person, 1)
    person.drag(at, at + QPoint(30, -56))
    after = corners(person)
    assert len(after) == len(before) == 4
    assert after[1][1] == after[2][1] == pytest.approx(before[1][1] - 56, abs=8)
    assert after[1][1] % 8 == 0, "it snaps to the grid"
    assert (after[1][0], after[2][0]) == pytest.approx((before[1][0], before[2][0]), abs=30)
    assert person.steps() == 1
    assert words(person) == f"Bend {LANE[1]}"
    assert len(handles(person).bends) == 2
    person.session.history.undo()
    assert person.session.blueprint.document.text == text
    assert corners(person) == before


def test_a_corner_takes_both_its_pieces_along(person: Drawer) -> None:
    select(person)
    at = on_piece(person, 1)
    person.drag(at, at + QPoint(0, -56))
    before, corner = corners(person), lane(person).bends[0]
    person.drag(person.at(corner), person.at(corner) + QPoint(16, -24))
    after = corners(person)
    assert len(after) == 4
    assert after[1][1] == after[2][1] == pytest.approx(before[1][1] - 24, abs=8)
    assert after[1][0] > before[1][0]
    assert person.steps() == 2


def test_the_first_piece_turns_off_before_its_state_if_it_goes_far(person: Drawer) -> None:
    select(person)
    at = on_piece(person, 0, 0.6)
    person.drag(at, at + QPoint(160, 0))
    after = corners(person)
    assert len(after) == 6
    assert after[0][0] == pytest.approx(after[1][0], abs=0.5)
    assert after[2][0] == after[3][0] == pytest.approx(corners(person)[0][0] + 160, abs=12)


def test_a_straight_line_gets_one_bend_although_it_is_level(person: Drawer) -> None:
    table = person.table()
    names = list(table)
    state, operation = next(
        (a, o) for a in names for o, b in table[a].items()
        if b != a and shape(person, a, o).way == "line"
    )  # fmt: skip
    before = corners(person, state, operation)
    assert len(before) == 2
    select(person, state, operation)
    line = shape(person, state, operation)
    at = person.at(line.at(line.length * 0.15))
    person.drag(at, at + QPoint(0, 40))
    assert len(layout(person, state, operation).bends) == 1


def test_escape_puts_the_piece_back(person: Drawer) -> None:
    select(person)
    before, at = corners(person), on_piece(person, 1)
    person.press(at)
    for up in (20, 60):
        QTest.mouseMove(person.hands_on, at - QPoint(0, up))
    assert corners(person) != before
    QTest.keyClick(person.canvas, Qt.Key.Key_Escape)
    QTest.mouseRelease(person.hands_on, LEFT, Qt.KeyboardModifier.NoModifier, at - QPoint(0, 60))
    assert corners(person) == before
    assert person.steps() == 0


def test_a_double_click_on_a_handle_removes_its_corner(person: Drawer) -> None:
    select(person)
    at = on_piece(person, 1)
    person.drag(at, at - QPoint(0, 56))
    first, second = lane(person).bends
    person.double_click(person.at(first))
    assert lane(person).bends == (second,)
    assert person.steps() == 2


def test_a_piece_keeps_off_states(person: Drawer) -> None:
    select(person)
    at = on_piece(person, 1)
    _, y = person.canvas.positions[LANE[0]]
    person.drag(at, QPoint(at.x(), person.at((0.0, y)).y()))
    level = corners(person)[1][1]
    between = [
        other for name, other in person.canvas.positions.items()
        if name not in (LANE[0], person.table()[LANE[0]][LANE[1]])
    ]  # fmt: skip
    low, high = sorted(x for x, _ in (corners(person)[1], corners(person)[2]))
    assert all(abs(level - oy) >= 27.0 for ox, oy in between if low < ox < high)


def test_nothing_stale_is_left_while_pieces_are_dragged_and_undo_brings_all_back(
    person: Drawer,
) -> None:
    text = person.session.blueprint.document.text
    chance = random.Random(7)
    select(person)
    for _ in range(12):
        found = corners(person)
        piece = chance.randrange(len(found) - 1)
        at = on_piece(person, piece, chance.choice((0.2, 0.35, 0.7)))
        person.drag(at, at + QPoint(chance.randrange(-60, 60), chance.randrange(-60, 60)))
        select(person)
        for a, b in pairwise(corners(person)):
            assert min(abs(a[0] - b[0]), abs(a[1] - b[1])) < 0.31
    assert alike(on_screen(person), painted_anew(person))
    while person.session.history.canUndo():
        person.session.history.undo()
    assert person.session.blueprint.document.text == text
