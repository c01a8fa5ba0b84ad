"""A person exports a drawing for another program, imports what another program wrote, and reads
what was left out."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtGui import QGuiApplication

import smsl_studio as smsl
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.studio.features.exchange import verbs
from smsl_studio.studio.features.exchange.findings_dialog import FindingsDialog
from tests.exchange import foreign
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person


@pytest.fixture
def hfsm(tmp_path: Path) -> Path:
    path = tmp_path / "hfsm.json"
    path.write_bytes((SAMPLES / "hfsm.json").read_bytes())
    return path


def choose(monkeypatch: pytest.MonkeyPatch, path: Path | None, kind: str = "") -> None:
    """Answer the system's dialogs."""
    name = str(path) if path else ""
    monkeypatch.setattr(verbs, "ask_to_open", lambda *_: name)
    monkeypatch.setattr(verbs, "ask_to_save", lambda *_: (name, kind))


def list_of(person: Person) -> FindingsDialog:
    person.qtbot.waitUntil(lambda: bool(person.window.findChildren(FindingsDialog)))
    return person.window.findChildren(FindingsDialog)[-1]


def test_what_is_exported_is_that_of_the_command_line_and_the_list_says_what_is_not_there(
    sit: Sit, hfsm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(hfsm)
    out = tmp_path / "out"
    choose(monkeypatch, out, next(kind for kind in verbs.KINDS if ".scxml" in kind))
    person.window.actions_table["export"].trigger()
    dialog = list_of(person)
    made = smsl.exported(smsl.read(hfsm), "x.scxml")
    assert (tmp_path / "out.scxml").read_text("utf-8") == made.text
    assert person.window.toast.words == "Wrote out.scxml."
    shown = [row.text for row in dialog.rows.rows.rows]
    assert shown == [f"{one.address}: {one.message}" for one in made.findings]
    dialog.copy()
    assert QGuiApplication.clipboard().text() == "\n".join(shown)
    dialog.accept()
    person.window.actions_table["export"].trigger()
    assert "is there already" in person.window.toast.words


def test_an_import_is_a_new_blueprint_without_a_file(
    sit: Sit, hfsm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(hfsm)
    file = tmp_path / "drill.scxml"
    file.write_text(foreign.SCXML, "utf-8")
    choose(monkeypatch, file)
    person.window.actions_table["import"].trigger()
    dialog = list_of(person)
    assert person.blueprint == smsl.imported(file).blueprint
    assert person.window.files.path is None
    assert person.window.files.name == "drill.json"
    assert any("A script is not run" in row.text for row in dialog.rows.rows.rows)
    assert person.blueprint == read_blueprint(person.blueprint.document)
    dialog.accept()


def test_a_hostile_file_and_no_choice_change_nothing(
    sit: Sit, hfsm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(hfsm)
    before = person.blueprint
    file = tmp_path / "x.scxml"
    file.write_text("<!DOCTYPE a><scxml/>", "utf-8")
    choose(monkeypatch, file)
    person.window.actions_table["import"].trigger()
    person.qtbot.waitUntil(lambda: "A document type" in person.window.toast.words)
    choose(monkeypatch, None)
    person.window.actions_table["import"].trigger()
    person.window.actions_table["export"].trigger()
    assert person.blueprint is before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["hfsm.json", "x.scxml"]
