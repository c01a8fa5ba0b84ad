"""A file opens with states that can be told apart, and the window says what is out of view."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QRect, Qt

from smsl_studio.generate.rules import hanoi
from smsl_studio.picture.levels import Level
from smsl_studio.smsl.files import bytes_to_save
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
SIZES = [(1280, 800), (1440, 900)]


def seen(person: Person) -> dict[str, QRect]:
    """The nodes that are whole in view."""
    canvas = person.window.canvas
    boxes: dict[str, QRect] = {}
    for name in canvas.positions:
        rect = canvas.rect_of(person.blueprint.resolve(f"SB1/{name}"))
        assert rect is not None
        box = canvas.mapFromScene(rect).boundingRect()
        if canvas.viewport().rect().contains(box):
            boxes[name] = box
    return boxes


def level(person: Person) -> Level:
    sheet = person.window.canvas.sheet
    assert sheet is not None
    return sheet.level


@pytest.mark.parametrize("size", SIZES)
def test_four_disks_open_with_names_that_are_read(sit: Sit, size: tuple[int, int]) -> None:
    person = sit(SAMPLES / "hanoi-4.json", size)
    canvas, zoom = person.window.canvas, person.window.canvas.overlays.zoom
    boxes = seen(person)
    assert level(person) >= Level.COMPACT
    assert "State_aaaa" in boxes, "the initial state is in view"
    shown = list(boxes.values())
    assert not any(a.intersects(b) for a in shown for b in shown if a is not b)
    assert len(boxes) > 30, "nothing of the room is left empty"
    assert zoom.outside.isVisible()
    assert zoom.outside.accessibleName() == f"{canvas.outside} states outside the view. Fit (F)"
    assert canvas.overlays.map.isVisible()
    person.click(zoom.outside)
    person.until(lambda: len(seen(person)) == 81 and not zoom.outside.isVisible())


def test_the_view_it_opens_at_is_kept_when_the_window_grows_and_left_by_a_zoom(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-4.json", (1280, 800))
    canvas = person.window.canvas
    few, zoom = len(seen(person)), canvas.zoom
    person.window.resize(1500, 1000)
    assert canvas.zoom == zoom
    assert len(seen(person)) > few
    person.window.resize(1900, 1800)
    assert not canvas.outside, "there is room for everything now"
    person.window.resize(1280, 800)
    assert canvas.zoom == zoom
    assert "State_aaaa" in seen(person)
    canvas.camera.motion = False
    canvas.zoom_to(1.0)
    person.window.resize(1440, 900)
    assert canvas.zoom == 1.0


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", ["hanoi.json", "hfsm.json", "registration.json"])
def test_what_can_be_read_at_once_is_all_in_view(
    sit: Sit, name: str, size: tuple[int, int]
) -> None:
    person = sit(SAMPLES / name, size)
    assert level(person) >= Level.COMPACT
    assert person.window.canvas.outside == 0
    assert not person.window.canvas.overlays.zoom.outside.isVisible()


def test_very_many_states_open_at_the_initial_one(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "six.json"
    path.write_bytes(bytes_to_save(hanoi(6).document))
    person = sit(path)
    assert level(person) >= Level.COMPACT
    assert "State_aaaaaa" in seen(person)
    assert person.window.canvas.outside > 600
    person.press(Key.Key_F)
    person.until(lambda: person.window.canvas.outside == 0)


def test_a_run_is_watched_whole(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-4.json")
    person.ctrl(Key.Key_2)
    assert person.window.features.run.pane.canvas.canvas.outside == 0
