"""A person copies the drawing as a picture, as Mermaid and as DOT, from the menu and by keys."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtGui import QGuiApplication, QImage

from smsl_studio.cli import main
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.files import save_document
from smsl_studio.stop import heed
from smsl_studio.studio.features.export.subject import Subject
from tests.hostile_names import hidden, write_hostile
from tests.picture.diagrams import read_dot, read_mermaid
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

HELD = [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]


def copied(person: Person, words: str) -> QMimeData:
    """What is on the clipboard once the window has said so."""
    person.qtbot.waitUntil(lambda: person.window.toast.words.startswith(words), timeout=60_000)
    data = QGuiApplication.clipboard().mimeData()
    assert data is not None
    return data


def test_the_branch_is_copied_as_the_canvas_shows_it(sit: Sit, tmp_path: Path) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.press(Qt.Key.Key_C, HELD)
    data = copied(person, "Copied SB1 as a picture.")
    out = tmp_path / "out.svg"
    assert main(["render", str(SAMPLES / "hanoi.json"), "-o", str(out)]) == 0
    assert bytes(data.data("image/svg+xml").data()) == out.read_bytes()
    image = QImage.fromData(data.data("image/png").data())
    assert data.hasImage()
    assert image.width() > 2 * 1000


def test_the_selection_is_copied_alone(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.click_canvas(person.place("SB1/State_aaa"))
    person.press(Qt.Key.Key_C, HELD)
    data = copied(person, "Copied State_aaa as a picture.")
    svg = bytes(data.data("image/svg+xml").data()).decode()
    assert ">State_aaa<" in svg
    assert ">State_baa<" not in svg
    accent = person.window.canvas.tokens.acc.name().upper()
    assert accent not in svg, "no ring of the selection"
    person.window.actions_table["copy_dot"].trigger()
    assert list(read_dot(copied(person, "Copied State_aaa as DOT.").text()).nodes.values()) == [
        "State_aaa"
    ]


@pytest.mark.parametrize(("action", "name"), [("copy_mermaid", "Mermaid"), ("copy_dot", "DOT")])
def test_a_diagram_is_copied_as_text(sit: Sit, tmp_path: Path, action: str, name: str) -> None:
    person = sit(write_hostile(tmp_path))
    person.window.actions_table[action].trigger()
    person.qtbot.waitUntil(lambda: f" as {name}." in person.window.toast.words)
    text = copied(person, "Copied ").text()
    assert not hidden(text)
    found = (read_dot if name == "DOT" else read_mermaid)(text)
    assert (len(found.nodes), len(found.arrows)) == (2, 2)


def test_a_diagram_that_mermaid_refuses_is_told(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "crowd.json"
    save_document(hanoi(5).document, path)
    person = sit(path)
    person.window.actions_table["copy_mermaid"].trigger()
    copied(person, "Copied SB1 as Mermaid. Mermaid draws 500 operations unless")


def test_what_a_diagram_leaves_out_is_told(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-digitization.json")
    person.window.actions_table["copy_mermaid"].trigger()
    copied(person, "Copied ")
    assert "titles, facts and other details are left out" in person.window.toast.words


def test_a_long_copy_is_called_off(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    person = sit(SAMPLES / "hanoi.json")
    QGuiApplication.clipboard().setText("before")

    def endless(*_: object) -> str:
        while True:
            heed()

    monkeypatch.setattr(Subject, "svg", endless)
    person.press(Qt.Key.Key_C, HELD)
    assert person.window.toast.words == "Copying…"
    person.click(person.window.toast.button)
    person.window.features.export.copies().beside.wait()
    assert person.window.toast.words == ""
    assert QGuiApplication.clipboard().text() == "before"
