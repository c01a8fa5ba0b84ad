"""Saving in another form, or into another folder, keeps the history: undo and redo go on."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.document.files.dialogs import Dialogs
from tests.stories.conftest import Sit
from tests.stories.person import Person
from tests.stories.test_files import copy_of, edit

Key = Qt.Key


def save_as(person: Person, target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    person.press(
        Key.Key_S, [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]
    )
    assert person.window.files.path == target


@pytest.mark.parametrize("suffix", [".smsl", ".yaml"])
def test_undo_and_redo_go_on_after_a_save_in_another_form(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    opened = person.blueprint
    edit(person)
    drawn = person.blueprint
    person.select("SB1/State_zzz")
    target = tmp_path / f"other{suffix}"
    save_as(person, target, monkeypatch)
    saved = target.read_text()
    assert person.steps() == ["Add Z"]
    assert person.selected() == ["SB1/State_zzz"]
    assert person.window.menu_row.title == target.name
    person.ctrl(Key.Key_Z)
    assert person.window.menu_row.title == f"{target.name} edited"
    assert person.blueprint == opened
    assert person.blueprint.document.form == suffix[1:]
    person.ctrl(Key.Key_S)
    assert read_blueprint(read_document(target)) == opened
    person.ctrl(Key.Key_Y)
    assert person.blueprint == drawn
    assert person.window.menu_row.title == f"{target.name} edited"
    person.ctrl(Key.Key_S)
    assert target.read_text() == saved
    assert person.window.menu_row.title == target.name


def test_steps_after_the_save_are_undone_to_the_same_bytes(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    edit(person)
    target = tmp_path / "other.smsl"
    save_as(person, target, monkeypatch)
    person.select("SB1/State_zzz")
    person.press(Key.Key_Delete)
    assert "State_zzz" not in person.blueprint["SB1"].table
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == target.read_text()
    assert not person.window.session.edited
    back = tmp_path / "back.json"
    save_as(person, back, monkeypatch)
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == (tmp_path / "hfsm.json").read_text()
    person.ctrl(Key.Key_Y)
    person.ctrl(Key.Key_Y)
    assert "State_zzz" not in person.blueprint["SB1"].table
    assert person.blueprint.document.form == "json"


def test_a_step_with_a_key_written_twice_keeps_the_value_that_counts(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "twice.json"
    twice = '{"SB1": {"State_0": {"go": "State_0", "go": "State_1"}, "State_1": {}}}'
    path.write_text(twice)
    person = sit(path)
    meant = person.blueprint.document.values
    person.window.session.write("Type", twice.replace('"go": "State_0", ', ""))
    person.window.session.write("Type", twice.replace('"go": "State_0", ', "").replace("go", "up"))
    save_as(person, tmp_path / "twice.smsl", monkeypatch)
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.form == "smsl"
    assert person.blueprint.document.values == meant
    assert person.window.session.broken is None


def test_a_step_that_the_form_cannot_express_is_shown_as_it_was_typed(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    text = person.blueprint.document.text
    odd = text.replace('"INITIAL": "State000"', '"INITIAL": 5', 1)
    assert odd != text
    person.window.session.write("Type", odd)
    person.window.session.write("Type", text)
    person.window.session.write("Type", text + "\n")
    save_as(person, tmp_path / "other.smsl", monkeypatch)
    person.ctrl(Key.Key_Z)
    assert person.window.session.broken is None
    person.ctrl(Key.Key_Z)
    assert person.window.session.texts[person.blueprint.file] == odd
    assert person.window.session.broken is not None
    person.ctrl(Key.Key_Z)
    assert person.window.session.broken is None


def test_a_text_that_was_broken_comes_back_as_it_was_typed(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    text = person.blueprint.document.text
    person.window.session.write("Type", text[:-4])
    person.window.session.write("Type", text)
    save_as(person, tmp_path / "other.yaml", monkeypatch)
    person.ctrl(Key.Key_Z)
    assert person.window.session.texts[person.blueprint.file] == text[:-4]
    person.ctrl(Key.Key_Y)
    assert person.window.session.broken is None
    assert person.window.menu_row.title == "other.yaml"


def test_steps_follow_into_another_folder(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "smsl.toml").touch()
    (tmp_path / "inner").mkdir()
    copy_of("hfsm.json", tmp_path)
    path = tmp_path / "main.json"
    path.write_text('{"_imports": ["hfsm.json"], "Main": {"State_0": {}, "State_1": {}}}')
    person = sit(path)
    branches = list(person.blueprint.branches)
    assert len(branches) > 1
    person.select("Main/State_1")
    person.press(Key.Key_Delete)
    target = tmp_path / "inner" / "main.json"
    save_as(person, target, monkeypatch)
    assert person.steps() == ["Delete State_1"]
    person.ctrl(Key.Key_Z)
    assert list(person.blueprint.branches) == branches
    assert person.blueprint.document.values["_imports"] == ["../hfsm.json"]
    person.ctrl(Key.Key_S)
    assert list(read_blueprint(read_document(target)).branches) == branches


def test_a_save_as_yaml_says_how_yaml_is_written(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    said: list[str] = []
    person.window.files.said.connect(said.append)
    save_as(person, tmp_path / "other.yaml", monkeypatch)
    assert any("YAML is written whole" in words for words in said)
