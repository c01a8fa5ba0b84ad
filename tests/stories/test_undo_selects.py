"""After an undo or redo that is selected which was selected there, unless the person chose anew."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt

from smsl_studio.blueprint import editing
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, address

Key = Qt.Key


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    return sit(Path(shutil.copy(SAMPLES / "hfsm.json", tmp_path / "hfsm.json")))


def test_the_next_key_acts_on_what_an_undo_brings_back(person: Person) -> None:
    person.select("SB1/State110")
    person.press(Key.Key_Delete)
    assert person.selected() == []
    person.ctrl(Key.Key_Z)
    assert person.selected() == ["SB1/State110"]
    assert person.window.canvas.marks.selection == person.window.session.selection
    person.press(Key.Key_Delete)
    assert "State110" not in person.blueprint["SB1"].table


def test_a_redo_selects_what_it_adds(person: Person) -> None:
    person.select("SB1/State100")
    person.double_click_canvas(QPoint(60, 60))
    person.type("New")
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/New"]
    person.ctrl(Key.Key_Z)
    assert person.selected() == [], "the click on the canvas left State100"
    person.ctrl(Key.Key_Y)
    assert person.selected() == ["SB1/New"]


def test_a_group_or_note_that_is_selected_stays_selected(person: Person) -> None:
    person.select("SB1/State110")
    person.ctrl(Key.Key_G)
    person.type("Both")
    person.press(Key.Key_Return)
    group = person.window.canvas.drawn.chosen
    assert group is not None
    person.select("SB1/State100")
    person.press(Key.Key_Delete)
    person.window.features.draw.notes.choose(DrawnKey("group", group.key))
    person.ctrl(Key.Key_Z)
    assert "State100" in person.blueprint["SB1"].table
    assert (person.selected(), person.window.canvas.drawn.chosen) == ([], group)
    person.ctrl(Key.Key_Z)
    assert (person.selected(), person.window.canvas.drawn.chosen) == (["SB1/State110"], None)


def test_an_undo_in_another_branch_selects_there(person: Person) -> None:
    person.select("SB1/State110")
    person.press(Key.Key_Delete)
    person.window.session.show_branch("SB2")
    person.select("SB2/State0")
    assert person.selected() == ["SB2/State0"]
    person.ctrl(Key.Key_Z)
    assert person.window.session.branch == "SB1"
    assert person.selected() == ["SB1/State110"]


def test_a_redo_shows_where_its_operation_leads(person: Person) -> None:
    """The name of the operation was in view, and the state that it leads to was not."""
    canvas, session = person.window.canvas, person.window.session
    canvas.camera.motion = False
    x, y = canvas.positions["State000"]
    session.edit("Move", lambda bp: editing.set_layout(bp, "SB1", {"State110": (x + 900, y)}))
    session.edit(
        "Connect", lambda bp: editing.add_operation(bp, "SB1", "State000", "New", "State110")
    )
    person.until(lambda: canvas.rect_of(address("SB1/State000/New")) is not None)
    label = canvas.rect_of(address("SB1/State000/New"))
    assert label is not None
    person.ctrl(Key.Key_Z)
    canvas.zoom_to(1.0)
    away = canvas.seen.right() - 40 - label.center().x()
    canvas.camera.pan(away, canvas.seen.center().y() - label.center().y())
    target = QPointF(x + 900, y)
    assert canvas.seen.contains(label.center())
    assert not canvas.seen.contains(target)
    person.ctrl(Key.Key_Y)
    assert canvas.seen.contains(target)
