"""Notes and groups on the canvas: what is painted, what is hit, and what is read out."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QAccessible
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.levels import Level
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.base.canvas.accessible_drawn import DrawnAccessible
from smsl_studio.studio.base.canvas.accessible_tree import CanvasAccessible
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.features.draw.drawn.drawn_editor import DrawnEditor
from tests.stories.at_canvas import Drawer, sample
from tests.studio.base.canvas.test_canvas import alike, on_screen, painted_anew

FREE, HUNG, GROUP = DrawnKey("note", "1"), DrawnKey("note", "2"), DrawnKey("group", "1")


@pytest.fixture
def drawer(qtbot: QtBot) -> Drawer:
    """A canvas with a free note, a note on State000, and a group of two states."""
    blueprint = editing.put_notes(sample("hfsm.json"), "SB1", {
        "1": {"text": "Free", "author": "R. Stein", "date": "2026-11-12", "at": (-120.0, -200.0)},
        "2": {"text": "On it\n" * 30, "at": (-80.0, 60.0), "state": "State000"},
    })  # fmt: skip
    states = ["State100", "State110"]
    blueprint = editing.put_groups(blueprint, "SB1", {"1": {"title": "Two", "states": states}})
    made = Drawer(qtbot, blueprint)
    DrawnEditor(made.session, made.canvas)
    return made


def middle(drawer: Drawer, key: DrawnKey) -> QPoint:
    """The middle of a note or of a title, in pixels."""
    drawn = drawer.sheet.drawn
    rect = drawn.rect(key) if key.kind == "note" else drawn.title_rect(key)
    assert rect is not None
    return drawer.at(rect.center())


def test_nothing_stale_is_left_on_the_screen(drawer: Drawer) -> None:
    def check(what: str) -> None:
        QApplication.processEvents()
        seen = on_screen(drawer)
        assert alike(painted_anew(drawer), seen), what

    def drag(start: QPoint, by: QPoint, what: str) -> None:
        drawer.press(start)
        for share in (0.3, 0.7, 1.0):
            QTest.mouseMove(drawer.hands_on, start + by * share)
            check(f"{what}, {share}")
        QTest.mouseRelease(drawer.hands_on, Qt.MouseButton.LeftButton, pos=start + by)
        check(what)

    steps: list[tuple[str, Callable[[], object]]] = [
        ("choose a note", lambda: drawer.click(middle(drawer, FREE))),
        ("choose another", lambda: drawer.click(middle(drawer, HUNG))),
        ("choose a group", lambda: drawer.click(middle(drawer, GROUP))),
        ("find both", lambda: drawer.canvas.mark_drawn(frozenset({FREE, GROUP}))),
        ("find none", lambda: drawer.canvas.mark_drawn(frozenset())),
        ("choose a state", lambda: drawer.click(drawer.place("State111"))),
    ]
    for what, step in steps:
        step()
        check(what)
    drag(middle(drawer, FREE), QPoint(130, 90), "drag a note")
    drag(middle(drawer, HUNG), QPoint(-60, 50), "drag a note on a state")
    drag(drawer.place("State000"), QPoint(30, -90), "drag a state with a note")
    drag(drawer.place("State110"), QPoint(90, -90), "drag a state of a group")
    drag(middle(drawer, GROUP), QPoint(-60, 60), "drag a group")
    inside = drawer.sheet.drawn.rect(GROUP)
    assert inside is not None
    into = drawer.at(inside.center()) - drawer.place("State111")
    drag(drawer.place("State111"), into, "drag a state into a group")
    drag(drawer.place("State111"), QPoint(0, 260), "drag it out again")
    for _ in range(7):
        drawer.session.history.undo()
        check("undo")
    drawer.canvas.zoom_to(0.4)
    check("zoom out")
    drag(middle(drawer, GROUP), QPoint(20, 30), "drag a group from afar")


def test_a_drag_that_is_cancelled_moves_nothing(drawer: Drawer) -> None:
    text = drawer.session.blueprint.document.text
    for key in (FREE, GROUP):
        start = middle(drawer, key)
        drawer.press(start)
        QTest.mouseMove(drawer.hands_on, start + QPoint(70, 70))
        drawer.key(Qt.Key.Key_Escape)
        QTest.mouseRelease(drawer.hands_on, Qt.MouseButton.LeftButton, pos=start + QPoint(70, 70))
        assert middle(drawer, key) == start
    assert drawer.session.blueprint.document.text == text


def test_nodes_lie_above_notes_and_operations_above_titles(drawer: Drawer) -> None:
    canvas = drawer.canvas
    at = canvas.positions["State000"]
    drawer.session.edit("x", lambda bp: editing.put_notes(bp, "SB1", {"1": {"at": at}}))
    assert canvas.drawn_at(QPointF(*at)) is None
    assert canvas.drawn_at(QPointF(at[0] + 100.0, at[1] + 12.0)) == FREE
    rect = drawer.sheet.drawn.title_rect(GROUP)
    assert rect is not None
    assert canvas.drawn_at(rect.center()) == GROUP
    assert canvas.drawn_at(QPointF(rect.center().x(), rect.bottom() + 6.0)) is None


def test_far_away_titles_go_and_notes_stay(drawer: Drawer) -> None:
    rect = drawer.sheet.drawn.rect(FREE)
    drawer.canvas.zoom_to(0.1)
    assert drawer.sheet.level is Level.DOT
    assert drawer.sheet.drawn.rect(FREE) == rect
    frame = drawer.sheet.drawn.rect(GROUP)
    assert frame is not None
    assert drawer.canvas.drawn_at(QPointF(frame.center().x(), frame.top() + 20.0)) is None


def test_the_whole_drawing_has_its_notes_in_view(drawer: Drawer) -> None:
    far = {"1": {"at": (-1500.0, 900.0)}}
    drawer.session.edit("x", lambda bp: editing.put_notes(bp, "SB1", far))
    drawer.canvas.fit()
    rect = drawer.sheet.drawn.rect(FREE)
    assert rect is not None
    assert drawer.canvas.seen.contains(rect)


def test_a_tooltip_has_the_words_that_are_not_drawn(drawer: Drawer) -> None:
    drawer.hover(middle(drawer, FREE))
    assert drawer.hands_on.toolTip() == ""
    drawer.hover(middle(drawer, HUNG))
    assert drawer.hands_on.toolTip().count("On it") == 30
    drawer.hover(middle(drawer, GROUP))
    assert drawer.hands_on.toolTip() == "Group Two, 2 states"
    drawer.hover(drawer.place("State111"))
    assert "Group" not in drawer.hands_on.toolTip()


def test_where_nothing_can_be_edited_a_note_is_not_dragged(drawer: Drawer) -> None:
    drawer.canvas.editing = False
    text, start = drawer.session.blueprint.document.text, middle(drawer, FREE)
    drawer.drag(start, start + QPoint(60, 0))
    assert drawer.session.blueprint.document.text == text
    assert drawer.canvas.drawn.chosen is None


def test_a_screen_reader_finds_them_after_the_states(drawer: Drawer) -> None:
    tree = CanvasAccessible(drawer.canvas)
    assert tree.childCount() == 4 + 3
    children = [tree.child(index) for index in range(4, 7)]
    assert all(isinstance(one, DrawnAccessible) for one in children)
    names = [one.text(QAccessible.Text.Name) for one in children]
    assert names[0] == "Group Two, 2 states"
    assert names[1] == "Note: Free, R. Stein, 12 Nov 2026"
    assert names[2].endswith("on State000")
    assert [one.role() for one in children] == [
        QAccessible.Role.Grouping, QAccessible.Role.Note, QAccessible.Role.Note
    ]  # fmt: skip
    assert [tree.indexOfChild(one) for one in children] == [4, 5, 6]
    drawer.click(middle(drawer, FREE))
    assert tree.focusChild() is children[1]
    assert children[1].text(QAccessible.Text.Name).endswith("selected")
    assert children[1].state().selected
    place = drawer.hands_on.mapToGlobal(middle(drawer, FREE))
    assert tree.childAt(place.x(), place.y()) is children[1]
    assert children[1].rect().contains(place)
    gone = {"1": None}
    drawer.session.edit("x", lambda bp: editing.put_notes(bp, "SB1", gone))
    assert not children[1].isValid()
    assert children[1].text(QAccessible.Text.Name) == ""
    assert children[1].rect().isEmpty()
    assert tree.childCount() == 6


def test_what_a_hidden_canvas_has_is_not_told_as_shown(drawer: Drawer) -> None:
    """A screen reader read the states of the hidden Run page beside those of the drawing."""
    tree = CanvasAccessible(drawer.canvas)
    children = [tree.child(index) for index in range(tree.childCount())]
    everything = [tree, *children, children[0].child(0)]
    assert not any(one.state().invisible for one in everything)
    drawer.canvas.hide()
    assert all(one.state().invisible for one in everything)
    drawer.canvas.show()
    assert not any(one.state().invisible for one in everything)


def test_an_edit_of_a_note_keeps_the_routes(drawer: Drawer) -> None:
    sheet, picture = drawer.sheet, drawer.sheet.picture
    change = {"1": {"text": "Other words"}}
    drawer.session.edit("x", lambda bp: editing.put_notes(bp, "SB1", change))
    assert drawer.sheet is sheet
    assert sheet.picture is picture
    assert sheet.drawn.parts.notes[0].text == "Other words"


def test_a_canvas_without_notes_lays_out_none(qtbot: QtBot) -> None:
    drawer = Drawer(qtbot, sample("hfsm.json"))
    assert not drawer.sheet.drawn
    assert drawer.sheet.drawn.extent().isNull()
    assert drawer.canvas.drawn_at(QPointF(*drawer.canvas.positions["State000"])) is None
    assert drawer.canvas.rect_of(Address("SB1", "State000")) is not None


@pytest.fixture
def passed(qtbot: QtBot) -> Drawer:
    """A group whose title lies on the way of an operation."""
    table = {"A": {"Go": "B"}, "B": {}}
    layout = {"A": [0, -300], "B": [0, 0], "_groups": {"1": {"title": "Below", "states": ["B"]}}}
    text = json.dumps({"SB1": {**table, "_layout": layout}})
    made = Drawer(qtbot, read_blueprint(parse_json(text, "passed.json")))
    DrawnEditor(made.session, made.canvas)
    made.canvas.zoom_to(1.0)
    return made


def test_a_line_passes_below_the_words_of_a_title(passed: Drawer) -> None:
    title = middle(passed, GROUP)
    area = QRect(title - QPoint(12, 9), QSize(24, 18))
    before = on_screen(passed).copy(area)
    passed.session.edit("Delete", lambda bp: editing.delete(bp, [Address("SB1", "A", "Go")]))
    passed.hover(QPoint(5, 690))
    assert alike(on_screen(passed).copy(area), before)


def test_a_press_takes_what_lies_on_top_at_a_title(passed: Drawer) -> None:
    canvas, title = passed.canvas, middle(passed, GROUP)
    passed.click(title)
    assert canvas.drawn.chosen == GROUP
    passed.click(passed.label_of("A", "Go"))
    assert passed.selected() == ["A/Go"]
    passed.click(title)
    assert passed.selected() == ["A/Go"], "the line of the selected operation lies above the title"
    passed.click(title + QPoint(20, 0))
    assert canvas.drawn.chosen == GROUP


def test_a_bend_on_a_title_is_dragged_and_not_the_group(passed: Drawer) -> None:
    start, places = passed.label_of("A", "Go"), passed.canvas.positions
    passed.click(start)
    line = passed.at((0.0, -180.0))
    beside = middle(passed, GROUP) + QPoint(24, 0)
    passed.drag(line, beside)
    edge = passed.sheet.picture.edge(Address("SB1", "A", "Go"))
    ((x, y),) = passed.sheet.lines[edge].bends
    bend = passed.at((x, y))
    assert passed.canvas.drawn_at(passed.canvas.mapToScene(bend)) is None
    passed.drag(bend, bend + QPoint(90, -60))
    ((x_after, y_after),) = passed.sheet.lines[edge].bends
    assert (x_after, y_after) != (x, y)
    assert passed.canvas.positions == places
    assert passed.canvas.drawn.chosen is None
    assert passed.selected() == ["A/Go"]
