"""The card that asks for a name opens beside its line, and over none of the states at its ends."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.shell.frame import screen_room
from tests.stories.at_canvas import Drawer
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

HANOI = SAMPLES / "hanoi-corrected.json"
NEAR, ASIDE = 90, 220
"""How far the field of the name may be from its line where there is room: below a level line, and
beside one that leads to a new state (pixels)."""


def connected(person: Person, source: str, target: str) -> ConnectCard:
    """The card that opens after an operation was drawn between two states."""
    canvas, start = person.window.canvas, person.blueprint.resolve(source)
    end = person.blueprint.resolve(target)
    canvas.connect_wanted.emit(start, end, QPointF(*canvas.positions[end.state]))
    QApplication.processEvents()
    card = person.window.editor.field
    assert isinstance(card, ConnectCard)
    return card


def line(person: Person) -> list[QPoint]:
    """Points of the line that is being named, in pixels of the view."""
    canvas = person.window.canvas
    drawn = canvas.gestures.drawn
    assert drawn is not None
    start, end = (QPointF(canvas.mapFromScene(at)) for at in (drawn.start, drawn.end))
    return [(start + (end - start) * i / 40).toPoint() for i in range(41)]


def node(person: Person, state: str) -> QRect:
    canvas = person.window.canvas
    rect = canvas.rect_of(person.blueprint.resolve(state))
    assert rect is not None
    return canvas.mapFromScene(rect).boundingRect()


@pytest.mark.parametrize(
    ("source", "target"),
    [("State111", "State000"), ("State000", "State111"), ("State110", "State000")],
)
def test_the_name_is_asked_for_beside_the_line(sit: Sit, source: str, target: str) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 800))
    card = connected(person, f"SB1/{source}", f"SB1/{target}")
    points, place = line(person), card.geometry()
    assert not any(place.contains(at) for at in points)
    field = QRect(card.operation.mapTo(person.window.canvas, QPoint()), card.operation.size())
    middle = field.center()
    assert min(abs(at.y() - middle.y()) for at in points if abs(at.x() - middle.x()) < 20) <= NEAR
    for state in person.blueprint["SB1"].table:
        assert not node(person, f"SB1/{state}").intersects(place)


@pytest.mark.parametrize("state", ["State000", "State110", "State111"])
def test_the_names_of_an_operation_to_a_new_state_are_asked_for_beside_its_line(
    sit: Sit, state: str
) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 800))
    person.window.canvas.camera.motion = False
    person.select(f"SB1/{state}")
    person.press(Qt.Key.Key_Tab)
    card = person.window.editor.field
    assert isinstance(card, ConnectCard)
    points, place = line(person), card.geometry()
    assert not any(place.contains(at) for at in points)
    field = QRect(card.operation.mapTo(person.window.canvas, QPoint()), card.operation.size())
    assert min((at - field.center()).manhattanLength() for at in points) <= ASIDE
    legend, end = person.window.canvas.overlays.legend, points[-1]
    new = QRect(end.x() - 44, end.y() - 22, 88, 44)
    assert legend.gives_way == legend.geometry().intersects(new)
    assert legend.gives_way or state != "State000", "the new state would lie below its words"
    assert not QRect(end.x() - 40, end.y() - 20, 80, 40).intersects(place), "the new state is seen"
    for one in person.blueprint["SB1"].table:
        assert not node(person, f"SB1/{one}").intersects(place)
    person.press(Qt.Key.Key_Escape)
    assert not legend.gives_way


@pytest.mark.parametrize("size", [(1280, 696), (960, 540), (720, 428)])
def test_the_place_of_a_new_state_that_is_being_named_is_free(
    sit: Sit, size: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The zoom control lay on it, or the path."""
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))
    person = sit(SAMPLES / "hanoi.json", (1440, 900))
    canvas = person.window.canvas
    canvas.camera.motion = False
    person.window.resize(*size)
    person.until(lambda: (person.window.width(), person.window.height()) == size)
    held = Qt.KeyboardModifier
    person.press(Qt.Key.Key_N, [held.ControlModifier, held.ShiftModifier])
    person.press(Qt.Key.Key_Return)
    person.press(Qt.Key.Key_Tab)
    assert isinstance(person.window.editor.field, ConnectCard)
    place = canvas.mapFromScene(canvas.pending).boundingRect()
    assert not place.isEmpty()
    tools = (canvas.overlays.zoom, canvas.overlays.key)
    assert not [one for one in tools if one.isVisible() and one.geometry().intersects(place)]
    person.press(Qt.Key.Key_Escape)
    assert canvas.pending.isEmpty()


@pytest.mark.parametrize(
    ("source", "target"),
    [("State_aaa", "State_bbb"), ("State_ccc", "State_abc"), ("State_bba", "State_cab"),
     ("State_bca", "State_aac"), ("State_acb", "State_cca")],
)  # fmt: skip
def test_in_a_crowd_the_card_covers_neither_end_nor_line(
    sit: Sit, source: str, target: str
) -> None:
    person = sit(HANOI, (1280, 800))
    card = connected(person, f"SB1/{source}", f"SB1/{target}")
    for state in (source, target):
        assert not node(person, f"SB1/{state}").intersects(card.geometry())
    assert sum(card.geometry().contains(at) for at in line(person)) == 0


def test_the_card_of_a_bundle_covers_neither_of_its_states(hanoi: Drawer) -> None:
    canvas = hanoi.canvas
    canvas.resize(740, 480)
    QApplication.processEvents()
    canvas.collapse.turn(True)
    canvas.fit(smooth=False)
    picture, card = hanoi.sheet.picture, canvas.overlays.bundle
    opened = [first for first in picture.bundles.members if first != picture.bundles.lane]
    assert len(opened) > 30
    for first in opened:
        card.open(first)
        assert canvas.rect().contains(card.geometry())
        for state in (picture.source[first], picture.target[first]):
            rect = canvas.rect_of(hanoi.sheet.address_of_state(int(state)))
            assert rect is not None
            assert not canvas.mapFromScene(rect).boundingRect().intersects(card.geometry())
        card.go()
