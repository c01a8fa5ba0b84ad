"""Every gesture of the canvas, made with mouse and keys as a person makes it."""

from __future__ import annotations

import random

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import unit_at
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from tests.stories.at_canvas import Drawer, sample
from tests.studio.base.canvas.test_canvas import alike, on_screen

Key, Modifier, Button = Qt.Key, Qt.KeyboardModifier, Qt.MouseButton


@pytest.fixture
def empty(qtbot: QtBot) -> Drawer:
    return Drawer(qtbot)


def turn(
    person: Drawer, at: QPoint, notches: int, modifiers: Qt.KeyboardModifier = Modifier.NoModifier
) -> None:
    """Turn the wheel over a point."""
    event = QWheelEvent(
        QPointF(at),
        QPointF(person.hands_on.mapToGlobal(at)),
        QPoint(),
        QPoint(0, 120 * notches),
        Button.NoButton,
        modifiers,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(person.hands_on, event)
    QApplication.processEvents()


# Looking


def test_the_wheel_zooms_and_what_is_under_the_pointer_stays(hanoi: Drawer) -> None:
    at = hanoi.place("State_bba")
    zoom = hanoi.canvas.zoom
    turn(hanoi, at, 3)
    assert hanoi.canvas.zoom > zoom * 1.5
    assert (hanoi.place("State_bba") - at).manhattanLength() <= 2


@pytest.mark.parametrize("notches", [-1, 2])
def test_marks_keep_their_sizes_while_the_wheel_turns_and_get_new_ones_at_rest(
    hanoi: Drawer, qtbot: QtBot, notches: int
) -> None:
    camera = hanoi.canvas.camera
    camera.go(camera.centre, 0.5, smooth=False)
    lines, unit = hanoi.sheet.geometry, hanoi.sheet.unit
    with qtbot.waitSignal(camera.rested, timeout=20_000):
        turn(hanoi, hanoi.place("State_bba"), notches)
        if not camera.is_at_rest:  # a slow machine may have rested already
            assert hanoi.sheet.geometry is lines
            assert hanoi.sheet.unit == unit
    assert hanoi.sheet.unit == unit_at(camera.zoom, hanoi.sheet.level) != unit
    shown, stand = on_screen(hanoi), camera.stand
    camera.go(stand.centre, 4.0, smooth=False)
    camera.go(stand.centre, stand.zoom, smooth=False)
    assert camera.is_at_rest
    assert alike(on_screen(hanoi), shown), "as if nobody had turned a wheel"


def test_a_picture_that_gets_much_larger_is_drawn_anew_at_once(hanoi: Drawer) -> None:
    camera = hanoi.canvas.camera
    camera.go(camera.centre, 0.5, smooth=False)
    turn(hanoi, hanoi.place("State_bba"), 9)
    assert camera.zoom > 2.0
    assert hanoi.sheet.unit == 1.0


def test_the_wheel_pans_with_alt_and_shift_and_zooms_with_ctrl(hanoi: Drawer) -> None:
    at, zoom = hanoi.place("State_bba"), hanoi.canvas.zoom
    turn(hanoi, at, -1, Modifier.ControlModifier)
    assert hanoi.canvas.zoom < zoom
    turn(hanoi, at, 1, Modifier.ControlModifier)
    at, zoom = hanoi.place("State_bba"), hanoi.canvas.zoom
    turn(hanoi, at, -1, Modifier.AltModifier)
    down = hanoi.place("State_bba")
    assert down.x() == at.x()
    assert down.y() < at.y()
    turn(hanoi, at, -1, Modifier.ShiftModifier)
    aside = hanoi.place("State_bba")
    assert aside.x() < down.x()
    assert aside.y() == down.y()
    assert hanoi.canvas.zoom == zoom


def test_space_and_drag_pans(hanoi: Drawer) -> None:
    before = hanoi.place("State_bba")
    QTest.keyPress(hanoi.canvas, Key.Key_Space)
    hanoi.drag(before, before + QPoint(60, 40))
    QTest.keyRelease(hanoi.canvas, Key.Key_Space)
    assert (hanoi.place("State_bba") - before - QPoint(60, 40)).manhattanLength() <= 2
    assert hanoi.steps() == 0


def test_the_middle_button_pans(hanoi: Drawer) -> None:
    before = hanoi.place("State_bba")
    hanoi.drag(QPoint(30, 300), QPoint(90, 260), Button.MiddleButton)
    assert (hanoi.place("State_bba") - before - QPoint(60, -40)).manhattanLength() <= 2


def test_keys_fit_and_go_to_100_percent(hanoi: Drawer) -> None:
    fitted = hanoi.canvas.zoom
    turn(hanoi, QPoint(10, 10), 5)
    hanoi.key(Key.Key_F)
    assert hanoi.canvas.zoom == pytest.approx(fitted)
    hanoi.key(Key.Key_ParenRight, Modifier.ShiftModifier)
    assert hanoi.canvas.zoom == 1.0
    hanoi.key(Key.Key_Exclam, Modifier.ShiftModifier)
    assert hanoi.canvas.zoom == pytest.approx(fitted)


def test_the_zoom_control(hanoi: Drawer) -> None:
    control, zoom = hanoi.canvas.overlays.zoom, hanoi.canvas.zoom
    QTest.mouseClick(control.more, Button.LeftButton)
    assert hanoi.canvas.zoom > zoom
    QTest.mouseClick(control.value, Button.LeftButton)
    assert hanoi.canvas.zoom == 1.0
    assert control.value.text() == "100 %"
    QTest.mouseClick(control.fit, Button.LeftButton)
    assert hanoi.canvas.zoom == pytest.approx(zoom)


# Selecting


def test_a_click_selects_shift_adds_ctrl_toggles(hanoi: Drawer) -> None:
    hanoi.click(hanoi.place("State_aaa"))
    assert hanoi.selected() == ["State_aaa"]
    hanoi.click(hanoi.place("State_baa"), Modifier.ShiftModifier)
    assert hanoi.selected() == ["State_aaa", "State_baa"]
    hanoi.click(hanoi.place("State_aaa"), Modifier.ControlModifier)
    assert hanoi.selected() == ["State_baa"]
    hanoi.click(QPoint(20, 650))
    assert hanoi.selected() == []


def test_a_click_on_a_label_selects_the_operation(hfsm: Drawer) -> None:
    hfsm.click(hfsm.label_of("State000", "Operation000"))
    assert hfsm.selected() == ["State000/Operation000"]


def test_the_rubber_band_selects_what_it_touches(hfsm: Drawer) -> None:
    first, last = hfsm.place("State000"), hfsm.place("State100")
    hfsm.drag(first - QPoint(90, 70), last + QPoint(20, 60))
    assert hfsm.selected() == ["State000", "State100"]
    assert hfsm.canvas.gestures.band is None


def test_ctrl_and_an_arrow_go_from_state_to_state_and_arrows_alone_pan(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State000"))
    hfsm.key(Key.Key_Right, Modifier.ControlModifier)
    assert hfsm.selected() == ["State100"]
    hfsm.key(Key.Key_Right, Modifier.ControlModifier | Modifier.ShiftModifier)
    assert len(hfsm.selected()) == 2
    assert hfsm.steps() == 0
    hfsm.key(Key.Key_Escape)
    assert hfsm.selected() == []
    before = hfsm.place("State000")
    hfsm.key(Key.Key_Right)
    assert hfsm.place("State000").x() < before.x()


def test_ctrl_and_an_arrow_select_the_state_in_the_middle_as_the_first(hfsm: Drawer) -> None:
    hfsm.key(Key.Key_Up, Modifier.ControlModifier)
    (name,) = hfsm.selected()
    middle = hfsm.canvas.rect().center()
    away = {one: (hfsm.place(one) - middle).manhattanLength() for one in hfsm.canvas.positions}
    assert away[name] <= min(away.values()) + 2


def test_without_editing_arrows_go_from_state_to_state(hfsm: Drawer) -> None:
    hfsm.canvas.editing = False
    hfsm.session.select((Address("SB1", "State000"),))
    before = hfsm.canvas.positions
    hfsm.key(Key.Key_Right)
    assert hfsm.selected() == ["State100"]
    assert hfsm.canvas.positions == before
    assert hfsm.steps() == 0


# Moving


def offset(person: Drawer, before: dict[str, tuple[float, float]], name: str) -> QPointF:
    return QPointF(*person.canvas.positions[name]) - QPointF(*before[name])


def test_arrows_move_the_selection_by_the_grid_and_with_shift_by_one(hfsm: Drawer) -> None:
    before = hfsm.canvas.positions
    hfsm.editor.nudge.clock = lambda: 0.0
    hfsm.click(hfsm.place("State000"))
    hfsm.click(hfsm.place("State100"), Modifier.ShiftModifier)
    hfsm.key(Key.Key_Right)
    hfsm.key(Key.Key_Down, Modifier.ShiftModifier)
    for name in ("State000", "State100"):
        assert offset(hfsm, before, name) == QPointF(8.0, 1.0)
    assert offset(hfsm, before, "State110") == QPointF(0.0, 0.0)
    assert hfsm.selected() == ["State000", "State100"]


def test_arrows_pressed_soon_after_each_other_are_one_step(hfsm: Drawer) -> None:
    before, text = hfsm.canvas.positions, hfsm.session.blueprint.document.text
    now = 0.0
    hfsm.editor.nudge.clock = lambda: now
    hfsm.click(hfsm.place("State110"))
    for _ in range(5):
        hfsm.key(Key.Key_Left)
        now += 0.4
    assert hfsm.steps() == 1
    assert offset(hfsm, before, "State110") == QPointF(-40.0, 0.0)
    now += 2.0
    hfsm.key(Key.Key_Up)
    assert hfsm.steps() == 2
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Up)
    assert hfsm.steps() == 3, "another selection is another step"
    hfsm.session.history.undo()
    hfsm.session.history.undo()
    assert offset(hfsm, before, "State110") == QPointF(-40.0, 0.0)
    hfsm.session.history.undo()
    assert hfsm.canvas.positions == before
    assert hfsm.session.blueprint.document.text == text
    hfsm.session.history.redo()
    assert offset(hfsm, before, "State110") == QPointF(-40.0, 0.0)


def test_arrows_that_wait_are_carried_out_together_and_before_any_edit(hfsm: Drawer) -> None:
    before, told = hfsm.canvas.positions, []
    hfsm.session.blueprint_changed.connect(lambda *_: told.append(""))
    hfsm.click(hfsm.place("State110"))
    for _ in range(20):
        QTest.keyClick(hfsm.canvas, Key.Key_Left)
    QApplication.processEvents()
    assert offset(hfsm, before, "State110") == QPointF(-160.0, 0.0)
    assert len(told) == 1
    QTest.keyClick(hfsm.canvas, Key.Key_Left)
    QTest.keyClick(hfsm.canvas, Key.Key_Delete)
    QApplication.processEvents()
    assert "State110" not in hfsm.table()
    hfsm.session.history.undo()
    assert offset(hfsm, before, "State110") == QPointF(-168.0, 0.0)


@pytest.mark.parametrize("seed", range(3))
def test_any_arrows_are_undone_to_the_same_bytes(hfsm: Drawer, seed: int) -> None:
    chance, text, now = random.Random(seed), hfsm.session.blueprint.document.text, 0.0
    hfsm.editor.nudge.clock = lambda: now
    for _ in range(30):
        if chance.random() < 0.2:
            chosen = chance.sample([*hfsm.canvas.positions], chance.randint(1, 4))
            hfsm.session.select(Address("SB1", name) for name in chosen)
        arrow = chance.choice((Key.Key_Left, Key.Key_Right, Key.Key_Up, Key.Key_Down))
        hfsm.key(arrow, chance.choice((Modifier.NoModifier, Modifier.ShiftModifier)))
        now += chance.choice((0.1, 0.1, 3.0))
    while hfsm.session.history.canUndo():
        hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text
    while hfsm.session.history.canRedo():
        hfsm.session.history.redo()
    assert hfsm.canvas.positions == hfsm.session.blueprint["SB1"].notes.layout


def test_an_edit_or_a_save_between_two_arrows_ends_the_step(hfsm: Drawer) -> None:
    hfsm.editor.nudge.clock = lambda: 0.0
    hfsm.click(hfsm.place("State110"))
    hfsm.key(Key.Key_Left)
    hfsm.session.history.setClean()
    hfsm.key(Key.Key_Left)
    assert hfsm.steps() == 2
    hfsm.session.history.undo()
    assert not hfsm.session.edited, "what was saved is a step of its own"


def drag_to(person: Drawer, start: QPoint, end: QPoint, held: Qt.KeyboardModifier) -> None:
    """Press on a point and move to another one, without letting go."""
    person.press(start, modifiers=held)
    for share in (0.2, 0.6, 1.0):
        step = QPointF(start) + QPointF(end - start) * share
        person.canvas.hand.move(_moved(person, step.toPoint(), held))
    QApplication.processEvents()


def test_a_dragged_state_snaps_to_the_centre_of_another_and_a_guide_shows_it(
    hfsm: Drawer,
) -> None:
    hfsm.canvas.zoom_to(1.0)
    line = hfsm.canvas.positions["State000"]
    goal = hfsm.at((line[0] + 3.0, line[1] + 203.0))
    start = hfsm.place("State111")
    drag_to(hfsm, start, goal, Modifier.NoModifier)
    assert hfsm.canvas.positions["State111"][0] == line[0]
    assert hfsm.canvas.gestures.handle is None, "the handle does not stay behind"
    (guide,) = hfsm.canvas.gestures.guides
    assert guide == (line[0], line[1], line[0], hfsm.canvas.positions["State111"][1])
    QTest.mouseRelease(hfsm.hands_on, Button.LeftButton, Modifier.NoModifier, goal)
    assert hfsm.canvas.gestures.guides == ()
    assert hfsm.canvas.positions["State111"][0] == line[0]
    assert hfsm.steps() == 1


def test_alt_snaps_to_nothing(hfsm: Drawer) -> None:
    hfsm.canvas.zoom_to(1.0)
    line = hfsm.canvas.positions["State000"]
    goal = hfsm.at((line[0] + 3.0, line[1] + 203.0))
    drag_to(hfsm, hfsm.place("State111"), goal, Modifier.AltModifier)
    assert hfsm.canvas.gestures.guides == ()
    assert hfsm.canvas.positions["State111"][0] == pytest.approx(line[0] + 3.0, abs=1.0)
    assert hfsm.canvas.positions["State111"][0] != line[0]
    QTest.mouseRelease(hfsm.hands_on, Button.LeftButton, Modifier.AltModifier, goal)


def test_escape_removes_the_guides(hfsm: Drawer) -> None:
    line, before = hfsm.canvas.positions["State000"], hfsm.canvas.positions
    goal = hfsm.at((line[0] + 1.0, line[1] + 203.0))
    drag_to(hfsm, hfsm.place("State111"), goal, Modifier.NoModifier)
    assert hfsm.canvas.gestures.guides
    hfsm.key(Key.Key_Escape)
    assert hfsm.canvas.gestures.guides == ()
    assert hfsm.canvas.positions == before
    QTest.mouseRelease(hfsm.hands_on, Button.LeftButton, Modifier.NoModifier, goal)


def test_a_dragged_state_is_kept_as_one_step_and_undo_puts_it_back(hfsm: Drawer) -> None:
    before = hfsm.canvas.positions
    start = hfsm.place("State110")
    hfsm.drag(start, start + QPoint(64, -40))
    after = hfsm.canvas.positions
    assert hfsm.steps() == 1
    assert after["State110"] != before["State110"]
    assert {n: p for n, p in after.items() if n != "State110"} == {
        n: p for n, p in before.items() if n != "State110"
    }
    assert after["State110"][0] % 8 == 0
    assert after["State110"][1] % 8 == 0
    layout = hfsm.session.blueprint["SB1"].notes.layout
    assert layout == after, "with the first place by hand all places are written"
    hfsm.session.history.undo()
    assert hfsm.canvas.positions == before
    hfsm.session.history.redo()
    assert hfsm.canvas.positions == after


def test_a_drag_moves_the_whole_selection_and_alt_leaves_the_grid(hfsm: Drawer) -> None:
    before = hfsm.canvas.positions
    hfsm.click(hfsm.place("State000"))
    hfsm.click(hfsm.place("State100"), Modifier.ShiftModifier)
    start = hfsm.place("State100")
    hfsm.drag(start, start + QPoint(30, 50))
    after = hfsm.canvas.positions
    step = (
        after["State100"][0] - before["State100"][0],
        after["State100"][1] - before["State100"][1],
    )
    assert step != (0.0, 0.0)
    assert (
        after["State000"][0] - before["State000"][0],
        after["State000"][1] - before["State000"][1],
    ) == pytest.approx(step)
    assert hfsm.steps() == 1
    hfsm.click(QPoint(20, 650))
    start = hfsm.place("State111")
    hfsm.press(start, modifiers=Modifier.AltModifier)
    for pixels in (2, 9, 13):
        hfsm.canvas.hand.move(_moved(hfsm, start + QPoint(pixels, 0), Modifier.AltModifier))
    QTest.mouseRelease(
        hfsm.hands_on, Button.LeftButton, Modifier.AltModifier, start + QPoint(13, 0)
    )
    moved = hfsm.canvas.positions["State111"][0] - before["State111"][0]
    assert moved == pytest.approx(13.0 / hfsm.canvas.zoom, abs=1.0)


def _moved(person: Drawer, at: QPoint, modifiers: Qt.KeyboardModifier) -> QMouseEvent:

    return QMouseEvent(
        QEvent.Type.MouseMove,
        QPointF(at),
        QPointF(person.hands_on.mapToGlobal(at)),
        Button.NoButton,
        Button.LeftButton,
        modifiers,
    )


def test_escape_takes_a_drag_back(hfsm: Drawer) -> None:
    before = hfsm.canvas.positions
    start = hfsm.place("State110")
    hfsm.press(start)
    for step in (10, 40, 80):
        QTest.mouseMove(hfsm.hands_on, start + QPoint(step, 0))
    assert hfsm.canvas.positions != before
    hfsm.key(Key.Key_Escape)
    QTest.mouseRelease(hfsm.hands_on, Button.LeftButton, Modifier.NoModifier, start)
    assert hfsm.canvas.positions == before
    assert hfsm.steps() == 0


def test_dragging_and_hovering_rebuild_nothing(hanoi: Drawer) -> None:
    sheet = hanoi.canvas.sheet
    items = dict(hanoi.canvas.pool.used)
    hanoi.hover(hanoi.place("State_aaa"))
    hanoi.hover(hanoi.label_of("State_aaa", "Op_1b"))
    hanoi.click(hanoi.place("State_bba"))
    start = hanoi.place("State_aaa")
    hanoi.drag(start, start + QPoint(24, 24))
    assert hanoi.canvas.sheet is sheet
    assert hanoi.canvas.pool.used == items


# Adding and naming


def test_a_double_click_on_empty_canvas_adds_a_state_there(empty: Drawer) -> None:
    assert not empty.canvas.overlays.empty.isHidden()
    empty.double_click(QPoint(300, 300))
    assert empty.steps() == 0, "nothing is added before it has a name"
    empty.write("State000")
    assert list(empty.table()) == ["State000"]
    assert (empty.place("State000") - QPoint(300, 300)).manhattanLength() <= 8
    assert empty.selected() == ["State000"]
    assert empty.canvas.overlays.empty.isHidden()
    assert empty.steps() == 1
    empty.session.history.undo()
    assert not any(branch.table for branch in empty.session.blueprint)


def test_escape_adds_nothing(hfsm: Drawer) -> None:
    hfsm.double_click(QPoint(300, 620))
    hfsm.write("State010", Key.Key_Escape)
    assert hfsm.steps() == 0
    assert hfsm.editor.field is None
    assert hfsm.canvas.hasFocus()


def test_a_name_that_is_taken_is_said_and_nothing_typed_is_lost(hfsm: Drawer) -> None:
    hfsm.double_click(QPoint(300, 620))
    hfsm.write("State100")
    field = hfsm.editor.field
    assert field is not None
    assert "State100" in field.complaint
    assert hfsm.steps() == 0
    hfsm.write("x", None)
    assert field.complaint == ""
    hfsm.key(Key.Key_Return)
    assert "State100x" in hfsm.table()


def test_a_click_elsewhere_takes_a_name_over_or_keeps_what_does_not_fit(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State110"))
    hfsm.key(Key.Key_F2)
    hfsm.write("State100", None)
    hfsm.click(QPoint(20, 650))
    field = hfsm.editor.field
    assert isinstance(field, NameField)
    assert "State100" in field.complaint
    assert field.field.text() == "State100"
    assert hfsm.steps() == 0
    field.field.setFocus()
    hfsm.write("1", None)
    hfsm.click(QPoint(20, 650))
    assert "State1001" in hfsm.table()
    assert hfsm.editor.field is None


def test_a_press_elsewhere_closes_a_card_in_which_nothing_was_typed(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    assert isinstance(hfsm.editor.field, ConnectCard)
    hfsm.click(QPoint(20, 650))
    assert hfsm.editor.field is None
    assert hfsm.canvas.gestures.drawn is None
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    hfsm.write("Begun", None)
    hfsm.click(QPoint(20, 650))
    assert isinstance(hfsm.editor.field, ConnectCard), "what was typed stays"


def test_f2_renames_in_place_and_everything_follows(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State100"))
    before = hfsm.canvas.positions["State100"]
    hfsm.key(Key.Key_F2)
    hfsm.write("State101")
    assert hfsm.table()["State000"]["Operation000"] == "State101"
    assert hfsm.canvas.positions["State101"] == before
    assert hfsm.selected() == ["State101"]
    hfsm.session.history.undo()
    assert hfsm.canvas.positions["State100"] == before


def test_a_double_click_on_a_name_renames_and_escape_leaves_it(hfsm: Drawer) -> None:
    name = hfsm.place("State110") - QPoint(0, 12)
    hfsm.double_click(name)
    hfsm.write("State999", Key.Key_Escape)
    assert "State110" in hfsm.table()
    assert hfsm.steps() == 0
    hfsm.double_click(hfsm.label_of("State000", "Operation000"))
    hfsm.write("Begin")
    assert hfsm.table()["State000"] == {"Begin": "State100"}


def test_drag_from_a_handle_connects_two_states(hfsm: Drawer) -> None:
    hfsm.connect("State111", "State110", "Back")
    assert hfsm.table()["State111"] == {"Back": "State110"}
    assert hfsm.steps() == 1
    assert hfsm.selected() == ["State111/Back"]
    assert hfsm.canvas.gestures.drawn is None


def test_drop_on_empty_canvas_makes_the_target_too_as_one_step(hfsm: Drawer) -> None:
    handle = hfsm.handle_of("State111", "bottom")
    hfsm.hover(handle)
    hfsm.drag(handle, handle + QPoint(-40, 160))
    hfsm.write("Finish", Key.Key_Tab)
    hfsm.write("State999")
    assert hfsm.table()["State111"] == {"Finish": "State999"}
    assert "State999" in hfsm.table()
    assert hfsm.steps() == 1
    hfsm.session.history.undo()
    assert "State999" not in hfsm.table()
    assert hfsm.table()["State111"] == {}


@pytest.mark.parametrize("zoom", [0.4, 0.5, 0.69])
def test_a_small_state_is_moved_from_any_point_of_it(hfsm: Drawer, zoom: float) -> None:
    """A handle took three pixels of each side, a quarter of a node that is seen from afar."""
    hfsm.canvas.zoom_to(zoom)
    rect = hfsm.canvas.rect_of(Address("SB1", "State111"))
    assert rect is not None
    sides = {"left": QPoint(2, 0), "right": QPoint(-2, 0), "top": QPoint(0, 2)}
    for side, inwards in sides.items():
        border = hfsm.handle_of("State111", side) + inwards * 3
        places, start = hfsm.canvas.positions, border + inwards
        hfsm.hover(start)
        assert hfsm.canvas.gestures.handle is not None
        assert not hfsm.canvas.gestures.taken
        assert hfsm.hands_on.cursor().shape() is Qt.CursorShape.ArrowCursor
        hfsm.drag(start, start + QPoint(40, 70))
        assert hfsm.canvas.positions["State111"] != places["State111"], side
        assert hfsm.editor.field is None
        assert hfsm.steps() == 1
        hfsm.session.history.undo()


@pytest.mark.parametrize("zoom", [0.5, 1.0])
def test_a_handle_shows_that_a_press_takes_it(hfsm: Drawer, zoom: float) -> None:
    hfsm.canvas.zoom_to(zoom)
    for off in (0, 5):
        handle = hfsm.handle_of("State111", "left") + QPoint(off, 0)
        hfsm.hover(handle)
        assert hfsm.canvas.gestures.taken
        assert hfsm.hands_on.cursor().shape() is Qt.CursorShape.CrossCursor
        assert "draw an operation" in hfsm.hands_on.toolTip()
        hfsm.drag(handle, handle + QPoint(-40, 120))
        assert hfsm.editor.field is not None
        hfsm.key(Key.Key_Escape)
    hfsm.hover(hfsm.place("State111"))
    assert hfsm.hands_on.cursor().shape() is Qt.CursorShape.ArrowCursor


def test_an_operation_name_that_is_taken_is_said_beside_it(hfsm: Drawer) -> None:
    handle = hfsm.handle_of("State000", "bottom")
    hfsm.hover(handle)
    hfsm.drag(handle, hfsm.place("State100") - QPoint(0, 8))
    hfsm.write("Operation000")
    field = hfsm.editor.field
    assert field is not None
    assert "Operation000" in field.complaint
    assert hfsm.steps() == 0
    hfsm.key(Key.Key_A, Modifier.ControlModifier)
    hfsm.write("Again")
    assert hfsm.table()["State000"]["Again"] == "State100"


def test_the_suggested_name_has_the_effect_that_is_wanted(hanoi: Drawer) -> None:
    hanoi.session.select((Address("SB1", "State_aaa", "Op_1b"),))
    hanoi.key(Key.Key_Delete)
    hanoi.canvas.zoom_to(1.5)
    hanoi.canvas.reveal(Address("SB1", "State_aaa"))
    handle = hanoi.handle_of("State_aaa", "left")
    hanoi.hover(handle)
    hanoi.drag(handle, hanoi.place("State_baa"))
    hanoi.key(Key.Key_Return)
    assert hanoi.table()["State_aaa"]["Op_1b"] == "State_baa"


def test_the_arrowhead_of_a_selected_operation_can_be_dragged_elsewhere(hfsm: Drawer) -> None:
    hfsm.click(hfsm.label_of("State000", "Operation000"))
    hfsm.drag(hfsm.tip_of("State000", "Operation000"), hfsm.place("State110"))
    assert hfsm.table()["State000"]["Operation000"] == "State110"
    assert hfsm.steps() == 1


@pytest.mark.parametrize("zoom", [0.7, 1.0, 1.6])
def test_who_comes_along_a_line_takes_its_arrowhead_without_a_click_before(
    hfsm: Drawer, zoom: float
) -> None:
    hfsm.canvas.zoom_to(zoom)
    hfsm.canvas.reveal(Address("SB1", "State100"), smooth=False)
    label = hfsm.label_of("State000", "Operation000")
    tip = hfsm.tip_of("State000", "Operation000")
    hfsm.hover(label)
    for share in (0.5, 0.7, 0.8, 0.9, 0.95):
        hfsm.hover(QPointF(label + (tip - label) * share).toPoint())
    near = tip + QPoint(-2, 0)
    hfsm.hover(near)
    assert hfsm.canvas.gestures.handle is None, "the handle of the target does not cover it"
    assert "another state" in hfsm.hands_on.toolTip()
    target = hfsm.place("State110")
    QTest.mousePress(hfsm.hands_on, Button.LeftButton, Modifier.NoModifier, near)
    for share in (0.1, 0.5, 1.0):
        QTest.mouseMove(hfsm.hands_on, QPointF(near + (target - near) * share).toPoint())
    QTest.mouseRelease(hfsm.hands_on, Button.LeftButton, Modifier.NoModifier, target)
    QApplication.processEvents()
    assert hfsm.table()["State000"]["Operation000"] == "State110"
    assert hfsm.steps() == 1
    assert hfsm.selected() == ["State000/Operation000"]


def test_who_comes_from_the_state_still_takes_its_handle(hfsm: Drawer) -> None:
    tip, place = hfsm.tip_of("State000", "Operation000"), hfsm.place("State100")
    hfsm.hover(place)
    hfsm.hover(tip)
    assert hfsm.canvas.hand.hover.handle_at(hfsm.canvas.mapToScene(tip)) is not None
    hfsm.drag(tip, hfsm.place("State111"))
    hfsm.write("Direct")
    assert hfsm.table()["State100"]["Direct"] == "State111"


@pytest.mark.parametrize("off", [0, 8, 15, 22])
def test_beside_the_arrowhead_of_a_selected_operation_nothing_is_drawn(
    hfsm: Drawer, off: int
) -> None:
    """A handle of the target lay below the grip: a little beside it a drag drew an operation."""
    hfsm.click(hfsm.label_of("State000", "Operation000"))
    before, tip = hfsm.table(), hfsm.tip_of("State000", "Operation000")
    for side in (QPoint(off, 0), QPoint(-off, 0), QPoint(0, off), QPoint(0, -off)):
        hfsm.hover(tip + side)
        grip, handle = hfsm.canvas.gestures.grip, hfsm.canvas.gestures.handle
        assert grip is not None
        if handle is not None:
            away = hfsm.at(handle) - hfsm.at(grip)
            assert away.x() ** 2 + away.y() ** 2 > 30**2, f"they lie on each other at {side}"
        hfsm.drag(tip + side, hfsm.place("State110") + QPoint(0, 200))
        added = {state: set(ops) - set(before[state]) for state, ops in hfsm.table().items()}
        assert not any(added.values()), f"{side} draws an operation"
        hfsm.key(Key.Key_Escape)
        while hfsm.steps():
            hfsm.session.history.undo()
        hfsm.click(hfsm.label_of("State000", "Operation000"))


def test_without_a_selected_operation_every_side_of_its_target_has_its_handle(
    hfsm: Drawer,
) -> None:
    for side in ("left", "right", "top", "bottom"):
        hfsm.hover(hfsm.handle_of("State100", side))
        assert hfsm.canvas.gestures.handle is not None


def test_an_arrowhead_dropped_on_empty_canvas_stays_and_the_reason_is_shown(hfsm: Drawer) -> None:
    hfsm.click(hfsm.label_of("State000", "Operation000"))
    start = hfsm.tip_of("State000", "Operation000")
    hfsm.press(start)
    for step in (10, 60, 150):
        QTest.mouseMove(hfsm.hands_on, start + QPoint(0, step))
    assert "needs a target" in hfsm.canvas.overlays.word.text
    QTest.mouseRelease(
        hfsm.hands_on, Button.LeftButton, Modifier.NoModifier, start + QPoint(0, 150)
    )
    assert hfsm.steps() == 0
    assert "Let go over a state" in hfsm.canvas.overlays.word.text


def test_delete_takes_the_incoming_operations_along(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Delete)
    assert "State111" not in hfsm.table()
    assert hfsm.table()["State110"] == {"Operation110A": "State100"}
    hfsm.session.history.undo()
    assert hfsm.table()["State110"]["Operation110B"] == "State111"


@pytest.mark.parametrize("key", [Key.Key_Tab, Key.Key_Slash])
def test_quick_add_from_the_keyboard(hfsm: Drawer, key: Qt.Key) -> None:
    hfsm.click(hfsm.place("State111"))
    hfsm.key(key)
    hfsm.write("Return", Key.Key_Tab)
    hfsm.write("State000")
    assert hfsm.table()["State111"] == {"Return": "State000"}


def test_tab_goes_on_from_the_state_that_was_added(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State111"))
    for operation, state in (("One", "StateA11"), ("Two", "StateB11"), ("Three", "State000")):
        hfsm.key(Key.Key_Tab)
        hfsm.write(operation, Key.Key_Tab)
        hfsm.write(state)
    table = hfsm.table()
    assert table["State111"] == {"One": "StateA11"}
    assert table["StateA11"] == {"Two": "StateB11"}
    assert table["StateB11"] == {"Three": "State000"}
    assert hfsm.steps() == 3


def test_tab_in_the_last_field_adds_the_operation_and_asks_for_the_next_one(hfsm: Drawer) -> None:
    text = hfsm.session.blueprint.document.text
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    for operation, state in (("One", "StateA11"), ("Two", "StateB11"), ("Three", "State000")):
        hfsm.write(operation, Key.Key_Tab)
        hfsm.write(state, Key.Key_Tab)
    hfsm.key(Key.Key_Escape)
    table = hfsm.table()
    assert table["State111"] == {"One": "StateA11"}
    assert table["StateA11"] == {"Two": "StateB11"}
    assert table["StateB11"] == {"Three": "State000"}
    assert hfsm.steps() == 3
    while hfsm.steps():
        hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text


def test_shift_tab_leads_back_to_the_name_of_the_operation(hfsm: Drawer) -> None:
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_Tab)
    hfsm.write("One", Key.Key_Tab)
    hfsm.key(Key.Key_Backtab, Modifier.ShiftModifier)
    card = hfsm.editor.field
    assert isinstance(card, ConnectCard)
    assert card.operation.hasFocus()
    assert hfsm.steps() == 0
    hfsm.key(Key.Key_Tab)
    hfsm.write("", Key.Key_Backspace)
    hfsm.key(Key.Key_Tab)
    assert "no target" in card.complaint
    assert hfsm.editor.field is card, "what is refused stays, and nothing goes on"


def test_tab_goes_on_from_a_new_state_while_it_is_named(hfsm: Drawer) -> None:
    hfsm.double_click(QPoint(500, 620))
    hfsm.write("StateA11", Key.Key_Tab)
    assert hfsm.table()["StateA11"] == {}
    hfsm.write("One", Key.Key_Tab)
    hfsm.write("State000")
    assert hfsm.table()["StateA11"] == {"One": "State000"}
    assert hfsm.steps() == 2
    hfsm.click(hfsm.place("State111"))
    hfsm.key(Key.Key_F2)
    hfsm.write("Renamed", Key.Key_Tab)
    assert hfsm.editor.field is not None, "a name that is changed is not followed by an operation"
    hfsm.key(Key.Key_Escape)
    assert hfsm.steps() == 2


def test_quick_add_offers_the_names_in_use(hanoi: Drawer) -> None:
    hanoi.session.select((Address("SB1", "State_aaa", "Op_1b"),))
    hanoi.key(Key.Key_Delete)
    hanoi.session.select((Address("SB1", "State_aaa"),))
    hanoi.canvas.setFocus()
    hanoi.key(Key.Key_Tab)
    card = hanoi.editor.field
    assert isinstance(card, ConnectCard)
    hanoi.write("1b", None)
    assert card.choices.names == ("Op_1b",)
    hanoi.key(Key.Key_Down)
    hanoi.key(Key.Key_Return)
    assert hanoi.table()["State_aaa"]["Op_1b"] == "State_baa", "the target follows from its effect"


# Going in and out


def test_a_double_click_on_a_fact_enters_its_sub_sb_and_the_breadcrumb_leads_back(
    hfsm: Drawer,
) -> None:
    hfsm.double_click(hfsm.at(_chip(hfsm, "State100", 1)))
    assert hfsm.session.branch == "SB2"
    crumbs = hfsm.canvas.overlays.breadcrumb
    assert crumbs.words == ("hfsm.json", "SB1", "SB2")
    QTest.mouseClick(
        crumbs, Button.LeftButton, Modifier.NoModifier, crumbs.place_of(1).center().toPoint()
    )
    assert hfsm.session.branch == "SB1"


def _chip(person: Drawer, state: str, digit: int) -> QPointF:
    from smsl_studio.studio.base.paint.node_paint import chip_places

    sheet = person.canvas.sheet
    assert sheet is not None
    face = sheet.picture.face(sheet.picture.index[state])
    place = chip_places(face, sheet.ink, 108.0)[digit].center()
    x, y = person.canvas.positions[state]
    return QPointF(x, y) + place


def test_enter_goes_in_and_backspace_out(hfsm: Drawer) -> None:
    hfsm.key(Key.Key_Return)
    assert hfsm.session.branch == "SB2"
    hfsm.key(Key.Key_Backspace)
    assert hfsm.session.branch == "SB1"


def test_backspace_deletes_nothing(hfsm: Drawer) -> None:
    """It leaves a sub-SB, also if something is selected there, and Del deletes."""
    hfsm.key(Key.Key_Return)
    hfsm.click(hfsm.place("State0"))
    assert hfsm.session.selection
    hfsm.key(Key.Key_Backspace)
    assert hfsm.session.branch == "SB1"
    hfsm.click(hfsm.place("State000"))
    hfsm.key(Key.Key_Backspace)
    assert (hfsm.steps(), hfsm.session.branch) == (0, "SB1")
    hfsm.key(Key.Key_Delete)
    assert hfsm.steps() == 1


def test_a_run_canvas_asks_for_operations_and_edits_nothing(hfsm: Drawer, qtbot: QtBot) -> None:
    hfsm.canvas.editing = False
    asked: list[object] = []
    hfsm.canvas.edge_clicked.connect(asked.append)
    hfsm.click(hfsm.label_of("State000", "Operation000"))
    assert asked == [Address("SB1", "State000", "Operation000")]
    start = hfsm.place("State110")
    before = hfsm.canvas.positions
    hfsm.drag(start, start + QPoint(80, 0))
    hfsm.double_click(QPoint(300, 620))
    hfsm.key(Key.Key_Delete)
    assert hfsm.canvas.positions == before
    assert hfsm.steps() == 0


def test_hfsm_is_drawn_from_an_empty_canvas_by_mouse_and_keyboard(empty: Drawer) -> None:
    for name, x, y in (
        ("State000", 120, 350),
        ("State100", 360, 350),
        ("State110", 600, 180),
        ("State111", 860, 400),
    ):
        empty.double_click(QPoint(x, y))
        empty.write(name)
        empty.key(Key.Key_Escape)
    empty.connect("State000", "State100", "Operation000")
    empty.connect("State100", "State110", "Operation100A")
    empty.connect("State100", "State111", "Operation100B")
    empty.connect("State110", "State100", "Operation110A")
    empty.connect("State110", "State111", "Operation110B")
    assert empty.table() == {
        name: dict(operations) for name, operations in sample("hfsm.json")["SB1"].table.items()
    }
