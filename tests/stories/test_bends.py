"""A person bends the lines of operations and moves their labels, with the mouse and with keys."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import MOST_BENDS, EdgeLayout
from smsl_studio.generate.rules import hanoi
from smsl_studio.picture.curves import meets
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.studio.base.canvas.line_marks import LineMarks
from tests.stories.at_canvas import LEFT, Drawer
from tests.stories.test_canvas_gestures import drag_to
from tests.studio.base.canvas.test_canvas import alike, on_screen, painted_anew

Key, Modifier = Qt.Key, Qt.KeyboardModifier
STATE, OP = "State100", "Operation100B"


def shape(person: Drawer, state: str = STATE, operation: str = OP) -> EdgeShape:
    edge = person.sheet.picture.edge(Address(person.session.branch, state, operation))
    return person.sheet.geometry.shape(edge)


def on_line(person: Drawer, share: float, state: str = STATE, operation: str = OP) -> QPoint:
    """A point of the viewport on the line of an operation."""
    line = shape(person, state, operation)
    return person.at(line.at(line.length * share))


def layout(person: Drawer, state: str = STATE, operation: str = OP) -> EdgeLayout:
    """How the blueprint says that the line is drawn."""
    edges = person.session.blueprint[person.session.branch].notes.edges
    return edges.get((state, operation), EdgeLayout())


def handles(person: Drawer) -> LineMarks:
    marks = person.canvas.gestures.line
    assert marks is not None, "no operation is selected alone"
    return marks


def select(person: Drawer, state: str = STATE, operation: str = OP) -> None:
    person.session.select((Address(person.session.branch, state, operation),))
    QApplication.processEvents()


def bend(
    person: Drawer, share: float, by: QPoint, operation: tuple[str, str] = (STATE, OP)
) -> None:
    """Drag a point of the line, away from its label and its handles."""
    at = on_line(person, share, *operation)
    person.drag(at, at + by)


def words(person: Drawer) -> str:
    return person.session.history.undoText()


# Bending


def test_a_drag_of_the_line_bends_it_in_one_step(hfsm: Drawer) -> None:
    text, names = hfsm.session.blueprint.document.text, hfsm.table()
    hfsm.click(on_line(hfsm, 0.2))
    assert hfsm.selected() == [f"{STATE}/{OP}"]
    assert handles(hfsm).bends == ()
    at = on_line(hfsm, 0.2)
    hfsm.drag(at, at + QPoint(16, 90))
    assert hfsm.steps() == 1
    assert words(hfsm) == f"Bend {OP}"
    (there,) = layout(hfsm).bends
    assert (hfsm.at(there) - at - QPoint(16, 90)).manhattanLength() < 10, "it snaps to the grid"
    assert [value % 8 for value in there] == [0, 0]
    assert shape(hfsm).distance(*there) < 5.0
    assert handles(hfsm).bends == (QPointF(*there),)
    assert hfsm.table() == names
    assert hfsm.selected() == [f"{STATE}/{OP}"]
    hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text
    assert handles(hfsm).bends == ()
    hfsm.session.history.redo()
    assert handles(hfsm).bends == (QPointF(*there),)


def test_one_drag_of_a_line_that_is_not_selected_is_enough(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    assert hfsm.selected() == [f"{STATE}/{OP}"]
    assert len(layout(hfsm).bends) == 1


def test_a_click_bends_nothing(hfsm: Drawer) -> None:
    hfsm.click(on_line(hfsm, 0.2))
    hfsm.click(on_line(hfsm, 0.2))
    assert hfsm.steps() == 0


def test_the_first_bend_writes_the_places_of_the_states(hfsm: Drawer) -> None:
    """Else another layout could leave the bends alone in the picture."""
    shown = dict(hfsm.canvas.positions)
    bend(hfsm, 0.2, QPoint(0, 80))
    places = hfsm.session.blueprint["SB1"].notes.layout
    assert places.keys() == shown.keys()
    assert all(places[name] == pytest.approx(shown[name], abs=0.1) for name in shown)


def test_the_old_way_is_dashed_until_the_release(hfsm: Drawer) -> None:
    select(hfsm)
    at, before = on_line(hfsm, 0.2), shape(hfsm).points.tolist()
    hfsm.press(at)
    QTest.mouseMove(hfsm.hands_on, at + QPoint(0, 30))
    QTest.mouseMove(hfsm.hands_on, at + QPoint(0, 60))
    assert [[p.x(), p.y()] for p in handles(hfsm).former] == before
    assert handles(hfsm).chosen == 0
    assert shape(hfsm).way == "bent"
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, at + QPoint(0, 60))
    QApplication.processEvents()
    assert handles(hfsm).former == ()


def test_escape_during_the_drag_puts_the_line_back(hfsm: Drawer) -> None:
    select(hfsm)
    at, before = on_line(hfsm, 0.2), shape(hfsm)
    hfsm.press(at)
    for down in (20, 60):
        QTest.mouseMove(hfsm.hands_on, at + QPoint(0, down))
    QTest.keyClick(hfsm.canvas, Key.Key_Escape)
    assert shape(hfsm).is_like(before)
    assert handles(hfsm) == LineMarks()
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, at + QPoint(0, 60))
    assert hfsm.steps() == 0
    assert hfsm.selected() == [f"{STATE}/{OP}"]


def test_a_handle_moves_its_bend_and_another_place_of_the_line_adds_one(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    (first,) = layout(hfsm).bends
    hfsm.drag(hfsm.at(first), hfsm.at(first) + QPoint(-24, 40))
    assert words(hfsm) == f"Move a bend of {OP}"
    (moved,) = layout(hfsm).bends
    assert moved[1] > first[1]
    bend(hfsm, 0.8, QPoint(40, 0))
    assert words(hfsm) == f"Bend {OP}"
    assert layout(hfsm).bends[0] == moved, "the new one comes behind it"
    assert len(layout(hfsm).bends) == 2
    assert hfsm.steps() == 3


def test_with_alt_a_bend_does_not_snap(hfsm: Drawer) -> None:
    select(hfsm)
    at = on_line(hfsm, 0.2)
    drag_to(hfsm, at, at + QPoint(3, 77), Modifier.AltModifier)
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.AltModifier, at + QPoint(3, 77))
    (there,) = layout(hfsm).bends
    assert (hfsm.at(there) - at - QPoint(3, 77)).manhattanLength() <= 1


def test_a_bend_keeps_off_states_and_snaps_to_their_centres_with_a_guide(hfsm: Drawer) -> None:
    select(hfsm)
    at, other = on_line(hfsm, 0.2), hfsm.place("State110")
    hfsm.drag(at, other + QPoint(2, 3))
    (there,) = layout(hfsm).bends
    edge = hfsm.sheet.picture.edge(Address("SB1", STATE, OP))
    ends = [int(hfsm.sheet.picture.source[edge]), int(hfsm.sheet.picture.target[edge])]
    boxes = hfsm.sheet.geometry.boxes
    assert hfsm.sheet.state_at(*there, 7.0) == -1
    assert not meets(shape(hfsm).points[1:-1], boxes, ends, 4.0)
    x, y = hfsm.canvas.positions["State110"]
    hfsm.press(hfsm.at(there))
    free = hfsm.at((x + 3.0, y + 150.0))
    for step in (0.5, 1.0):
        QTest.mouseMove(hfsm.hands_on, hfsm.at(there) + (free - hfsm.at(there)) * step)
    assert any(guide[0] == guide[2] == x for guide in hfsm.canvas.gestures.guides)
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, free)
    assert layout(hfsm).bends[0][0] == pytest.approx(x, abs=0.1)
    assert hfsm.canvas.gestures.guides == ()


def test_a_double_click_on_a_handle_removes_that_bend(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    bend(hfsm, 0.8, QPoint(0, 60))
    first, second = layout(hfsm).bends
    hfsm.double_click(hfsm.at(first))
    assert layout(hfsm).bends == (second,)
    assert words(hfsm) == f"Remove a bend of {OP}"
    assert hfsm.editor.field is None, "nothing is renamed"
    hfsm.double_click(hfsm.at(second))
    assert layout(hfsm) == EdgeLayout()
    assert hfsm.steps() == 4


def test_a_double_click_on_a_line_that_was_not_selected_removes_no_bend(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    (there,) = layout(hfsm).bends
    hfsm.session.select(())
    hfsm.double_click(hfsm.at(there))
    assert layout(hfsm).bends == (there,)
    assert hfsm.editor.field is not None, "it asks for the name, as it does elsewhere on the line"


def test_a_line_has_so_many_bends_and_no_more(hfsm: Drawer) -> None:
    x, y = hfsm.canvas.positions[STATE]
    bends = [(x - 300.0 + 10 * i, y + 260.0 + 30 * (i % 2)) for i in range(MOST_BENDS)]
    address = Address("SB1", STATE, OP)
    hfsm.session.edit("Bend", lambda b: editing.set_bends(b, address, bends))
    hfsm.canvas.fit()
    select(hfsm)
    bend(hfsm, 0.99, QPoint(0, 30))
    hfsm.key(Key.Key_B)
    assert len(layout(hfsm).bends) == MOST_BENDS
    assert hfsm.steps() == 1


def test_a_loop_is_bent_too_and_a_line_without_a_target_is_not(qtbot: QtBot) -> None:
    from tests.blueprint.test_bends import read

    person = Drawer(qtbot, read({"S": {"A": {"on": "A", "lost": "X"}, "B": {}}}))
    bend(person, 0.5, QPoint(40, 60), ("A", "on"))
    assert len(layout(person, "A", "on").bends) == 1
    assert shape(person, "A", "on").way == "bent"
    bend(person, 0.3, QPoint(40, 0), ("A", "lost"))
    select(person, "A", "lost")
    person.key(Key.Key_B)
    assert layout(person, "A", "lost") == EdgeLayout()


# Labels


def test_a_drag_of_the_label_moves_it_along_and_beside_the_line(hfsm: Drawer) -> None:
    text = hfsm.session.blueprint.document.text
    at = hfsm.label_of(STATE, OP)
    hfsm.drag(at, at + QPoint(30, -40))
    assert hfsm.steps() == 1
    assert words(hfsm) == f"Move the label of {OP}"
    assert layout(hfsm).bends == ()
    assert (hfsm.label_of(STATE, OP) - at - QPoint(30, -40)).manhattanLength() <= 2
    hfsm.drag(hfsm.label_of(STATE, OP), on_line(hfsm, 0.7))
    assert layout(hfsm).label == pytest.approx((0.7, 0, 0), abs=0.02), "it lies on the line again"
    hfsm.session.history.undo()
    hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text
    assert (hfsm.label_of(STATE, OP) - at).manhattanLength() <= 1


def test_a_moved_label_goes_with_its_line(hfsm: Drawer) -> None:
    at = hfsm.label_of(STATE, OP)
    hfsm.drag(at, at + QPoint(30, -40))
    line, rect = shape(hfsm), hfsm.canvas.rect_of(Address("SB1", STATE, OP))
    share = layout(hfsm).label
    assert share is not None
    assert rect is not None
    off = rect.center() - QPointF(*line.at(line.length * share[0]))
    hfsm.session.select(())
    hfsm.drag(hfsm.place(STATE), hfsm.place(STATE) + QPoint(-60, 80))
    line, rect = shape(hfsm), hfsm.canvas.rect_of(Address("SB1", STATE, OP))
    assert rect is not None
    now = rect.center() - QPointF(*line.at(line.length * share[0]))
    assert (now - off).manhattanLength() < 0.1
    assert layout(hfsm).label == share


def test_escape_puts_a_dragged_label_back(hfsm: Drawer) -> None:
    at = hfsm.label_of(STATE, OP)
    hfsm.press(at)
    for down in (20, 60):
        QTest.mouseMove(hfsm.hands_on, at + QPoint(0, down))
    assert (hfsm.label_of(STATE, OP) - at - QPoint(0, 60)).manhattanLength() <= 2
    QTest.keyClick(hfsm.canvas, Key.Key_Escape)
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, at + QPoint(0, 60))
    assert hfsm.label_of(STATE, OP) == at
    assert hfsm.steps() == 0


# Beside other gestures


def test_the_grip_at_the_arrowhead_still_retargets_and_the_bends_go(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    target = hfsm.table()[STATE][OP]
    other = next(s for s in hfsm.table() if s not in (STATE, target))
    hfsm.drag(hfsm.tip_of(STATE, OP), hfsm.place(other))
    assert hfsm.table()[STATE][OP] == other
    assert layout(hfsm) == EdgeLayout(), "they were made for the former way"
    hfsm.session.history.undo()
    assert len(layout(hfsm).bends) == 1


def test_states_are_dragged_as_ever_and_bends_stay_unless_both_ends_go(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    (there,) = layout(hfsm).bends
    target = hfsm.table()[STATE][OP]
    hfsm.session.select(())
    hfsm.drag(hfsm.place(STATE), hfsm.place(STATE) + QPoint(-40, 0))
    assert layout(hfsm).bends == (there,)
    at = hfsm.canvas.positions[STATE]
    hfsm.session.select((Address("SB1", STATE), Address("SB1", target)))
    hfsm.press(hfsm.place(STATE))
    for step in (20, 40):
        QTest.mouseMove(hfsm.hands_on, hfsm.at(at) + QPoint(0, step))
    edge = hfsm.sheet.picture.edge(Address("SB1", STATE, OP))
    (live,) = hfsm.sheet.lines[edge].bends
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, hfsm.at(at) + QPoint(0, 40))
    QApplication.processEvents()
    (moved,) = layout(hfsm).bends
    by = hfsm.canvas.positions[STATE][1] - at[1]
    assert by > 20.0
    assert moved == pytest.approx((there[0], there[1] + by), abs=0.11)
    assert live == pytest.approx(moved, abs=0.11), "they were seen to go along"
    hfsm.key(Key.Key_Down)
    hfsm.editor.nudge.settle()
    assert layout(hfsm).bends[0][1] == pytest.approx(moved[1] + 8.0, abs=0.11)


def test_a_band_over_a_bend_selects_states_and_bends_nothing(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    hfsm.session.select(())
    low = hfsm.canvas.viewport().rect()
    hfsm.drag(QPoint(4, 60), QPoint(low.width() - 4, low.height() - 4))
    assert len(hfsm.selected()) == len(hfsm.table())
    assert hfsm.canvas.gestures.line is None
    assert hfsm.steps() == 1


def test_with_shift_and_ctrl_a_press_on_a_line_selects_only(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State110"))
    at = on_line(hfsm, 0.2)
    for modifier in (Modifier.ShiftModifier, Modifier.ControlModifier):
        hfsm.drag(at, at + QPoint(0, 60), modifiers=modifier)
        assert hfsm.steps() == 0
    assert hfsm.selected() == ["State110"]


def test_several_selected_operations_have_no_handles(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    (there,) = layout(hfsm).bends
    chosen = Address("SB1", STATE, OP), Address("SB1", "State110")
    hfsm.session.select(chosen)
    assert hfsm.canvas.gestures.line is None
    hfsm.session.select(())
    hfsm.press(hfsm.at(there))
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, hfsm.at(there))
    assert hfsm.steps() == 1


def test_a_line_is_not_bent_where_nothing_can_be_edited(hfsm: Drawer) -> None:
    hfsm.canvas.editing = False
    bend(hfsm, 0.2, QPoint(0, 80))
    select(hfsm)
    hfsm.key(Key.Key_B)
    assert hfsm.canvas.gestures.line is None
    assert hfsm.steps() == 0


# Keys


def test_by_keys_a_bend_is_added_moved_and_removed(hfsm: Drawer) -> None:
    select(hfsm)
    hfsm.canvas.setFocus()
    hfsm.editor.bends.clock = lambda: 0.0
    hfsm.key(Key.Key_B)
    (first,) = layout(hfsm).bends
    assert handles(hfsm).chosen == 0
    for _ in range(3):
        hfsm.key(Key.Key_Down)
    hfsm.key(Key.Key_Left, Modifier.ShiftModifier)
    hfsm.editor.bends.settle()
    assert hfsm.steps() == 2, "arrows soon after each other are one step"
    assert layout(hfsm).bends[0] == pytest.approx((first[0] - 1.0, first[1] + 24.0), abs=0.11)
    hfsm.key(Key.Key_B)
    assert len(layout(hfsm).bends) == 2
    hfsm.key(Key.Key_B, Modifier.ShiftModifier)
    hfsm.key(Key.Key_Escape)
    assert hfsm.selected() == [f"{STATE}/{OP}"], "Escape leaves the bend first"
    hfsm.key(Key.Key_B, Modifier.ShiftModifier)
    assert handles(hfsm).chosen == 0
    assert hfsm.canvas.accessibleDescription().startswith(f"{OP}, bend 1 of 2 chosen")
    hfsm.key(Key.Key_Delete)
    assert len(layout(hfsm).bends) == 1
    assert OP in hfsm.table()[STATE], "only the bend is deleted"
    hfsm.key(Key.Key_Escape)
    assert hfsm.selected() == []


def test_by_keys_the_label_is_moved_and_given_back(hfsm: Drawer) -> None:
    select(hfsm)
    hfsm.canvas.setFocus()
    before = hfsm.label_of(STATE, OP)
    hfsm.key(Key.Key_B, Modifier.ShiftModifier)
    assert handles(hfsm).label is not None
    hfsm.key(Key.Key_Up)
    hfsm.key(Key.Key_Up)
    hfsm.editor.bends.settle()
    assert layout(hfsm).label is not None
    moved = (hfsm.label_of(STATE, OP) - before).y() / hfsm.canvas.zoom
    assert moved == pytest.approx(-16.0, abs=3.0)
    hfsm.key(Key.Key_Delete)
    assert layout(hfsm) == EdgeLayout()
    assert hfsm.label_of(STATE, OP) == before


def test_arrows_pan_and_del_deletes_as_long_as_no_handle_is_chosen(hfsm: Drawer) -> None:
    bend(hfsm, 0.2, QPoint(0, 80))
    seen = hfsm.canvas.seen
    hfsm.key(Key.Key_Right)
    assert hfsm.canvas.seen != seen
    hfsm.key(Key.Key_Delete)
    assert OP not in hfsm.table()[STATE]


def test_presses_that_wait_are_carried_out_before_another_edit(hfsm: Drawer) -> None:
    select(hfsm)
    hfsm.canvas.setFocus()
    hfsm.key(Key.Key_B)
    (first,) = layout(hfsm).bends
    QTest.keyClick(hfsm.canvas, Key.Key_Down)
    hfsm.session.edit("Add", lambda b: editing.add_state(b, "SB1", "New"))
    assert layout(hfsm).bends[0][1] == pytest.approx(first[1] + 8.0, abs=0.11)


# Verbs


def test_tidy_makes_lines_straight_again(hfsm: Drawer) -> None:
    from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs

    bend(hfsm, 0.2, QPoint(0, 80))
    verbs = DrawVerbs(hfsm.session, hfsm.editor)
    verbs.tidy()
    assert hfsm.session.blueprint["SB1"].notes.edges == {}
    assert hfsm.steps() == 2


def test_a_broken_text_refuses_a_bend_and_the_line_is_as_it_was(hfsm: Drawer) -> None:
    before = shape(hfsm)
    hfsm.session.write("Type", "{ broken")
    bend(hfsm, 0.2, QPoint(0, 80))
    assert layout(hfsm) == EdgeLayout()
    assert shape(hfsm).is_like(before)
    assert handles(hfsm).bends == ()


# What is painted, and random drags


def test_what_is_dragged_leaves_no_stale_pixels(hfsm: Drawer) -> None:
    def seen_is_painted(what: str) -> None:
        seen = on_screen(hfsm)
        assert alike(painted_anew(hfsm), seen), what

    select(hfsm)
    hfsm.hover(QPoint(5, 5))
    at = on_line(hfsm, 0.2)
    hfsm.press(at)
    for by in (QPoint(10, 40), QPoint(-30, 120)):
        QTest.mouseMove(hfsm.hands_on, at + by)
        seen_is_painted(f"bent by {by}")
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, at + QPoint(-30, 120))
    seen_is_painted("released")
    label = hfsm.label_of(STATE, OP)
    hfsm.press(label)
    for by in (QPoint(10, 40), QPoint(60, -90)):
        QTest.mouseMove(hfsm.hands_on, label + by)
        seen_is_painted(f"label moved by {by}")
    QTest.mouseRelease(hfsm.hands_on, LEFT, Modifier.NoModifier, label + QPoint(60, -90))
    seen_is_painted("label released")
    hfsm.key(Key.Key_B, Modifier.ShiftModifier)
    seen_is_painted("a bend is chosen")
    hfsm.key(Key.Key_B, Modifier.ShiftModifier)
    seen_is_painted("the label is chosen")
    hfsm.session.select(())
    seen_is_painted("not selected")
    hfsm.session.history.undo()
    hfsm.session.history.undo()
    seen_is_painted("undone")


@pytest.mark.parametrize("zoom", [0.05, 0.2, 0.45, 1.0])
def test_a_line_far_from_its_states_is_painted_in_a_large_drawing(
    qtbot: QtBot, zoom: float
) -> None:
    person = Drawer(qtbot, hanoi(5))
    first = next(person.session.blueprint[person.session.branch].edges())
    at = Address(person.session.branch, first.source, first.name)
    middle = QPointF(-9000.0, -9000.0)
    person.canvas.camera.go(middle, zoom)
    person.canvas.camera.keep("")
    before = on_screen(person)
    bends = [(-9000.0 - 300.0 / zoom, -9000.0), (-9000.0 + 300.0 / zoom, -9000.0)]
    person.session.edit("Bend", lambda b: editing.set_bends(b, at, bends))
    person.canvas.camera.go(middle, zoom)
    after = on_screen(person)
    assert not alike(before, after)
    assert alike(painted_anew(person), after)
    person.session.history.undo()
    person.canvas.camera.go(middle, zoom)
    assert alike(on_screen(person), before)


@pytest.mark.parametrize("seed", range(4))
def test_any_bends_are_undone_to_the_same_bytes(hfsm: Drawer, seed: int) -> None:
    chance, text = random.Random(seed), hfsm.session.blueprint.document.text
    edges = [(e.source, e.name) for e in hfsm.session.blueprint["SB1"].edges()]
    texts = [text]
    for _ in range(25):
        state, operation = chance.choice(edges)
        by = QPoint(chance.randrange(-90, 90), chance.randrange(-90, 90))
        what = chance.choice(["bend", "bend", "handle", "label", "drop", "key", "state", "undo"])
        select(hfsm, state, operation)
        bends = layout(hfsm, state, operation).bends
        if what == "bend":
            bend(hfsm, chance.uniform(0.1, 0.8), by, (state, operation))
        elif what == "handle" and bends:
            hfsm.drag(hfsm.at(bends[0]), hfsm.at(bends[0]) + by)
        elif what == "label":
            at = hfsm.label_of(state, operation)
            hfsm.drag(at, at + by)
        elif what == "drop" and bends:
            hfsm.double_click(hfsm.at(chance.choice(bends)))
        elif what == "key":
            hfsm.key(Key.Key_B, chance.choice([Modifier.NoModifier, Modifier.ShiftModifier]))
            hfsm.key(chance.choice([Key.Key_Left, Key.Key_Down, Key.Key_Delete]))
            hfsm.editor.bends.settle()
        elif what == "state":
            hfsm.session.select((Address("SB1", state),))
            hfsm.drag(hfsm.place(state), hfsm.place(state) + by)
        elif what == "undo":
            hfsm.session.history.undo()
        if hfsm.editor.field is not None:
            hfsm.key(Key.Key_Escape)
        assert hfsm.sheet.lines == hfsm.sheet.picture.edge_layouts()
        texts.append(hfsm.session.blueprint.document.text)
        edges = [(e.source, e.name) for e in hfsm.session.blueprint["SB1"].edges()]
    assert any(one != other for one, other in pairwise(texts))
    last = texts[-1]
    while hfsm.session.history.canUndo():
        hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text
    while hfsm.session.history.canRedo():
        hfsm.session.history.redo()
    assert hfsm.session.blueprint.document.text == last or words(hfsm)
