"""The buttons beside a state give way: to handles, to the pointer, and to whatever is dragged."""

from __future__ import annotations

import json
import random
from math import hypot

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.levels import Level
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.base.canvas import hover_pad
from tests.stories.at_canvas import LEFT, NONE, Drawer
from tests.stories.test_library_drop import Dragger

REACH = 9.0
"""A press so near to the middle of a handle takes it (pixels)."""


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The buttons come as soon as they may."""
    monkeypatch.setattr(hover_pad, "DELAY", 0)


def dense(chance: random.Random) -> Blueprint:
    """A drawing of up to 12 states that stand as near as states with all their words can."""
    count, across = chance.randint(4, 12), chance.choice((3, 4))
    names = [f"State{at:02}" for at in range(count)]
    table: dict[str, object] = {
        name: {f"Op{at}{way}": chance.choice(names) for way in "ab"[: chance.randint(0, 2)]}
        for at, name in enumerate(names)
    }
    table["_layout"] = {
        name: [at % across * chance.randint(146, 170), at // across * chance.randint(80, 130)]
        for at, name in enumerate(names)
    }
    return read_blueprint(parse_json(json.dumps({"SB1": table}), "dense.json"))


def shown(person: Drawer, qtbot: QtBot) -> QRect:
    """Where the buttons stand once they do."""
    pad = person.canvas.overlays.pad
    qtbot.waitUntil(lambda: pad.address is not None)
    return pad.geometry()


def settle() -> None:
    """Give timers without a delay their turn."""
    for _ in range(5):
        QApplication.processEvents()


def meets(area: QRect, at: QPoint, radius: float) -> bool:
    """Whether an area touches a circle."""
    x = max(area.left() - at.x(), at.x() - area.right(), 0)
    y = max(area.top() - at.y(), at.y() - area.bottom(), 0)
    return hypot(x, y) <= radius


def test_they_cover_no_handle_no_end_of_a_line_and_no_other_state(qtbot: QtBot) -> None:
    chance, found = random.Random(7), 0
    for _ in range(12):
        person = Drawer(qtbot, dense(chance))
        canvas, pad, names = person.canvas, person.canvas.overlays.pad, person.sheet.picture.names
        canvas.zoom_to(chance.choice((0.75, 1.0, 1.3)))
        if person.sheet.level is not Level.FULL:
            continue
        sides = ("right", "left", "top", "bottom")
        handles = [person.handle_of(name, side) for name in names for side in sides]
        shapes = map(person.sheet.geometry.shape, range(len(person.sheet.picture.source)))
        ends = [person.at(at) for shape in shapes for at in (shape.at(0.0), shape.tip)]
        for name in names:
            place = pad.place_for(Address("SB1", name))
            if place is None:
                continue
            found += 1
            assert not any(meets(place, at, REACH) for at in handles), name
            assert not any(meets(place, at, REACH) for at in ends), name
            for other in names:
                rect = canvas.rect_of(Address("SB1", other))
                assert rect is not None
                assert not canvas.mapFromScene(rect).boundingRect().intersects(place), name
        canvas.close()
    assert found > 40


def test_they_leave_the_handles_of_the_selected_operation_free(hfsm: Drawer) -> None:
    pad, edge = hfsm.canvas.overlays.pad, Address("SB1", "State100", "Operation100A")
    usual = pad.place_for(Address("SB1", "State100"))
    assert usual is not None
    middle = hfsm.canvas.mapToScene(usual.center())
    hfsm.session.select((edge,))
    signs = hfsm.canvas.gestures
    assert signs.grip is not None
    assert signs.line is not None
    for name in ("grip", "tail"):
        before = getattr(signs, name)
        signs.put(name, middle)
        other = pad.place_for(Address("SB1", "State100"))
        assert other is not None
        assert not meets(other, usual.center(), REACH), name
        signs.put(name, before)
    assert pad.place_for(Address("SB1", "State100")) == usual


def test_they_do_not_appear_below_the_pointer(hfsm: Drawer, qtbot: QtBot) -> None:
    pad, state = hfsm.canvas.overlays.pad, Address("SB1", "State110")
    hfsm.session.select((state,))
    usual = shown(hfsm, qtbot)
    hfsm.session.select(())
    qtbot.waitUntil(pad.isHidden)
    hfsm.hover(usual.center())
    hfsm.session.select((state,))
    assert not shown(hfsm, qtbot).contains(usual.center())
    assert pad.address == state


def test_a_drag_from_a_handle_meets_no_button_however_long_it_lasts(
    hfsm: Drawer, qtbot: QtBot
) -> None:
    pad = hfsm.canvas.overlays.pad
    hfsm.session.select((Address("SB1", "State100"),))
    hfsm.hover(hfsm.place("State100"))
    shown(hfsm, qtbot)
    handle, end = hfsm.handle_of("State100", "left"), hfsm.place("State000")
    hfsm.hover(handle)
    QTest.mousePress(hfsm.hands_on, LEFT, NONE, handle)
    assert pad.isHidden()
    for share in (0.2, 0.6, 1.0):
        QTest.mouseMove(hfsm.hands_on, handle + (end - handle) * share)
        settle()
        assert pad.isHidden()
    assert hfsm.canvas.gestures.drawn is not None
    QTest.mouseRelease(hfsm.hands_on, LEFT, NONE, end)
    settle()
    assert pad.isHidden(), "the operation is being named"
    hfsm.write("Back")
    assert hfsm.table()["State100"]["Back"] == "State000"


def test_a_state_that_is_dragged_has_none(hfsm: Drawer, qtbot: QtBot) -> None:
    pad, start = hfsm.canvas.overlays.pad, hfsm.place("State110")
    hfsm.hover(start)
    shown(hfsm, qtbot)
    QTest.mousePress(hfsm.hands_on, LEFT, NONE, start)
    for step in (10, 40, 80):
        QTest.mouseMove(hfsm.hands_on, start + QPoint(0, step))
        settle()
        assert pad.isHidden()
    QTest.mouseRelease(hfsm.hands_on, LEFT, NONE, start + QPoint(0, 80))
    place, rect = shown(hfsm, qtbot), hfsm.canvas.rect_of(Address("SB1", "State110"))
    assert rect is not None
    assert not hfsm.canvas.mapFromScene(rect).boundingRect().intersects(place)


def test_they_go_while_a_connection_is_clicked(hfsm: Drawer, qtbot: QtBot) -> None:
    pad = hfsm.canvas.overlays.pad
    hfsm.session.select((Address("SB1", "State110"),))
    shown(hfsm, qtbot)
    hfsm.canvas.hand.begin_connect()
    settle()
    assert pad.isHidden()
    hfsm.key(Qt.Key.Key_Escape)
    shown(hfsm, qtbot)


def test_they_go_while_a_line_of_the_library_is_dragged(hfsm: Drawer, qtbot: QtBot) -> None:
    pad = hfsm.canvas.overlays.pad
    hfsm.session.select((Address("SB1", "State110"),))
    shown(hfsm, qtbot)
    hand = Dragger(hfsm)
    hand.over("Inspect", hfsm.place("State111"))
    settle()
    assert pad.isHidden()
    hand.leave()
    shown(hfsm, qtbot)
