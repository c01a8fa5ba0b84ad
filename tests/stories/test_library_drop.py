"""A line of the library is dragged to the canvas, or used there by Enter."""

from __future__ import annotations

import random

import pytest
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import (
    QDrag,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDragMoveEvent,
    QDropEvent,
    QMouseEvent,
)
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.library_drop import KIND, library_data
from smsl_studio.studio.features.draw.canvas.library_verbs import LibraryVerbs
from smsl_studio.studio.features.draw.panels import library_list
from smsl_studio.studio.features.draw.panels.library import LibraryEntry
from tests.stories.at_canvas import Drawer
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.studio.base.canvas.test_canvas import alike, on_screen, painted_anew

Key = Qt.Key
COPY, LEFT = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton
NONE = Qt.KeyboardModifier.NoModifier


class Dragger:
    """Drags a line of the library over a canvas, as Qt tells a widget of it."""

    def __init__(self, person: Drawer, kind: str = "operation") -> None:
        self.person, self.kind = person, kind
        self.drop = LibraryVerbs(person.editor).drop
        self.data = QMimeData()

    def over(self, name: str, at: QPoint) -> str:
        """Drag it over a point; returns what it says there."""
        self.data = library_data(self.kind, name)
        enter = QDragEnterEvent(at, COPY, self.data, LEFT, NONE)
        QApplication.sendEvent(self.person.hands_on, enter)
        QApplication.sendEvent(
            self.person.hands_on, QDragMoveEvent(at, COPY, self.data, LEFT, NONE)
        )
        return self.person.canvas.overlays.word.text

    def let_go(self, at: QPoint) -> None:
        QApplication.sendEvent(
            self.person.hands_on, QDropEvent(QPointF(at), COPY, self.data, LEFT, NONE)
        )
        QApplication.processEvents()

    def leave(self) -> None:
        QApplication.sendEvent(self.person.hands_on, QDragLeaveEvent())


def between(person: Drawer, a: str, b: str, share: float) -> QPoint:
    """A point on the way from one state to another."""
    (ax, ay), (bx, by) = person.canvas.positions[a], person.canvas.positions[b]
    return person.at((ax + (bx - ax) * share, ay + (by - ay) * share))


def test_dropped_on_a_state_it_leads_where_its_effect_leads_elsewhere(hanoi: Drawer) -> None:
    hanoi.session.select((Address("SB1", "State_aaa", "Op_1b"),))
    hanoi.key(Key.Key_Delete)
    text, hand = hanoi.session.blueprint.document.text, Dragger(hanoi)
    at = hanoi.place("State_aaa")
    assert hand.over("Op_1b", at) == "Op_1b: State_aaa to State_baa"
    sketch = hanoi.canvas.gestures.sketch
    assert sketch is not None
    assert [name for _, _, name in sketch.operations] == ["Op_1b"]
    assert hanoi.session.blueprint.document.text == text, "nothing is done before the drop"
    hand.let_go(at)
    assert hanoi.canvas.gestures.sketch is None
    assert hanoi.table()["State_aaa"]["Op_1b"] == "State_baa"
    assert hanoi.selected() == ["State_aaa/Op_1b"]
    hanoi.session.history.undo()
    assert hanoi.session.blueprint.document.text == text


def test_without_a_known_effect_the_target_is_a_new_state_or_one_that_is_clicked(
    hfsm: Drawer,
) -> None:
    hand = Dragger(hfsm)
    said = hand.over("Inspect", hfsm.place("State111"))
    assert said == "Inspect: State111 to a new state, or to one that you click"
    assert hfsm.canvas.gestures.sketch is not None
    assert len(hfsm.canvas.gestures.sketch.states) == 1
    hand.let_go(hfsm.place("State111"))
    card = hfsm.editor.field
    assert isinstance(card, ConnectCard)
    assert card.operation.text() == "Inspect"
    hfsm.click(hfsm.place("State100"))
    assert hfsm.table()["State111"] == {"Inspect": "State100"}
    assert hfsm.steps() == 1
    hand.over("Again", hfsm.place("State111"))
    hand.let_go(hfsm.place("State111"))
    hfsm.write("StateA11")
    assert hfsm.table()["State111"]["Again"] == "StateA11"
    assert hfsm.selected() == ["State111/Again"]


def test_a_state_that_has_the_effect_already_is_not_the_target_itself(hanoi: Drawer) -> None:
    hand, at = Dragger(hanoi), hanoi.place("State_baa")
    said = hand.over("Op_1b", at)
    assert said == "Op_1b: State_baa to a new state, or to one that you click"
    hand.let_go(at)
    card = hanoi.editor.field
    assert isinstance(card, ConnectCard)
    assert card.target.hasFocus()
    assert card.target.text() not in hanoi.table()
    hanoi.click(hanoi.place("State_aaa"))
    assert hanoi.table()["State_baa"]["Op_1b"] == "State_aaa"


def test_dropped_between_two_states_it_leads_from_the_nearer_one(hfsm: Drawer) -> None:
    hand = Dragger(hfsm)
    hfsm.session.edit("Clear", _without_edges)
    for share, ends in ((0.38, ("State000", "State100")), (0.62, ("State100", "State000"))):
        at = between(hfsm, "State000", "State100", share)
        assert hand.over("Inspect", at) == "Inspect: {} to {}".format(*ends)
        hand.let_go(at)
        assert hfsm.table()[ends[0]]["Inspect"] == ends[1]
        assert hfsm.selected() == [f"{ends[0]}/Inspect"]
        hfsm.session.history.undo()


def _without_edges(blueprint: Blueprint) -> Blueprint:
    return editing.delete(blueprint, [Address("SB1", "State000", "Operation000")])


def test_dropped_on_the_line_of_an_operation_it_goes_the_same_way(hfsm: Drawer) -> None:
    hand, at = Dragger(hfsm), hfsm.label_of("State000", "Operation000")
    assert hand.over("Inspect", at) == "Inspect: State000 to State100"


def test_on_empty_canvas_it_starts_from_the_selected_state(hfsm: Drawer) -> None:
    hand, at = Dragger(hfsm), QPoint(60, 640)
    assert "on a state or between two" in hand.over("Inspect", at)
    hand.let_go(at)
    assert hfsm.editor.field is None
    assert "on a state or between two" in hfsm.canvas.overlays.word.text
    hfsm.click(hfsm.place("State111"))
    assert hand.over("Inspect", at).startswith("Inspect: State111 to a new state")
    point = hfsm.canvas.mapToScene(at)
    hand.let_go(at)
    hfsm.write("StateA11")
    assert hfsm.table()["State111"] == {"Inspect": "StateA11"}
    x, y = hfsm.canvas.positions["StateA11"]
    assert abs(x - point.x()) <= 4
    assert abs(y - point.y()) <= 4
    assert hfsm.steps() == 1


def test_a_state_that_has_the_operation_says_so(hfsm: Drawer) -> None:
    hand, at = Dragger(hfsm), hfsm.place("State000")
    assert hand.over("Operation000", at) == "State000 has an operation Operation000 already."
    hand.let_go(at)
    assert hfsm.editor.field is None
    assert hfsm.steps() == 0


def test_an_empty_drawing_says_what_is_missing(qtbot: QtBot) -> None:
    empty = Drawer(qtbot)
    assert "Add a state first" in Dragger(empty).over("Inspect", QPoint(300, 300))


def test_a_drag_that_leaves_takes_its_sketch_along_and_nothing_stale_stays(hfsm: Drawer) -> None:
    hand = Dragger(hfsm)
    for at in (hfsm.place("State111"), between(hfsm, "State000", "State110", 0.5)):
        hand.over("Inspect", at)
        assert alike(painted_anew(hfsm), on_screen(hfsm))
    hand.leave()
    assert hfsm.canvas.gestures.sketch is None
    assert hfsm.canvas.overlays.word.text == ""
    seen = on_screen(hfsm)
    assert alike(painted_anew(hfsm), seen)


def test_where_nothing_can_be_edited_and_for_files_the_canvas_takes_no_drop(hfsm: Drawer) -> None:
    hand = Dragger(hfsm)
    files = QMimeData()
    files.setUrls([QUrl.fromLocalFile("/nowhere.json")])
    at = hfsm.place("State111")
    enter = QDragEnterEvent(at, COPY, files, LEFT, NONE)
    assert not hand.drop.eventFilter(hfsm.hands_on, enter)
    hfsm.canvas.editing = False
    hand.over("Inspect", at)
    assert hfsm.canvas.gestures.sketch is None


def test_the_pattern_of_a_plugin_asks_for_the_rest_of_the_name(hfsm: Drawer) -> None:
    hand = Dragger(hfsm)
    hand.over("Op_move{disk}", hfsm.place("State111"))
    hand.let_go(hfsm.place("State111"))
    card = hfsm.editor.field
    assert isinstance(card, ConnectCard)
    assert card.operation.text() == "Op_move"
    hfsm.write("7", Key.Key_Tab)
    hfsm.write("State000")
    assert hfsm.table()["State111"] == {"Op_move7": "State000"}


@pytest.mark.parametrize("seed", range(4))
def test_any_drops_are_undone_to_the_same_bytes(hfsm: Drawer, seed: int) -> None:
    chance, text, hand = random.Random(seed), hfsm.session.blueprint.document.text, Dragger(hfsm)
    names = ["Operation000", "Operation100A", "Inspect", "Op_move{disk}", "a b"]
    for _ in range(25):
        states = [*hfsm.canvas.positions]
        hfsm.session.select(
            Address("SB1", name) for name in chance.sample(states, chance.randint(0, 2))
        )
        at = chance.choice([
            hfsm.place(chance.choice(states)),
            between(hfsm, chance.choice(states), chance.choice(states), chance.random()),
            QPoint(chance.randrange(900), chance.randrange(650)),
        ])  # fmt: skip
        before = hfsm.steps()
        hand.over(chance.choice(names), at)
        hand.let_go(at)
        if hfsm.editor.field is not None:
            hfsm.key(chance.choice((Key.Key_Return, Key.Key_Escape)))
        if hfsm.editor.field is not None:
            hfsm.key(Key.Key_Escape)
        assert hfsm.steps() - before in (0, 1)
        if hfsm.steps() > before:
            assert len(hfsm.selected()) == 1
    while hfsm.steps():
        hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text


# In the window: the panel


def press_enter_on(person: Person, text: str) -> None:
    """Go to a line of the library with the keys, and press Enter."""
    library = person.window.library
    library.list.setFocus()
    library.list.setCurrentIndex(person.row(library.list, text))
    QTest.keyClick(library.list, Key.Key_Return)


def test_enter_on_a_line_begins_it_at_the_selected_state(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.window.library.set_offers([LibraryEntry("Op_Inspect", "clinic")])
    person.select("SB1/State111")
    press_enter_on(person, "Op_Inspect")
    person.type("State000")
    person.press(Key.Key_Return)
    assert person.blueprint["SB1"].table["State111"] == {"Op_Inspect": "State000"}
    assert person.selected() == ["SB1/State111/Op_Inspect"]
    person.select("SB1/State110", "SB1/State000")
    press_enter_on(person, "Op_Inspect")
    assert person.blueprint["SB1"].table["State110"]["Op_Inspect"] == "State000"
    assert len(person.steps()) == 2


def test_without_a_selected_state_enter_selects_the_operations_as_a_click_does(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    press_enter_on(person, "Operation100A")
    assert person.selected() == ["SB1/State100/Operation100A"]
    person.click_row(person.window.library.list, "Operation110B")
    assert person.selected() == ["SB1/State110/Operation110B"]


def test_a_drag_over_the_canvas_of_a_narrow_window_closes_the_drawer(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1100, 760))
    person.ctrl(Key.Key_B)
    drawer = person.window.docks.drawer
    person.until(drawer.isVisible)
    data, at = library_data("operation", "Inspect"), person.place("SB1/State111")
    enter = QDragEnterEvent(at, COPY, data, LEFT, NONE)
    QApplication.sendEvent(person.window.canvas.viewport(), enter)
    assert enter.isAccepted()
    assert not drawer.isVisible()


def test_a_row_is_dragged_with_its_name_and_the_selection_stays(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    person, dragged = sit(SAMPLES / "hfsm.json"), []

    class Drag(QDrag):
        """A drag that nobody ends: Qt would wait for the pointer."""

        def exec(self, *_: object) -> Qt.DropAction:
            dragged.append(bytes(self.mimeData().data(KIND).data()))
            return COPY

    monkeypatch.setattr(library_list, "QDrag", Drag)
    person.select("SB1/State111")
    rows = person.window.library.list
    person.window.show_tab("Library")
    person.until(rows.isVisible)
    person.until(lambda: rows.viewport().height() > 60)
    rows.scrollTo(person.row(rows, "Operation110B"))
    start = rows.visualRect(person.row(rows, "Operation110B")).center()
    QTest.mousePress(rows.viewport(), LEFT, NONE, start)
    for step in (4, 12, 30, 60):
        move = QMouseEvent(
            QEvent.Type.MouseMove, QPointF(start + QPoint(step, 0)),
            QPointF(rows.viewport().mapToGlobal(start + QPoint(step, 0))),
            Qt.MouseButton.NoButton, LEFT, NONE,
        )  # fmt: skip
        QApplication.sendEvent(rows.viewport(), move)
    QTest.mouseRelease(rows.viewport(), LEFT, NONE, start + QPoint(60, 0))
    assert dragged == [b"operation Operation110B"]
    assert person.selected() == ["SB1/State111"]
