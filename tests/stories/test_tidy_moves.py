"""Tidy moves states in a short movement, and lays out a large drawing beside the window."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication

from smsl_studio.graph.tidied import tidied
from smsl_studio.stop import heed
from smsl_studio.studio.features.draw.canvas import tidy_work
from smsl_studio.studio.features.draw.canvas.tidy_work import LARGE
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE, SB = SAMPLES / "registration.json", "REGISTRATION"


def tidy(person: Person) -> None:
    person.press(Key.Key_T, [Ctrl, Shift])


def move(person: Person, state: str) -> None:
    start = person.place(state)
    person.drag(start, start + QPoint(96, 120))


def item_places(person: Person) -> np.ndarray:
    """Where the nodes are painted, (n, 2)."""
    used = person.window.canvas.pool.used
    return np.array([(used[at].pos().x(), used[at].pos().y()) for at in sorted(used)])


def test_states_glide_to_their_places_and_are_there_at_once_for_everything_else(sit: Sit) -> None:
    person = sit(FILE)
    canvas = person.window.canvas
    sheet = canvas.sheet
    assert sheet is not None
    move(person, f"{SB}/State_1010")
    before = sheet.at.copy()
    tidy(person)
    assert canvas.glide.running
    after = sheet.at.copy()
    assert not np.array_equal(after, before)
    shown = canvas.glide.places()
    low, high = np.minimum(before, after), np.maximum(before, after)
    assert ((shown >= low - 0.1) & (shown <= high + 0.1)).all(), "they are on their way"
    person.until(lambda: not canvas.glide.running)
    assert np.array_equal(item_places(person), after)
    assert canvas.lit_layer.isVisible()


def test_a_press_ends_the_movement_and_nothing_moves_without_motion(sit: Sit) -> None:
    person = sit(FILE)
    canvas = person.window.canvas
    move(person, f"{SB}/State_1010")
    tidy(person)
    assert canvas.glide.running
    person.click_canvas(QPoint(8, 300))
    assert not canvas.glide.running
    canvas.camera.motion = False
    move(person, f"{SB}/State_1010")
    tidy(person)
    assert not canvas.glide.running
    assert person.steps().count(f"Tidy {SB}") == 2


@pytest.fixture
def gate(monkeypatch: pytest.MonkeyPatch) -> Iterator[threading.Event]:
    """Holds the layout in the worker thread until it is set; a layout that is held can be called
    off."""
    opened = threading.Event()

    def held(*given: object) -> object:
        while not opened.wait(0.002):
            heed()
        return tidied(*given)  # type: ignore[arg-type]

    monkeypatch.setattr(tidy_work, "tidied", held)
    yield opened
    opened.set()


def large(folder: Path) -> Path:
    """A file with more states than are tidied at once, and one far from the others."""
    count = LARGE + 40
    table: dict[str, object] = {
        f"State_{at:03d}": {"Op_Next": f"State_{at + 1:03d}"} for at in range(count - 1)
    }
    table[f"State_{count - 1:03d}"] = {}
    layout = {name: [260.0 * (at % 24), 170.0 * (at // 24)] for at, name in enumerate(table)}
    path = folder / "large.json"
    path.write_text(json.dumps({"SB": {**table, "_layout": layout}}), encoding="utf-8")
    return path


def test_a_large_drawing_is_tidied_beside_the_window(
    sit: Sit, tmp_path: Path, gate: threading.Event
) -> None:
    person = sit(large(tmp_path))
    beside, places = person.window.features.draw.drawing.beside, person.window.canvas.positions
    tidy(person)
    card = beside.card
    assert card is not None
    assert card.words.text() == f"Tidying {LARGE + 40} states"
    assert person.window.canvas.positions == places
    gate.set()
    person.until(lambda: person.steps() == ["Tidy SB"])
    assert beside.card is None
    assert person.window.canvas.positions != places
    person.ctrl(Key.Key_Z)
    assert person.window.canvas.positions == places


@pytest.mark.parametrize("how", ["button", "escape"])
def test_cancel_calls_it_off_and_changes_nothing(
    sit: Sit, tmp_path: Path, gate: threading.Event, how: str
) -> None:
    person = sit(large(tmp_path))
    beside, places = person.window.features.draw.drawing.beside, person.window.canvas.positions
    tidy(person)
    card = beside.card
    assert card is not None
    if how == "button":
        person.click(card.cancel)
    else:
        person.press(Key.Key_Escape)
    assert beside.card is None
    gate.set()
    beside.wait()
    for _ in range(3):
        QApplication.processEvents()
    assert person.steps() == []
    assert person.window.canvas.positions == places
    tidy(person)
    person.until(lambda: person.steps() == ["Tidy SB"])
    assert person.window.canvas.positions != places


def test_a_drawing_that_changed_meanwhile_is_left_alone(
    sit: Sit, tmp_path: Path, gate: threading.Event
) -> None:
    person = sit(large(tmp_path))
    canvas, session = person.window.canvas, person.window.session
    tidy(person)
    canvas.setFocus()
    person.select("SB/State_000")
    person.press(Key.Key_Right)
    person.window.features.draw.settle()
    assert len(person.steps()) == 1
    gate.set()
    person.until(lambda: "changed meanwhile" in canvas.overlays.word.text)
    assert person.steps() == session.history.count() * ["Move State_000"]
