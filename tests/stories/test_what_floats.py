"""Floating parts over the drawing close when their element is gone or moved."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QEnterEvent, QHelpEvent
from PySide6.QtWidgets import QApplication, QToolTip
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing
from smsl_studio.generate.rules import hanoi
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.shell.frame import screen_room
from tests.stories.at_canvas import Drawer
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


def test_the_buttons_of_a_state_go_with_it_when_it_is_moved_back(sit: Sit) -> None:
    person = sit(HFSM)
    centre = person.place("SB1/State100")
    person.drag(centre, centre + (person.place("SB1/State000") - centre) / 4)
    rest_on(person, "SB1/State100")
    pad = person.window.canvas.overlays.pad
    before = pad.geometry()
    person.ctrl(Key.Key_Z)
    assert pad.isHidden() or pad.geometry() != before
    person.move_to(QPoint(20, person.window.canvas.height() - 20))
    person.until(lambda: pad.isVisible() and pad.geometry() != before)
    assert not pad.geometry().intersects(node(person, "SB1/State100"))


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


def on_view(person: Person, rect: QRectF | None) -> QRect:
    """A part of the scene in pixels of the canvas."""
    assert rect is not None
    return person.window.canvas.mapFromScene(rect).boundingRect()


def node(person: Person, state: str) -> QRect:
    return on_view(person, person.window.canvas.rect_of(person.blueprint.resolve(state)))


def test_the_path_covers_no_state_wherever_one_looks(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    canvas = person.window.canvas
    canvas.camera.motion = False
    crumb = canvas.overlays.breadcrumb
    home = crumb.pos()
    canvas.zoom_to(1.0)
    for dx in range(-400, 401, 100):
        for dy in range(-400, 401, 100):
            canvas.fit(smooth=False)
            canvas.camera.pan(dx, dy)
            for name in canvas.positions:
                assert not node(person, f"SB1/{name}").intersects(crumb.geometry()), (dx, dy)
            assert canvas.rect().contains(crumb.geometry())
    canvas.fit(smooth=False)
    assert crumb.pos() == home


def test_the_key_to_short_names_covers_no_state_wherever_one_looks(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json", (900, 560))
    canvas = person.window.canvas
    canvas.camera.motion = False
    key = canvas.overlays.key
    canvas.zoom_to(0.5)
    shown = 0
    for dx in range(-300, 301, 100):
        for dy in range(-300, 301, 75):
            canvas.fit(smooth=False)
            canvas.zoom_to(0.5)
            canvas.camera.pan(dx, dy)
            if key.isHidden():
                continue
            shown += 1
            assert canvas.rect().contains(key.geometry())
            for name in canvas.positions:
                assert not node(person, f"SB1/{name}").intersects(key.geometry()), (dx, dy)
    assert shown > 5, "it is shown where there is room"


def test_the_zoom_control_covers_no_state_wherever_one_looks(sit: Sit) -> None:
    person = sit(HFSM, (853, 466))
    canvas, zoom = person.window.canvas, person.window.canvas.overlays.zoom
    canvas.camera.motion = False
    canvas.fit(smooth=False)
    home, shown, seen = zoom.pos(), 0, 0
    for dx in range(-150, 151, 75):
        for dy in range(-150, 151, 75):
            canvas.fit(smooth=False)
            canvas.zoom_to(1.0)
            canvas.camera.pan(dx, dy)
            seen += 1
            if zoom.isHidden():
                continue
            shown += 1
            assert canvas.rect().contains(zoom.geometry())
            for name in canvas.positions:
                assert not node(person, f"SB1/{name}").intersects(zoom.geometry()), (dx, dy)
    assert shown > seen / 2, "it is shown where there is room"
    canvas.fit(smooth=False)
    assert zoom.pos() == home
    assert zoom.isVisible()


def test_the_drawing_shows_through_a_map_that_lies_on_states(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    canvas, map_ = person.window.canvas, person.window.canvas.overlays.map
    canvas.camera.motion = False
    canvas.zoom_to(1.0)
    person.until(map_.isVisible)
    seen = set()
    for dx in range(-400, 401, 80):
        canvas.fit(smooth=False)
        canvas.zoom_to(1.0)
        canvas.camera.pan(dx, -dx / 2)
        places = [node(person, f"SB1/{name}") for name in canvas.positions]
        covers = any(place.intersects(map_.geometry()) for place in places)
        assert map_.faint or not covers
        seen.add(map_.faint)
        if map_.faint:
            at = QPointF(map_.rect().center())
            QApplication.sendEvent(map_, QEnterEvent(at, at, QPointF(map_.mapToGlobal(at))))
            assert not map_.faint, "with the pointer on it, it is seen whole"
            QApplication.sendEvent(map_, QEvent(QEvent.Type.Leave))
    assert seen == {True, False}


def test_a_state_with_an_error_is_red_on_the_map_and_a_selected_one_blue(
    sit: Sit, tmp_path: Path
) -> None:
    path = tmp_path / "wrong.json"
    text = HFSM.read_text("utf-8").replace('"State110": {', '"State110": {"Op": "Nowhere", ')
    path.write_text(text)
    person = sit(path, (1440, 900))
    canvas, map_ = person.window.canvas, person.window.canvas.overlays.map
    person.until_inspected()
    state = person.blueprint.resolve("SB1/State110")
    person.until(lambda: state in canvas.marks.findings or bool(canvas.marks.findings))
    canvas.set_marks(replace(canvas.marks, findings={state: "E"}))

    def colours() -> set[str]:
        image = map_.grab().toImage()
        spots = ((x, y) for x in range(image.width()) for y in range(image.height()))
        return {image.pixelColor(x, y).name() for x, y in spots}

    person.until(map_.isVisible)
    person.window.session.select(())
    assert LIGHT.bad.name() in colours()
    person.window.session.select((state,))
    assert LIGHT.bad.name() not in colours()


def test_the_legend_of_a_run_leaves_the_running_operation_free(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))
    person = sit(HFSM)
    person.window.resize(853, 466)
    person.ctrl(Key.Key_2)
    canvas = person.window.features.run.pane.canvas.canvas
    person.until(lambda: canvas.isVisible() and canvas.width() < 400)
    legend, shown = canvas.overlays.run_legend, 0
    for state, row in person.blueprint["SB1"].table.items():
        for name in row:
            operation = person.blueprint.resolve(f"SB1/{state}/{name}")
            words = f"{name} 2.9 of 4.9 s"
            canvas.set_marks(
                Marks(active=state, running=(operation, 0.5), running_words=words, dimmed=True)
            )
            assert canvas.sheet is not None
            label = canvas.lit_layer.shown()[canvas.sheet.picture.edge(operation)]
            left, top, right, bottom = label.rect
            place = canvas.mapFromScene(QRectF(left, top, right - left, bottom - top))
            shown += legend.isVisible()
            assert legend.isHidden() or not place.boundingRect().intersects(legend.geometry()), name
    assert shown


@pytest.mark.parametrize(
    ("size", "lines", "zoom"),
    [((660, 350), 6, 0.5), ((660, 350), 6, 2.0), ((660, 350), 4, 0.5), ((853, 466), 2, 1.0)],
)
def test_the_legend_of_a_run_leaves_the_active_state_of_a_far_picture_free(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, size: tuple[int, int], lines: int, zoom: float
) -> None:
    """There it is larger than its place, and the legend lay on half of it."""
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))
    person = sit(SAMPLES / "hanoi.json")
    person.window.resize(*size)
    person.ctrl(Key.Key_2)
    canvas = person.window.features.run.pane.canvas.canvas
    canvas.camera.motion = False
    person.until(lambda: canvas.isVisible() and canvas.width() < 400)
    canvas.overlays.show_banner("Stopped by a person again. " * lines)
    canvas.fit(smooth=False)
    canvas.zoom_to(canvas.zoom * zoom)
    legend = canvas.overlays.run_legend
    for state in person.blueprint["SB1"].table:
        canvas.set_marks(Marks(active=state, dimmed=True))
        if legend.isVisible():
            assert canvas.rect().contains(legend.geometry()), "its last rows were cut"
            assert not legend.geometry().intersects(canvas.overlays.banner.geometry())
            assert state not in below(canvas, legend.geometry().adjusted(-4, -4, 4, 4)), "its ring"


@pytest.mark.parametrize("size", [(634, 336), (853, 466), (960, 540)])
def test_the_name_of_the_running_operation_lies_on_no_tool_and_on_none_of_its_states(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, size: tuple[int, int]
) -> None:
    """In a far picture it lay half below *Follow*, or on the active state."""
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))
    person = sit(SAMPLES / "hanoi.json")
    person.window.resize(*size)
    person.ctrl(Key.Key_2)
    canvas = person.window.features.run.pane.canvas.canvas
    canvas.camera.motion = False
    person.until(lambda: canvas.isVisible() and canvas.width() < 450)
    person.until(lambda: (person.window.width(), person.window.height()) == size)
    canvas.fit(smooth=False)
    canvas.refresh_pool()
    for state, row in person.blueprint["SB1"].table.items():
        for name, target in row.items():
            operation = person.blueprint.resolve(f"SB1/{state}/{name}")
            canvas.set_marks(
                Marks(
                    active=state,
                    running=(operation, 0.5),
                    running_words=f"{name} 2.9 s",
                    dimmed=True,
                )
            )
            assert canvas.sheet is not None
            label = canvas.lit_layer.shown()[canvas.sheet.picture.edge(operation)]
            left, top, right, bottom = label.rect
            place = canvas.mapFromScene(QRectF(left, top, right - left, bottom - top))
            assert place.boundingRect().top() >= 40, f"{name} lies below the tools"
            assert canvas.rect().contains(place.boundingRect()), name
            hit = below(canvas, place.boundingRect().adjusted(1, 1, -1, -1))
            assert not hit & {state, target}, f"{name} from {state}"


def below(canvas: Canvas, area: QRect) -> set[str]:
    """The states that are hit at points of an area of the view."""
    assert canvas.sheet is not None
    xs, ys = range(area.left(), area.right(), 4), range(area.top(), area.bottom(), 4)
    points = [canvas.mapToScene(x, y) for x in xs for y in ys]
    found = {canvas.sheet.state_at(at.x(), at.y()) for at in points} - {-1}
    return {canvas.sheet.picture.names[one] for one in found}


@pytest.mark.parametrize("size", [(1280, 690), (1280, 696)])
def test_the_zoom_control_covers_no_state_beside_a_new_one(
    sit: Sit, size: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))
    person = sit(SAMPLES / "hanoi.json", (1440, 900))
    person.window.resize(*size)
    canvas, zoom = person.window.canvas, person.window.canvas.overlays.zoom
    canvas.camera.motion = False
    canvas.fit(smooth=False)
    person.press(Key.Key_N, [Modifier.ControlModifier, Modifier.ShiftModifier])
    person.press(Key.Key_Return)
    person.until(lambda: len(canvas.positions) == 28)
    assert zoom.isHidden() or not below(canvas, zoom.geometry())
    canvas.fit(smooth=False)
    assert zoom.isHidden() or not below(canvas, zoom.geometry())


def test_the_legend_leaves_a_note_free(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    canvas = person.window.canvas
    legend = canvas.overlays.legend
    assert legend.isVisible()
    corner = canvas.mapToScene(legend.geometry().topLeft())
    words = {"1": {"text": "Ask the clinic", "at": (corner.x(), corner.y())}}
    person.window.session.edit("Note", lambda bp: editing.put_notes(bp, "SB1", words))
    for way in range(-40, 41, 20):
        canvas.camera.pan(way, 0)
        assert canvas.sheet is not None
        note = on_view(person, canvas.sheet.drawn.rect(DrawnKey("note", "1")))
        assert legend.isHidden() or not legend.geometry().intersects(note)


def test_a_tooltip_of_a_state_says_what_the_node_does_not_and_lies_below_it(sit: Sit) -> None:
    person = sit(HFSM, (1280, 800))
    person.move_to(person.place("SB1/State110") - QPoint(0, 14))
    assert person.window.canvas.viewport().toolTip() == "", "its name is in the node"
    note = {"note": "The clamp is open."}
    person.window.session.edit(
        "Note", lambda bp: editing.set_note(bp, "SB1", "_states", "State100", note)
    )
    viewport = person.window.canvas.viewport()
    place = person.place("SB1/State100") - QPoint(0, 14)
    person.move_to(place)
    rest = QHelpEvent(QEvent.Type.ToolTip, place, viewport.mapToGlobal(place))
    QApplication.sendEvent(viewport, rest)
    assert QToolTip.text() == "The clamp is open."
    tip = next(w for w in QApplication.topLevelWidgets() if w.inherits("QTipLabel"))
    below = node(person, "SB1/State100").bottom()
    assert viewport.mapFromGlobal(tip.geometry().topLeft()).y() >= below
    QToolTip.hideText()


def test_the_values_of_a_fact_leave_the_state_free(sit: Sit) -> None:
    person = sit(HFSM, (780, 700))
    window = person.window
    for _ in range(2):
        person.select("SB1/State100")
        window.canvas.setFocus()
        person.press(Key.Key_D)
        person.until(lambda: QApplication.activePopupWidget() is not None)
        menu = QApplication.activePopupWidget()
        assert menu is not None
        area = QRect(window.canvas.viewport().mapFromGlobal(menu.pos()), menu.size())
        assert not area.intersects(node(person, "SB1/State100"))
        menu.close()
        person.come_back()
        screen = window.screen().availableGeometry()
        foot = window.canvas.viewport().mapToGlobal(node(person, "SB1/State100").bottomLeft())
        window.move(window.pos() + QPoint(0, screen.bottom() - 30 - foot.y()))


def test_the_zoom_control_stays_while_the_pointer_is_on_it(sit: Sit) -> None:
    person = sit(SAMPLES / "registration.json", (1240, 768))
    canvas, zoom = person.window.canvas, person.window.canvas.overlays.zoom
    canvas.camera.motion = False
    person.until(lambda: zoom.isVisible() and canvas.camera.fitted)
    before, at = zoom.geometry(), QPointF(zoom.more.geometry().center())
    enter = QEnterEvent(at, at, QPointF(zoom.mapToGlobal(at)))
    QApplication.sendEvent(zoom, enter)
    for _ in range(4):
        held = canvas.zoom
        hit = zoom.childAt(at.toPoint())
        assert hit is zoom.more
        person.click(hit)
        assert canvas.zoom > held
        assert zoom.geometry() == before
    QApplication.sendEvent(zoom, QEvent(QEvent.Type.Leave))
    assert zoom.geometry() != before, "it would have gone away under the pointer"
    assert zoom.outside.isVisible()


def pad_shows(person: Person, state: str) -> None:
    """Wait until the buttons stand beside a state."""
    pad = person.window.canvas.overlays.pad
    person.until(lambda: pad.address == person.blueprint.resolve(state))


def test_the_buttons_come_back_after_a_click_on_the_state_under_the_pointer(sit: Sit) -> None:
    person = sit(HFSM, (1440, 900))
    pad = person.window.canvas.overlays.pad
    rest_on(person, "SB1/State100")
    person.click_canvas(person.place("SB1/State100"))
    assert pad.isHidden()
    pad_shows(person, "SB1/State100")
    person.click_canvas(person.place("SB1/State100"))
    person.move_to(person.place("SB1/State100") + QPoint(3, 0))
    person.move_to(person.place("SB1/State100") + QPoint(6, 0))
    pad_shows(person, "SB1/State100")


def test_the_buttons_stand_beside_the_one_selected_state(sit: Sit) -> None:
    person = sit(HFSM, (1440, 900))
    canvas, pad = person.window.canvas, person.window.canvas.overlays.pad
    person.select("SB1/State110")
    person.move_to(QPoint(canvas.width() - 30, 200))
    pad_shows(person, "SB1/State110")
    rest_on(person, "SB1/State000")
    person.move_to(QPoint(canvas.width() - 30, 200))
    pad_shows(person, "SB1/State110")
    canvas.zoom_to(1.2)
    pad_shows(person, "SB1/State110")
    person.select("SB1/State110", "SB1/State000")
    person.move_to(QPoint(canvas.width() - 30, 200))
    person.until(pad.isHidden)
    person.window.session.select(())
    person.until(pad.isHidden)


def test_the_buttons_leave_the_line_that_was_just_drawn_free(sit: Sit) -> None:
    person = sit(size=(1440, 900))
    canvas = person.window.canvas
    person.double_click_canvas(QPoint(300, 300))
    person.type("Idle")
    person.press(Key.Key_Return)
    person.drag_from_handle("SB1/Idle", QPoint(620, 300))
    person.type("Start")
    person.press(Key.Key_Tab)
    person.type("Homing")
    person.press(Key.Key_Return)
    person.select("SB1/Homing")
    pad_shows(person, "SB1/Homing")
    assert canvas.sheet is not None
    place = canvas.overlays.pad.geometry()
    for x in range(place.left(), place.right(), 4):
        for y in range(place.top(), place.bottom(), 4):
            at = canvas.mapToScene(QPoint(x, y))
            assert canvas.sheet.edge_at(at.x(), at.y()) < 0


def test_the_key_of_short_texts_covers_no_name_in_a_large_drawing(qtbot: QtBot) -> None:
    person, seen = Drawer(qtbot, hanoi(6)), 0
    canvas, key = person.canvas, person.canvas.overlays.key
    canvas.resize(740, 495)
    for zoom in (0.65, 0.8):
        for name in sorted(canvas.positions)[::12]:
            canvas.camera.go(QPointF(*canvas.positions[name]), zoom, smooth=False)
            QApplication.processEvents()
            if key.isHidden():
                continue
            seen += 1
            area = canvas.mapToScene(key.geometry()).boundingRect()
            near = person.sheet.edges_in(area.left(), area.top(), area.right(), area.bottom())
            for left, top, right, bottom in filter(None, map(person.sheet.geometry.label, near)):
                rect = QRectF(left, top, right - left, bottom - top)
                assert not area.intersects(rect), (name, zoom)
    assert seen > 10
