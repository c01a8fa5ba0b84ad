"""Blueprints over several files and forms: opened, edited in their own file, saved."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QRectF, Qt, QTimer
from PySide6.QtGui import QFontMetricsF, QPainter
from PySide6.QtWidgets import QApplication, QMessageBox

from smsl_studio.blueprint import editing
from smsl_studio.smsl import together
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.base import rows
from smsl_studio.studio.base.rows import TextInk
from smsl_studio.studio.base.theme import text_font
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.draw.panels import outline_tree
from tests.stories.at_outline import lines
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

OUTER_JSON = """{
  "_imports": ["parts/inner.json", "late.json"],
  "SB1": {
    "HEADER": {"SUB_SBS": {"SB2": 0}},
    "State_0": {"Op": "State_1"},
    "State_1": {"Back": "State_0"}
  }
}
"""
INNER = """{
  "SB2": {
    "State_0": {"Up": "State_1"},
    "State_1": {"Down": "State_0"}
  }
}
"""


@pytest.fixture
def outer(tmp_path: Path) -> Path:
    """A file that imports one that is there and one that is not."""
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "inner.json").write_text(INNER)
    path = tmp_path / "outer.json"
    path.write_text(OUTER_JSON)
    return path


def add(person: Person, branch: str, name: str = "State_2") -> None:
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, branch, name))


def answer(person: Person, words: str, told: list[str] | None = None) -> None:
    """Press a button of the question that comes up next."""

    def press() -> None:
        box = QApplication.activeModalWidget()
        assert isinstance(box, QMessageBox)
        if told is not None:
            told.append(box.text())
        next(b for b in box.buttons() if b.text().replace("&", "") == words).click()

    QTimer.singleShot(50, person.window, press)


def test_the_window_says_in_which_file_a_state_branch_lives(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    seen = lines(person.window.outline.tree)
    homes = {line.text: line.home for line in seen if line.digit is None}
    assert homes == {"SB1": "", "SB2": "inner.json", "late.json": ""}
    (late,) = (line for line in seen if line.fault)
    assert "outer.json > late.json" in late.tip
    person.window.session.show_branch("SB2")
    crumb = person.window.canvas.overlays.breadcrumb
    assert crumb.toolTip() == str(outer.parent / "parts/inner.json")
    assert person.window.status_line.place.text() == "inner.json, line 2, column 3"
    person.until_inspected()
    assert "R08" in [finding.rule for finding in person.window.findings.findings]


def test_an_edit_goes_to_the_file_of_its_state_branch_and_all_are_saved(
    sit: Sit, outer: Path
) -> None:
    inner = outer.parent / "parts/inner.json"
    person = sit(outer)
    title = person.window.menu_row
    add(person, "SB2")
    assert title.title == "outer.json inner.json edited"
    assert person.window.windowTitle().startswith("outer.json (inner.json edited)")
    add(person, "SB1")
    assert title.title == "outer.json and 1 more edited"
    told: list[str] = []
    answer(person, "Cancel", told)
    assert not person.window.close()
    assert told == ["outer.json and inner.json have unsaved changes."]
    assert person.window.files.save()
    assert title.title == "outer.json"
    assert person.window.toast.words == "Saved outer.json and inner.json."
    assert "State_2" in inner.read_text()
    assert "State_2" in outer.read_text()
    person.window.session.history.undo()
    person.window.session.history.undo()
    assert person.window.files.save()
    assert (outer.read_text(), inner.read_text()) == (OUTER_JSON, INNER)


def test_saving_is_all_or_none(sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inner = outer.parent / "parts/inner.json"
    person = sit(outer)
    add(person, "SB1")
    add(person, "SB2")

    def full(*_: object) -> Iterator[None]:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(together, "write_new", full)
    assert not person.window.files.save()
    assert "No space left on device" in person.window.toast.words
    assert (outer.read_text(), inner.read_text()) == (OUTER_JSON, INNER)
    assert person.window.menu_row.title == "outer.json and 1 more edited"


def test_the_file_of_a_state_branch_is_opened_from_its_menu(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    action = person.window.actions_table["open_home"]
    assert not action.isEnabled()
    person.window.session.show_branch("SB2")
    assert action.isEnabled()
    action.trigger()
    assert person.window.files.path == outer.parent / "parts/inner.json"


@pytest.mark.parametrize("suffix", [".smsl", ".yaml"])
def test_a_new_blueprint_takes_the_form_of_the_name_it_is_given(
    suffix: str, sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    add(person, "SB1", "State_0")
    target = tmp_path / f"new{suffix}"
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    person.ctrl(Qt.Key.Key_S)
    assert read_document(target).form == suffix[1:]
    assert person.window.menu_row.title == f"new{suffix}"
    assert person.window.status_line.form.text().startswith(suffix[1:].upper())
    add(person, "SB1", "State_1")
    assert person.window.files.save()
    assert "State_1" in read_document(target).values["SB1"]


def test_comments_that_stay_behind_are_said_before(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = Path(shutil.copy(SAMPLES / "example.smsl", tmp_path))
    assert "//" in path.read_text()
    person = sit(path)
    target = tmp_path / "example.json"
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    told: list[str] = []
    answer(person, "Cancel", told)
    assert not person.window.files.save_as()
    assert "comments" in told[0]
    assert not target.exists()
    before = person.blueprint
    answer(person, "Save as JSON")
    assert person.window.files.save_as()
    assert read_document(target).form == "json"
    assert person.blueprint == before
    assert person.window.session.history.count() == 0


def test_imports_are_found_from_another_folder_too(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(outer)
    add(person, "SB2")
    (outer.parent / "deep").mkdir()
    target = outer.parent / "deep" / "outer.json"
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    assert not person.window.files.save_as()
    assert "leads out of the project" in person.window.toast.words
    assert not target.exists()
    (outer.parent / "smsl.toml").touch()
    assert person.window.files.save_as()
    assert read_document(target).values["_imports"][0] == "../parts/inner.json"
    assert "State_2" in person.blueprint["SB2"].table
    assert "State_2" in (outer.parent / "parts/inner.json").read_text()
    assert outer.read_text() == OUTER_JSON


def test_yaml_is_said_to_be_written_whole_before_it_is_edited(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("SB1:\n  State_0:\n    Op: State_1  # up\n  State_1: {}\n")
    person = sit(path)
    assert "YAML is written whole" in person.window.toast.words
    assert person.window.status_line.form.text() == "YAML, UTF-8"
    add(person, "SB1")
    assert person.window.files.save()
    assert "# up" in path.read_text()


def test_encoding_and_line_ends_are_said_and_kept(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(b'\xef\xbb\xbf{\r\n  "SB1": {"State_0": {}}\r\n}\r\n')
    person = sit(path)
    assert person.window.status_line.form.text() == "JSON, UTF-8 with BOM, CRLF"
    add(person, "SB1", "State_1")
    assert person.window.files.save()
    saved = path.read_bytes()
    assert saved.startswith(b"\xef\xbb\xbf{\r\n")
    assert saved.count(b"\n") == saved.count(b"\r\n")


def test_why_an_import_failed_is_not_cut(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rooms: dict[str, float] = {}
    paint = rows.paint_text

    def seen(painter: QPainter, rect: QRectF, text: str, ink: TextInk, **more: Any) -> float:
        rooms[text] = rect.width()
        return paint(painter, rect, text, ink, **more)

    monkeypatch.setattr(outline_tree, "paint_text", seen)
    path = tmp_path / "outer.json"
    path.write_text('{"_imports": ["missing.json"], "SB1": {"State_0": {}}}')
    person = sit(path, (1280, 800))
    person.until(lambda: "not read" in rooms)
    assert rooms["not read"] >= QFontMetricsF(text_font(12)).horizontalAdvance("not read")
