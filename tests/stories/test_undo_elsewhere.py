"""Undo and redo show the SB that they change, and say what was undone there."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import Qt

from smsl_studio.blueprint import editing
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key


def test_an_edit_beside_the_shown_branch_is_shown_when_it_is_undone(sit: Sit) -> None:
    """In the source or the outline a person edits SB2 while SB1 is drawn."""
    person = sit(SAMPLES / "hfsm.json")
    session = person.window.session
    assert session.branch == "SB1"
    text = session.blueprint.document.text
    values = json.loads(text)
    values["SB2"] = {"HEADER": {}}
    session.write("Type in SB2", json.dumps(values))
    assert not session.blueprint["SB2"].table
    assert session.branch == "SB1"
    person.ctrl(Key.Key_Z)
    assert session.branch == "SB2"
    assert person.window.toast.words == "Undone: Type in SB2, in SB2"
    session.show_branch("SB1")
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_Y)
    assert session.branch == "SB2"
    assert person.window.toast.words == "Done again: Type in SB2, in SB2"


def test_places_that_are_written_beside_do_not_keep_the_other_branch_away(
    sit: Sit, tmp_path: Path
) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session = person.window.session
    session.show_branch("SB2")
    places = {"State000": (10.0, 10.0)}
    session.edit(
        "Add New",
        lambda bp: editing.set_layout(editing.add_state(bp, "SB2", "New"), "SB1", places),
    )
    session.show_branch("SB1")
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_Z)
    assert session.branch == "SB2"
    assert person.window.toast.words == "Undone: Add New, in SB2"


def test_what_was_undone_elsewhere_is_not_said_of_the_next_undo(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session = person.window.session
    session.show_branch("SB2")
    session.edit("Add One", lambda bp: editing.add_state(bp, "SB2", "One"))
    session.edit("Add Two", lambda bp: editing.add_state(bp, "SB2", "Two"))
    session.show_branch("SB1")
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_Z)
    assert person.window.toast.words == "Undone: Add Two, in SB2"
    person.ctrl(Key.Key_Z)
    assert "One" not in session.blueprint["SB2"].table
    assert person.window.toast.words == ""


def test_an_undo_in_the_shown_branch_says_nothing(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.select("SB1/State110")
    person.press(Key.Key_Delete)
    person.ctrl(Key.Key_Z)
    assert person.window.session.branch == "SB1"
    assert not person.window.toast.isVisible()


def test_what_an_undo_elsewhere_was_told_goes_with_the_next_look_at_the_drawing(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.select("SB1/State000")
    person.press(Qt.Key.Key_Delete)
    person.ctrl(Qt.Key.Key_2)
    person.ctrl(Qt.Key.Key_Z)
    assert "only while the drawing is shown" in person.window.toast.words
    person.ctrl(Qt.Key.Key_1)
    assert person.window.toast.words == ""
