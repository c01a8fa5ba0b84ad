"""A note that is being written is work: a save has it, a question comes before it could go."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QApplication, QMessageBox

from smsl_studio.blueprint import editing
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.draw.drawn.note_field import NoteField
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
WORDS = "Ask the clinic"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return Path(shutil.copy(SAMPLES / "hfsm.json", tmp_path / "hfsm.json"))


def write_note(person: Person, words: str = WORDS) -> None:
    """Open the card of a free note and type, without ending it."""
    person.press(Key.Key_M, [Ctrl, Shift])
    field = person.window.features.draw.notes.field
    assert isinstance(field, NoteField)
    person.until(field.field.hasFocus)
    person.type(words)


def answer(person: Person, words: str, told: list[str]) -> None:
    """Press a button of the question that comes up next, as soon as it is there."""

    def press() -> None:
        box = QApplication.activeModalWidget()
        if not isinstance(box, QMessageBox):
            timer.start()
            return
        told.append(box.text())
        next(b for b in box.buttons() if b.text().replace("&", "") == words).click()

    timer = QTimer(person.window, singleShot=True, interval=10)
    timer.timeout.connect(press)
    timer.start()


def written(text: str) -> list[str]:
    """The notes in a file's text."""
    return [one["text"] for one in json.loads(text)["SB1"].get("_notes", {}).values()]


def drawn(person: Person) -> list[str]:
    return [note.text for note in person.blueprint["SB1"].drawn.notes.values()]


def test_a_save_has_the_note_that_is_being_written(sit: Sit, path: Path) -> None:
    person = sit(path)
    write_note(person)
    person.ctrl(Key.Key_S)
    assert written(path.read_text()) == [WORDS]
    assert person.window.features.draw.notes.field is None
    assert person.window.canvas.hasFocus()
    person.press(Key.Key_F2)
    person.type("Ask the clinic twice")
    person.ctrl(Key.Key_S)
    assert written(path.read_text()) == ["Ask the clinic twice"]
    assert person.steps() == ["Add a note", "Edit a note"]


def ask_to_quit(person: Person) -> None:
    person.ctrl(Key.Key_Q)


def ask_to_close(person: Person) -> None:
    person.window.close()


def ask_for_new(person: Person) -> None:
    person.ctrl(Key.Key_N)


def ask_to_open(person: Person) -> None:
    person.ctrl(Key.Key_O)


@pytest.mark.parametrize("leave", [ask_to_quit, ask_to_close, ask_for_new, ask_to_open])
def test_what_leaves_the_drawing_asks_about_the_note(
    sit: Sit, path: Path, monkeypatch: pytest.MonkeyPatch, leave: Callable[[Person], None]
) -> None:
    monkeypatch.setattr(Dialogs, "file_to_open", lambda *_: SAMPLES / "hanoi.json")
    person = sit(path)
    write_note(person)
    told: list[str] = []
    answer(person, "Cancel", told)
    leave(person)
    assert len(told) == 1
    assert told[0].startswith("hfsm.json has unsaved changes.")
    assert person.window.isVisible()
    assert person.window.files.path == path
    assert drawn(person) == [WORDS]
    person.come_back()
    answer(person, "Save", told)
    leave(person)
    assert written(path.read_text()) == [WORDS]
    assert leave in (ask_to_quit, ask_to_close) or "_notes" not in person.blueprint.document.text


def test_a_window_behind_another_one_has_its_note_too(sit: Sit, path: Path) -> None:
    first = sit(path)
    write_note(first)
    second = sit()
    told: list[str] = []
    answer(first, "Cancel", told)
    second.ctrl(Key.Key_Q)
    assert len(told) == 1
    assert drawn(first) == [WORDS]


def test_another_state_branch_and_another_program_take_no_note_along(sit: Sit, path: Path) -> None:
    person = sit(path)
    write_note(person)
    person.window.session.show_branch("SB2")
    assert drawn(person) == [WORDS]
    assert not person.blueprint["SB2"].drawn.notes
    assert person.window.features.draw.notes.field is None
    person.window.session.show_branch("SB1")
    person.window.canvas.setFocus()
    write_note(person, "Twice")
    person.window.session.edit("Add Z", lambda bp: editing.add_state(bp, "SB1", "State222"))
    field = person.window.features.draw.notes.field
    assert isinstance(field, NoteField)
    assert field.field.toPlainText() == "Twice"
    person.press(Key.Key_Escape)
    assert drawn(person) == [WORDS, "Twice"]


def test_a_new_operation_that_is_being_named_is_in_the_save(sit: Sit, path: Path) -> None:
    person = sit(path)
    person.select("SB1/State000")
    person.press(Key.Key_Tab)
    person.type("Op_new")
    person.ctrl(Key.Key_S)
    assert "Op_new" in path.read_text()


def test_the_card_says_what_escape_does(sit: Sit, path: Path) -> None:
    person = sit(path)
    write_note(person)
    field = person.window.features.draw.notes.field
    assert field is not None
    said = [one.text() for one in field.findChildren(type(field.error)) if one.isVisible()]
    assert any("Esc keeps the text" in one for one in said)
