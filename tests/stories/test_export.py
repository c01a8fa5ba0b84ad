"""A person writes the drawing as a picture: what they chose, in the form they chose, or nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from shiboken6 import isValid

from smsl_studio.blueprint.address import Address
from smsl_studio.cli import main
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.files import save_document
from smsl_studio.stop import heed
from smsl_studio.studio.features.export.export_dialog import ExportDialog
from smsl_studio.studio.features.export.subject import ALL, BRANCH, SELECTION, VIEW, Subject
from tests.hostile_names import hidden, write_hostile
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def hfsm(tmp_path: Path) -> Path:
    path = tmp_path / "hfsm.json"
    path.write_bytes((SAMPLES / "hfsm.json").read_bytes())
    return path


@pytest.fixture(autouse=True)
def closed(qapp: QApplication) -> Iterator[None]:
    yield
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def open_dialog(person: Person) -> ExportDialog:
    held = Qt.KeyboardModifier
    person.press(Qt.Key.Key_E, [held.ControlModifier, held.ShiftModifier])
    person.qtbot.waitUntil(lambda: bool(person.window.findChildren(ExportDialog)))
    dialog = person.window.findChildren(ExportDialog)[-1]
    settle(person, dialog)
    return dialog


def settle(person: Person, dialog: ExportDialog) -> None:
    person.qtbot.waitUntil(lambda: not dialog.bar.isVisible(), timeout=60_000)


def choose(person: Person, dialog: ExportDialog, combo: str, words: str) -> None:
    box = getattr(dialog, combo)
    box.setFocus()
    at = box.findText(words)
    assert at >= 0, words
    while box.currentIndex() != at:
        QTest.keyClick(box, Qt.Key.Key_Down if box.currentIndex() < at else Qt.Key.Key_Up)
    settle(person, dialog)


def export(person: Person, dialog: ExportDialog, path: Path) -> None:
    dialog.ask_file = lambda suggested: path  # type: ignore[method-assign]
    person.click(dialog.go)
    person.qtbot.waitUntil(
        lambda: not is_open(dialog) or dialog.refusal.isVisible(), timeout=60_000
    )


def is_open(dialog: ExportDialog) -> bool:
    return isValid(dialog) and dialog.isVisible()


def words_of(path: Path) -> list[str]:
    return [node.text or "" for node in ET.fromstring(path.read_text("utf-8")).iter(f"{SVG}text")]


def test_this_branch_is_the_picture_of_the_command_line(
    sit: Sit, hfsm: Path, tmp_path: Path
) -> None:
    person = sit(hfsm)
    dialog = open_dialog(person)
    assert dialog.what.currentText() == "This State Branch"
    assert dialog.preview.rows
    asked: list[Path] = []
    dialog.ask_file = lambda suggested: asked.append(suggested)  # type: ignore[method-assign]
    person.click(dialog.go)
    assert asked == [hfsm.parent / "hfsm-SB1.svg"], "a name is proposed; Cancel writes nothing"
    export(person, dialog, tmp_path / "a.svg")
    assert person.window.toast.words == "Wrote a.svg."
    assert main(["render", str(hfsm), "-o", str(tmp_path / "b.svg"), "--sb", "SB1"]) == 0
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


@pytest.mark.parametrize("form", ["svg", "png"])
def test_all_branches_and_dark_are_those_of_the_command_line(
    sit: Sit, hfsm: Path, tmp_path: Path, form: str
) -> None:
    person = sit(hfsm)
    dialog = open_dialog(person)
    choose(person, dialog, "what", "All State Branches")
    choose(person, dialog, "theme", "Dark")
    choose(person, dialog, "form", form.upper())
    export(person, dialog, tmp_path / f"a.{form}")
    out = str(tmp_path / f"b.{form}")
    assert main(["render", str(hfsm), "-o", out, "--theme", "dark"]) == 0
    assert (tmp_path / f"a.{form}").read_bytes() == Path(out).read_bytes()


def test_the_selection_has_no_ring_and_nothing_else(sit: Sit, hfsm: Path, tmp_path: Path) -> None:
    person = sit(hfsm)
    person.click_canvas(person.place("SB1/State100"))
    dialog = open_dialog(person)
    choose(person, dialog, "what", "The selection")
    export(person, dialog, tmp_path / "a.svg")
    words = words_of(tmp_path / "a.svg")
    assert "State100" in words
    assert "State110" not in words
    text = (tmp_path / "a.svg").read_text("utf-8")
    assert person.window.canvas.tokens.acc.name().upper() not in re.sub(
        r"<rect[^>]*height=\"2\"[^>]*>", "", text
    ), "the bar of a sub-SB alone has the colour of a selection"


@pytest.mark.parametrize(("name", "state"), [("hfsm", "State000"), ("hanoi", "State_bbb")])
def test_the_view_is_what_is_seen(sit: Sit, tmp_path: Path, name: str, state: str) -> None:
    person = sit(SAMPLES / f"{name}.json", (1000, 700))
    canvas = person.window.canvas
    canvas.camera.motion = False
    rect = canvas.rect_of(Address("SB1", state))
    assert rect is not None
    canvas.camera.go(rect.center(), 4.0)
    seen = canvas.seen
    inside = [
        name
        for name in person.blueprint["SB1"].table
        if (box := canvas.rect_of(Address("SB1", name))) is not None and seen.intersects(box)
    ]
    assert inside == [state]
    dialog = open_dialog(person)
    choose(person, dialog, "what", "What is in view")
    export(person, dialog, tmp_path / "a.svg")
    words = words_of(tmp_path / "a.svg")
    assert [name for name in person.blueprint["SB1"].table if name in words] == inside


@pytest.mark.parametrize(("zoom", "told"), [(1.0, False), (0.5, True)])
def test_the_dialog_says_that_the_picture_has_more_than_a_canvas_from_afar(
    sit: Sit, hfsm: Path, zoom: float, told: bool
) -> None:
    person = sit(hfsm)
    person.window.canvas.camera.motion = False
    person.window.canvas.zoom_to(zoom)
    dialog = open_dialog(person)
    assert ("shortens names and facts" in dialog.facts.text()) == told


def test_the_scale_is_that_of_the_pixels(sit: Sit, hfsm: Path, tmp_path: Path) -> None:
    person = sit(hfsm)
    dialog = open_dialog(person)
    assert not dialog.scale.isEnabled(), "an SVG has no pixels"
    choose(person, dialog, "form", "PNG")
    choose(person, dialog, "scale", "3 ×")
    said = dialog.facts.text()
    export(person, dialog, tmp_path / "a.png")
    image = QImage(str(tmp_path / "a.png"))
    assert said == f"{image.width():,} × {image.height():,} pixels"
    person.come_back()
    again = open_dialog(person)
    assert again.scale.currentText() == "3 ×", "the choices are kept for the next time"
    assert again.form.currentText() == "PNG"


def test_a_folder_that_refuses_is_told_and_the_dialog_stays(
    sit: Sit, hfsm: Path, tmp_path: Path
) -> None:
    person = sit(hfsm)
    dialog = open_dialog(person)
    export(person, dialog, tmp_path / "gone" / "a.svg")
    assert "was not saved" in dialog.refusal.text()
    assert "save elsewhere" in dialog.refusal.text()
    assert is_open(dialog)
    export(person, dialog, tmp_path / "a.gif")
    assert "Let it end in .svg, .png or .pdf." in dialog.refusal.text()
    before = hfsm.read_bytes()
    own = tmp_path / "own.svg"
    own.symlink_to(hfsm)
    export(person, dialog, own)
    assert hfsm.read_bytes() == before, "a picture never takes the place of the blueprint"
    assert {path.name for path in tmp_path.iterdir()} == {"hfsm.json", "own.svg"}
    export(person, dialog, tmp_path / "a.svg")
    assert not is_open(dialog)


def test_a_long_picture_is_called_off(
    sit: Sit, hfsm: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(hfsm)
    dialog = open_dialog(person)

    def endless(*_: object) -> bytes:
        while True:
            heed()

    monkeypatch.setattr(Subject, "file", endless)
    dialog.ask_file = lambda suggested: tmp_path / "a.png"  # type: ignore[method-assign]
    person.click(dialog.go)
    assert dialog.bar.isVisible()
    assert dialog.said.text() == "Writing a.png…"
    assert not dialog.go.isEnabled()
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    dialog.beside.wait()
    assert is_open(dialog)
    assert dialog.facts.text() == "Called off. Nothing was written."
    assert not (tmp_path / "a.png").exists()
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert not is_open(dialog)


def test_nothing_can_be_drawn_without_a_branch(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "empty.json"
    path.write_text("{}", "utf-8")
    person = sit(path)
    table = person.window.actions_table
    table.refresh()
    names = ("export_picture", "print", "copy_picture", "copy_mermaid", "copy_dot")
    assert not any(table[name].isEnabled() for name in names)


def test_hostile_names_stay_text(sit: Sit, tmp_path: Path) -> None:
    person = sit(write_hostile(tmp_path))
    dialog = open_dialog(person)
    export(person, dialog, tmp_path / "a.svg")
    assert not hidden((tmp_path / "a.svg").read_text("utf-8"))
    for what in (BRANCH, VIEW, ALL):
        assert what in dialog.subjects


def test_a_crowd_is_previewed_and_written(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "crowd.json"
    save_document(hanoi(6).document, path)
    person = sit(path)
    dialog = open_dialog(person)
    (sheet,) = dialog.preview.rows[0]
    assert max(sheet.image.width(), sheet.image.height()) <= 1600
    export(person, dialog, tmp_path / "a.svg")
    assert (tmp_path / "a.svg").stat().st_size > 100_000


def test_a_selection_is_offered_only_if_there_is_one(sit: Sit, hfsm: Path) -> None:
    person = sit(hfsm)
    dialog = open_dialog(person)
    assert list(dialog.subjects) == [BRANCH, VIEW, ALL]
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    person.come_back()
    person.click_canvas(person.place("SB1/State100"))
    assert SELECTION in open_dialog(person).subjects
