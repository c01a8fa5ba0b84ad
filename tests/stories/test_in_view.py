"""Found, added and pasted elements are in view, and the view moves no more than needed."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, Qt
from PySide6.QtWidgets import QWidget

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
HANOI = SAMPLES / "hanoi.json"


def is_in_view(person: Person, address: str) -> bool:
    """Whether a state is whole in view, and not below the breadcrumb."""
    canvas = person.window.canvas
    rect = canvas.rect_of(person.blueprint.resolve(address))
    assert rect is not None
    shown = canvas.mapFromScene(rect).boundingRect()
    return canvas.viewport().rect().adjusted(0, 40, 0, 0).contains(shown)


def look_close(person: Person, at: str) -> None:
    """Zoom in, so that most of the drawing is out of view; look at a state."""
    canvas = person.window.canvas
    canvas.camera.motion = False
    canvas.zoom_to(1.5)
    rect = canvas.rect_of(person.blueprint.resolve(at))
    assert rect is not None
    canvas.camera.go(rect.center(), 1.5, smooth=False)


@pytest.mark.parametrize(("selected", "key"), [("", True), ("SB1/State_bbb", False)])
def test_an_added_state_is_in_view(sit: Sit, selected: str, key: bool) -> None:
    person = sit(HANOI)
    look_close(person, "SB1/State_aaa")
    if selected:
        person.window.session.select([person.blueprint.resolve(selected)])
    centre = person.window.canvas.camera.centre
    if key:
        person.press(Key.Key_N, [Ctrl, Shift])
    else:
        tools = person.window.mode_bar.findChildren(QWidget)
        person.click(next(t for t in tools if t.accessibleName() == "Add state" and t.isVisible()))
    person.press(Key.Key_Return)
    (added,) = person.selected()
    assert is_in_view(person, added)
    assert person.window.canvas.camera.centre == centre, "there was room, nothing had to scroll"
    others = [rect for name in person.blueprint["SB1"].table if (rect := box(person, name))]
    assert not any(a.intersects(b) for a in others for b in others if a is not b)


def box(person: Person, state: str) -> QRect:
    rect = person.window.canvas.rect_of(person.blueprint.resolve(f"SB1/{state}"))
    assert rect is not None
    return person.window.canvas.mapFromScene(rect).boundingRect()


def test_where_the_view_is_full_it_scrolls_to_the_new_state(sit: Sit) -> None:
    person = sit(HANOI, (1000, 600))
    look_close(person, "SB1/State_cab")
    person.window.canvas.zoom_to(4.0)
    person.window.canvas.reveal(person.blueprint.resolve("SB1/State_cab"))
    person.press(Key.Key_N, [Ctrl, Shift])
    person.press(Key.Key_Return)
    assert is_in_view(person, person.selected()[0])


def test_an_operation_that_is_added_by_key_is_named_in_view(sit: Sit) -> None:
    person = sit(HANOI)
    look_close(person, "SB1/State_aaa")
    person.select("SB1/State_aaa")
    look_close(person, "SB1/State_bbb")
    person.press(Key.Key_Slash)
    person.press(Key.Key_Return)
    (operation,) = person.selected()
    target = person.blueprint["SB1"].table["State_aaa"][operation.split("/")[-1]]
    assert is_in_view(person, "SB1/State_aaa")
    assert is_in_view(person, f"SB1/{target}")


def test_f2_names_a_state_where_it_then_is(sit: Sit) -> None:
    person = sit(HANOI)
    person.select("SB1/State_aaa")
    person.window.canvas.zoom_to(1.5)
    person.window.canvas.camera.finish()
    person.window.canvas.reveal(person.blueprint.resolve("SB1/State_bbb"))
    person.window.canvas.camera.finish()
    person.press(Key.Key_F2)
    field = person.window.editor.field
    assert field is not None
    person.window.canvas.camera.finish()
    assert field.geometry().adjusted(-8, -20, 8, 20).contains(person.place("SB1/State_aaa"))


def at_the_rim(person: Person, state: str) -> None:
    """Scroll so that a state stands whole, but close to the right border."""
    canvas = person.window.canvas
    canvas.camera.motion = False
    canvas.zoom_to(1.5)
    canvas.reveal(person.blueprint.resolve(state))
    rect = canvas.rect_of(person.blueprint.resolve(state))
    assert rect is not None
    wide = canvas.viewport().width() / canvas.zoom
    canvas.camera.go(QPointF(rect.right() + 12 - wide / 2, rect.center().y()), 1.5, smooth=False)


def test_f2_on_what_is_in_view_moves_nothing(sit: Sit) -> None:
    person = sit(HANOI)
    at_the_rim(person, "SB1/State_bbb")
    assert is_in_view(person, "SB1/State_bbb")
    person.window.session.select([person.blueprint.resolve("SB1/State_bbb")])
    centre = person.window.canvas.camera.centre
    person.press(Key.Key_F2)
    assert person.window.editor.field is not None
    assert person.window.canvas.camera.centre == centre
    person.press(Key.Key_Escape)
    assert person.window.canvas.camera.centre == centre


def test_tab_scrolls_only_as_far_as_the_new_state_needs(sit: Sit) -> None:
    person = sit(HANOI)
    at_the_rim(person, "SB1/State_bbb")
    person.window.session.select([person.blueprint.resolve("SB1/State_bbb")])
    canvas = person.window.canvas
    before = canvas.camera.centre
    person.press(Key.Key_Tab)
    person.press(Key.Key_Return)
    (added,) = person.selected()
    target = person.blueprint["SB1"].table["State_bbb"][added.split("/")[-1]]
    assert is_in_view(person, f"SB1/{target}")
    assert is_in_view(person, "SB1/State_bbb")
    moved = canvas.camera.centre - before
    view = canvas.clear_view
    assert abs(moved.x()) < view.width() / 2
    assert abs(moved.y()) < view.height() / 2


def test_f3_and_a_click_on_a_finding_scroll_to_it(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    look_close(person, "SB1/State_aaa")
    person.press(Key.Key_F3)
    (operation,) = person.selected()
    assert person.window.canvas.viewport().rect().contains(person.place(operation))
    look_close(person, "SB1/State_aaa")
    findings = person.window.findings.list
    row = findings.visualRect(findings.model().index(1, 0))
    person.click(findings.viewport(), QPoint(row.left() + 60, row.center().y()))
    assert person.selected() != [operation]
    assert person.window.canvas.viewport().rect().contains(person.place(person.selected()[0]))


def test_an_added_state_stands_on_no_line(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json", (1280, 720))
    sheet = person.window.canvas.sheet
    assert sheet is not None
    person.press(Key.Key_N, [Ctrl, Shift])
    person.press(Key.Key_Return)
    x, y = person.window.canvas.positions[person.selected()[0].split("/")[1]]
    assert not sheet.is_drawn_on(x - 60, y - 35, x + 60, y + 35), "as it was drawn before"


def test_an_added_state_is_not_below_a_map_that_comes_with_it(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.canvas.camera.motion = False
    person.press(Key.Key_F)
    person.press(Key.Key_N, [Ctrl, Shift])
    person.press(Key.Key_Return)
    assert under(person) == []


def under(person: Person) -> list[str]:
    """The selected states that the zoom or the map covers, or that are not in view."""
    overlays, found = person.window.canvas.overlays, []
    shown = [part.geometry() for part in (overlays.zoom, overlays.map) if not part.isHidden()]
    for address in person.selected():
        place = box(person, address.split("/")[1])
        if any(place.intersects(one) for one in shown) or not is_in_view(person, address):
            found.append(address)
    return found
