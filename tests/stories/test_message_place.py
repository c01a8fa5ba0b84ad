"""A passing message covers nothing that a person works on, and goes by itself."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, Qt

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.features.draw.canvas.message_seat import MessageSeat
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
WORDS = "State_ccc stays the activating state of SB1, and ACTIVATING says so now."


def covered(person: Person) -> list[str]:
    """The states in view that the message covers."""
    canvas, toast = person.window.canvas, person.window.toast
    if not toast.isVisible():
        return []
    place = QRect(toast.mapToGlobal(QPoint()), toast.size())
    return [name for name in canvas.positions if place.intersects(node(canvas, person, name))]


def node(canvas: Canvas, person: Person, name: str) -> QRect:
    rect = canvas.rect_of(person.blueprint.resolve(f"SB1/{name}"))
    assert rect is not None
    return canvas.screen_rect(rect)


@pytest.mark.parametrize("size", [(1440, 900), (960, 540)])
@pytest.mark.parametrize("zoom", [0.4, 0.7, 1.0, 2.0])
def test_a_message_covers_no_state_at_any_zoom_and_size(
    sit: Sit, size: tuple[int, int], zoom: float
) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json", size)
    canvas, toast = person.window.canvas, person.window.toast
    canvas.camera.motion = False
    canvas.zoom_to(zoom)
    middle = canvas.positions["State_bbb"]
    canvas.camera.go(QPointF(*middle), zoom, smooth=False)
    toast.say(WORDS)
    assert toast.words == WORDS
    assert covered(person) == []
    told = toast.isVisible() or person.window.status_line.currentMessage() == WORDS
    assert told


def test_it_moves_away_from_what_is_scrolled_below_it(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json")
    canvas, toast = person.window.canvas, person.window.toast
    canvas.camera.motion = False
    toast.say(WORDS)
    assert covered(person) == []
    for step in range(12):
        canvas.camera.pan(37.0, -29.0 if step % 2 else 45.0)
        assert covered(person) == []
        assert toast.words == WORDS


def test_where_there_is_no_place_it_is_a_line_of_the_status_line(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json", (960, 540))
    canvas, toast = person.window.canvas, person.window.toast
    canvas.camera.motion = False
    toast.seat = lambda wanted, now: None
    toast.say(WORDS)
    assert not toast.isVisible()
    assert toast.words == person.window.status_line.currentMessage() == WORDS
    toast.hide()
    assert (toast.words, person.window.status_line.currentMessage()) == ("", "")
    toast.warn("It failed.")
    assert toast.isVisible(), "a failure is not put aside"


def test_it_makes_room_for_a_field_that_opens_below_it(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json", (960, 540))
    toast, canvas = person.window.toast, person.window.canvas
    canvas.camera.motion = False
    person.select("SB1/State_aaa")
    person.press(Key.Key_F2)
    field = person.window.editor.field
    assert field is not None
    place = field.geometry()
    person.press(Key.Key_Escape)
    toast.seat = lambda wanted, now: canvas.mapTo(toast.over, place.topLeft())
    toast.say("Saved hanoi.json.")
    assert toast.isVisible()
    toast.seat = MessageSeat(canvas, toast.over)
    person.press(Key.Key_F2)
    field = person.window.editor.field
    assert field is not None
    shown = QRect(toast.mapToGlobal(QPoint()), toast.size())
    assert not toast.isVisible() or not shown.intersects(
        QRect(field.mapToGlobal(QPoint()), field.size())
    )


def test_it_makes_room_for_a_sentence_at_the_pointer(sit: Sit) -> None:
    """What Tidy said lay half below the message that the file is saved."""
    person = sit(SAMPLES / "hanoi-corrected.json")
    canvas, toast = person.window.canvas, person.window.toast
    toast.say("Saved hanoi.json.")
    assert toast.isVisible()
    at = canvas.mapFromGlobal(toast.mapToGlobal(QPoint(10, 0)))
    canvas.overlays.say("The drawing is tidy already.", at - QPoint(16, 18))
    word = QRect(canvas.overlays.word.mapToGlobal(QPoint()), canvas.overlays.word.size())
    assert toast.words == "Saved hanoi.json."
    assert toast.isHidden() or not word.intersects(QRect(toast.mapToGlobal(QPoint()), toast.size()))


def test_a_message_is_not_below_the_drawer(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1000, 640))
    drawer, toast = person.window.docks.drawer, person.window.toast
    person.ctrl(Key.Key_B)
    person.until(drawer.isVisible)
    person.window.outline.delete_branch()
    assert toast.words.startswith("Deleted State Branch")
    assert drawer.isVisible()
    place = QRect(toast.mapToGlobal(QPoint()), toast.size())
    assert not toast.isVisible() or not place.intersects(
        QRect(drawer.mapToGlobal(QPoint()), drawer.size())
    )
    told = toast.isVisible() or person.window.status_line.currentMessage() == toast.words
    assert told


@pytest.mark.parametrize("size", [(640, 332), (720, 420), (960, 540)])
def test_where_there_is_no_place_the_line_has_the_button(sit: Sit, size: tuple[int, int]) -> None:
    person = sit(SAMPLES / "hfsm.json", size)
    line, toast = person.window.status_line, person.window.toast
    toast.seat = lambda wanted, now: None
    before = person.blueprint
    person.window.outline.delete_branch()
    assert not toast.isVisible()
    assert toast.words == line.currentMessage()
    assert line.shown_message.startswith("Deleted State Branch")
    assert line.rect().contains(line.button.geometry())
    assert line.button.text() == "Undo"
    person.click(line.button)
    assert person.blueprint == before
    assert not line.button.isVisible()
    # The branch comes back into view, so what was undone is said, without a button.
    assert toast.words == line.currentMessage() == "Undone: Delete State Branch SB1, in SB1"


def test_another_message_or_its_end_takes_the_button_away(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (960, 540))
    line, toast = person.window.status_line, person.window.toast
    toast.seat = lambda wanted, now: None
    person.window.outline.delete_branch()
    assert line.button.isVisible()
    toast.say(WORDS)
    assert not line.button.isVisible()
    assert line.currentMessage() == WORDS
    person.ctrl(Key.Key_Z)
    person.window.outline.delete_branch()
    assert line.button.isVisible()
    line.showMessage("A tip of a menu")
    assert not line.button.isVisible()
