"""Tidy keeps the zoom, and undo and redo keep the place of the person, or show what changed."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPointF, QRectF, Qt

from smsl_studio.blueprint.address import Address
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE = SAMPLES / "registration.json"
SB = "REGISTRATION"


def seen(person: Person) -> tuple[float, float, float]:
    """Zoom and middle of the view, once it stands still."""
    camera = person.window.canvas.camera
    stand = camera.stand
    return round(stand.zoom, 6), round(stand.centre.x()), round(stand.centre.y())


def still(person: Person) -> None:
    person.window.canvas.camera.motion = False


def tidy(person: Person) -> None:
    person.press(Key.Key_T, [Ctrl, Shift])


def put(person: Person, **places: tuple[float, float]) -> None:
    session = person.window.session
    session.edit("Move", lambda bp: session.places.moved(bp, SB, places))


def spread(person: Person, factor: float) -> None:
    put(
        person,
        **{n: (x * factor, y * factor) for n, (x, y) in person.window.canvas.positions.items()},
    )


def test_tidy_of_a_near_view_keeps_the_zoom_and_the_state_in_the_middle(sit: Sit) -> None:
    person = sit(FILE)
    still(person)
    spread(person, 1.4)
    canvas, name = person.window.canvas, list(person.blueprint[SB].table)[3]
    canvas.zoom_to(1.3)
    canvas.camera.go(QPointF(*canvas.positions[name]), 1.3, smooth=False)
    before, place = seen(person), person.place(f"{SB}/{name}")
    tidy(person)
    assert canvas.zoom == 1.3
    assert (person.place(f"{SB}/{name}") - place).manhattanLength() <= 3
    after = seen(person)
    canvas.fit()
    person.ctrl(Key.Key_Z)
    assert seen(person) == before
    person.press(Key.Key_Z, [Ctrl, Shift])
    assert seen(person) == after


def test_tidy_of_a_drawing_in_view_keeps_the_zoom_if_it_still_fits(sit: Sit) -> None:
    person = sit(FILE)
    still(person)
    canvas = person.window.canvas
    spread(person, 1.6)
    canvas.fit()
    before = seen(person)
    tidy(person)
    assert seen(person)[0] == before[0]
    assert canvas.shows_all
    canvas.zoom_to(2.0)
    person.ctrl(Key.Key_Z)
    assert seen(person) == before


def test_tidy_shows_all_if_the_drawing_no_longer_fits(sit: Sit) -> None:
    person = sit(FILE)
    still(person)
    canvas = person.window.canvas
    spread(person, 0.35)
    canvas.fit()
    before = seen(person)
    tidy(person)
    assert canvas.zoom < before[0]
    assert canvas.outside == 0
    person.ctrl(Key.Key_Z)
    assert seen(person) == before


def test_a_tidy_drawing_is_not_moved_in_the_view(sit: Sit) -> None:
    person = sit(FILE)
    still(person)
    tidy(person)
    person.window.canvas.zoom_to(1.7)
    before = seen(person)
    tidy(person)
    assert seen(person) == before


@pytest.mark.parametrize("near", [True, False])
def test_undo_scrolls_only_to_a_change_that_is_out_of_view(sit: Sit, near: bool) -> None:
    person = sit(FILE)
    still(person)
    canvas, names = person.window.canvas, list(person.blueprint[SB].table)
    first = names[0]
    x, y = canvas.positions[first]
    put(person, **{first: (x + 40.0, y)})
    aim = QPointF(x, y) if near else QPointF(x + 9_000.0, y)
    canvas.camera.keep("")
    canvas.camera.go(aim, 1.0, smooth=False)
    before = seen(person)
    person.ctrl(Key.Key_Z)
    rect = canvas.rect_of(Address(SB, first))
    assert rect is not None
    assert QRectF(canvas.seen).contains(rect)
    assert (seen(person) == before) is near
    assert canvas.zoom == 1.0, "the zoom stays"


def test_undo_leads_back_to_the_branch_of_its_step(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session = person.window.session
    first, other = list(person.blueprint.branches)[:2]
    session.show_branch(other)
    person.window.drawing.add_state()
    person.press(Key.Key_Return)
    session.show_branch(first)
    person.ctrl(Key.Key_Z)
    assert session.branch == other
    session.show_branch(first)
    person.press(Key.Key_Z, [Ctrl, Shift])
    assert session.branch == other
