"""Tidy computes the layout anew, and makes no step if nothing would change."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE = SAMPLES / "registration.json"
SB = "REGISTRATION"


def tidy(person: Person) -> None:
    person.press(Key.Key_T, [Ctrl, Shift])


def move(person: Person, count: int) -> None:
    """Drag the first states somewhere else, one after the other."""
    for at, name in enumerate(list(person.blueprint[SB].table)[:count]):
        place = person.place(f"{SB}/{name}")
        person.drag(place, place + QPoint(60 + 30 * at, 150))


@pytest.mark.parametrize("moved", [1, 3])
def test_what_was_moved_is_laid_out_anew_again_and_again(sit: Sit, moved: int) -> None:
    person = sit(FILE)
    fresh = person.window.canvas.positions
    for done in range(2):
        move(person, moved)
        assert person.window.canvas.positions != fresh
        steps = len(person.steps())
        tidy(person)
        assert person.window.canvas.positions == fresh, f"time {done + 1}"
        assert person.steps()[steps:] == [f"Tidy {SB}"]


def test_no_step_is_made_where_every_state_stands_there_already(sit: Sit) -> None:
    person = sit(FILE)
    tidy(person)
    assert person.steps() == []
    assert not person.window.session.edited
    assert person.window.canvas.overlays.word.text == "The drawing is tidy already."
    move(person, 1)
    tidy(person)
    before = person.steps()
    tidy(person)
    assert person.steps() == before
