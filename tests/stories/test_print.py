"""A person prints the drawing: a preview of every sheet, a poster, and a file that is whole."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtPrintSupport import QPrinter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from shiboken6 import isValid

from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.features.export.print_dialog import PrintDialog
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person


@pytest.fixture(autouse=True)
def closed(qapp: QApplication) -> Iterator[None]:
    yield
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def open_dialog(person: Person) -> PrintDialog:
    person.ctrl(Qt.Key.Key_P)
    dialog = person.window.findChildren(PrintDialog)[-1]
    settle(person, dialog)
    return dialog


def settle(person: Person, dialog: PrintDialog) -> None:
    person.qtbot.waitUntil(lambda: not dialog.bar.isVisible(), timeout=60_000)


def choose(person: Person, dialog: PrintDialog, combo: str, words: str) -> None:
    box = getattr(dialog, combo)
    box.setFocus()
    at = box.findText(words)
    assert at >= 0, words
    while box.currentIndex() != at:
        QTest.keyClick(box, Qt.Key.Key_Down if box.currentIndex() < at else Qt.Key.Key_Up)
    settle(person, dialog)


def print_to(person: Person, dialog: PrintDialog, path: Path) -> None:
    def agree(printer: QPrinter) -> bool:
        printer.setOutputFormat(QPrinter.OutputFormat.PdfFormat)
        printer.setOutputFileName(str(path))
        return True

    dialog.ask_printer = agree  # type: ignore[method-assign]
    person.click(dialog.go)


def is_open(dialog: PrintDialog) -> bool:
    return isValid(dialog) and dialog.isVisible()


def pages(path: Path) -> int:
    return path.read_bytes().count(b"/Type /Page\n")


def test_one_sheet_is_printed_for_each_branch(sit: Sit, tmp_path: Path) -> None:
    person = sit(SAMPLES / "hfsm.json")
    dialog = open_dialog(person)
    assert [len(row) for row in dialog.preview.rows] == [1]
    assert dialog.facts.text() == "1 sheet"
    choose(person, dialog, "what", "All State Branches")
    assert [len(row) for row in dialog.preview.rows] == [1, 1]
    print_to(person, dialog, tmp_path / "out.pdf")
    person.qtbot.waitUntil(lambda: not is_open(dialog), timeout=60_000)
    assert person.window.toast.words == "Printed 2 sheets to out.pdf."
    assert pages(tmp_path / "out.pdf") == 2
    assert [path.name for path in tmp_path.iterdir()] == ["out.pdf"]


def test_a_poster_shows_its_sheets_and_prints_them(sit: Sit, tmp_path: Path) -> None:
    person = sit(SAMPLES / "hanoi.json")
    dialog = open_dialog(person)
    choose(person, dialog, "size_", "Poster, 3 sheets wide")
    rows = dialog.preview.rows
    assert {len(row) for row in rows} == {3}
    count = 3 * len(rows)
    assert dialog.facts.text().startswith(f"{count} sheets. Neighbours overlap")
    assert rows[0][0].paper.width() > rows[0][0].paper.height(), "the picture is broad"
    choose(person, dialog, "turn", "Portrait")
    assert dialog.preview.rows[0][0].paper.width() < dialog.preview.rows[0][0].paper.height()
    count = 3 * len(dialog.preview.rows)
    print_to(person, dialog, tmp_path / "out.pdf")
    person.qtbot.waitUntil(lambda: not is_open(dialog), timeout=60_000)
    assert pages(tmp_path / "out.pdf") == count


def test_a_printing_that_is_called_off_leaves_no_file(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "crowd.json"
    save_document(hanoi(8).document, path)
    person = sit(path)
    dialog = open_dialog(person)
    choose(person, dialog, "size_", "Poster, 4 sheets wide")
    print_to(person, dialog, tmp_path / "out.pdf")
    person.qtbot.waitUntil(lambda: dialog.bar.value() >= 1, timeout=60_000)
    assert dialog.said.text().startswith("Printing sheet ")
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert dialog.facts.text() == "Called off. Nothing was written."
    assert is_open(dialog)
    assert [one.name for one in tmp_path.iterdir()] == ["crowd.json"]
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert not is_open(dialog)


def test_a_folder_that_refuses_is_told(sit: Sit, tmp_path: Path) -> None:
    person = sit(SAMPLES / "hfsm.json")
    dialog = open_dialog(person)
    print_to(person, dialog, tmp_path / "gone" / "out.pdf")
    person.qtbot.waitUntil(dialog.refusal.isVisible, timeout=60_000)
    assert "was not saved" in dialog.refusal.text()
    assert is_open(dialog)


def test_a_poster_of_too_many_sheets_is_refused(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "long.json"
    path.write_text(
        '{"A": {"S": {"x": "T"}, "T": {}, "_layout": {"S": [0, 0], "T": [0, 100000]}}}', "utf-8"
    )
    person = sit(path)
    dialog = open_dialog(person)
    choose(person, dialog, "size_", "Poster, 8 sheets wide")
    assert "400 are the most" in dialog.refusal.text()
    assert not dialog.go.isEnabled()
    choose(person, dialog, "size_", "One sheet")
    assert dialog.refusal.text() == ""
    assert dialog.go.isEnabled()
