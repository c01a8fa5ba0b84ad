"""A broken file is opened too: its text, its faults, and what can be drawn of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QMessageBox

from smsl_studio.blueprint import editing
from smsl_studio.studio.document.files.dialogs import Dialogs
from tests.stories.conftest import Sit
from tests.stories.person import Person

BROKEN = {
    "a.json": """{
  "SB1": {
    "State_0": {"Up": "State_1"}
    "State_1": {"Down" "State_0"}
  }
}
""",
    "a.smsl": """{
    # NAME: SB1
    State_0: [Up -> State_1]
    State_1: [Down > State_0
}
""",
    "a.yaml": """SB1:
  State_0:
    Up: State_1
  State_1: {Down: State_0
""",
}


def answer(person: Person, words: str, told: list[str]) -> None:
    """Press a button of the question that comes up next."""

    def press() -> None:
        box = QApplication.activeModalWidget()
        assert isinstance(box, QMessageBox)
        told.append(box.text())
        next(b for b in box.buttons() if b.text() == words).click()

    QTimer.singleShot(50, person.window, press)


def broken(name: str, folder: Path) -> Path:
    path = folder / name
    path.write_text(BROKEN[name])
    return path


@pytest.mark.parametrize("name", list(BROKEN))
def test_the_text_its_faults_and_what_could_be_read_are_shown(
    name: str, sit: Sit, tmp_path: Path
) -> None:
    path = broken(name, tmp_path)
    person = sit(path)
    window = person.window
    assert window.session.broken is not None
    faults = len(window.session.broken.error.faults)
    said = f"{faults} fault{'' if faults == 1 else 's'} in the text"
    assert window.docks.right_tabs.current == "Source"
    assert window.source.editor.sheet.text == BROKEN[name]
    assert window.findings.empty.text().startswith(said)
    assert "No findings" not in window.findings.empty.text()
    assert said in window.status_line.words
    assert "cannot be read" in window.canvas.overlays.banner.text
    assert window.menu_row.title == name, "nothing was edited"
    assert "State_0" in person.blueprint["SB1"].table
    person.until_inspected()
    assert window.findings.empty.text().startswith(said)
    assert path.read_text() == BROKEN[name]


def test_an_edit_is_refused_until_the_text_is_repaired(sit: Sit, tmp_path: Path) -> None:
    person = sit(broken("a.json", tmp_path))
    session = person.window.session
    assert not session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_2"))
    assert "a.json cannot be read" in person.window.toast.words
    whole = BROKEN["a.json"].replace('"}\n    "State_1"', '"},\n    "State_1"')
    session.write("Repair", whole.replace('"Down" "', '"Down": "'))
    assert session.broken is None
    assert not person.window.canvas.overlays.banner.text
    person.until_inspected()
    assert "in the text" not in person.window.status_line.words
    assert person.window.menu_row.title == "a.json edited"
    assert session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_2"))
    assert person.window.files.save()
    session.history.undo()
    session.history.undo()
    assert session.broken is not None, "undone to the text that was opened"


def test_a_broken_text_is_saved_after_asking(sit: Sit, tmp_path: Path) -> None:
    path = broken("a.json", tmp_path)
    person = sit(path)
    typed = BROKEN["a.json"].replace("Up", "Upward")
    person.window.session.write("Type", typed)
    told: list[str] = []
    answer(person, "Cancel", told)
    assert not person.window.files.save()
    assert path.read_text() == BROKEN["a.json"]
    answer(person, "Save as it is", told)
    assert person.window.files.save()
    assert path.read_text() == typed
    assert person.window.menu_row.title == "a.json"
    assert told == ["The text of a.json cannot be read as a blueprint."] * 2


def test_a_broken_text_cannot_change_its_form(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(broken("a.json", tmp_path))
    for name, good in (("b.yaml", False), ("b.json", True)):
        target = tmp_path / name
        monkeypatch.setattr(Dialogs, "file_to_save", lambda *_, target=target: target)
        answer(person, "Save as it is", [])
        assert person.window.files.save_as() is good
        assert target.exists() is good
    assert (tmp_path / "b.json").read_text() == BROKEN["a.json"]
    assert person.window.menu_row.title == "b.json"
    assert person.window.session.broken is not None


def test_a_file_of_which_nothing_can_be_read_shows_its_text(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "letter.json"
    path.write_text("Dear all,\nthis is a letter.\n")
    person = sit(path)
    assert person.window.source.editor.sheet.text == path.read_text()
    assert "Nothing of it can be drawn" in person.window.canvas.overlays.banner.text
    assert "fault" in person.window.findings.empty.text()
    person.window.set_mode("run")
    person.window.set_mode("draw")


def test_the_missing_part_of_a_broken_file_is_no_finding(sit: Sit, tmp_path: Path) -> None:
    """State_1 stands in the text; that the drawing lacks it is the fault's doing."""
    path = tmp_path / "a.yaml"
    path.write_text("SB1:\n  State_0:\n    Up: State_1\n   State_1: {}\n")
    person = sit(path)
    window = person.window
    person.until(lambda: window.inspector.current)
    assert any("State_1" in str(one) for one in window.inspector.findings)
    assert list(window.source.editor.gutter.marks) == [3]
    assert window.source.repairing.every() == ()
    assert not window.editor.canvas.marks.findings
    person.window.session.write("Type", "SB1:\n  State_0:\n    Up: State_9\n")
    person.until(lambda: bool(window.editor.canvas.marks.findings))


def test_all_that_is_said_of_the_faults_can_be_read(sit: Sit, tmp_path: Path) -> None:
    """A mark, an empty line, and a fault that says what it is: longer than the panel is high."""
    path = tmp_path / "a.smsl"
    path.write_text("SB1 {\n  HEADER {\n  State_0 { Op_1: State_1, Op_2 State_2 }\n")
    person = sit(path, (1280, 800))
    told = person.window.findings.empty
    person.until(told.isVisible)
    assert told.height() >= told.heightForWidth(told.width())


def test_the_offered_fix_says_in_which_line_it_is(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "a.smsl"
    path.write_text("nothing of it\n{\n  # NAME: SB1\n  State_0 [ ]\n}\n")
    faults = sit(path).window.source.faults
    assert faults.said.text().startswith("2 faults: line 1, ")
    assert faults.fix_button.text().startswith("Line 4: ")


def test_nobody_is_asked_to_draw_where_drawing_is_refused(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text("{")
    person = sit(path)
    hint = person.window.canvas.overlays.empty
    assert "Nothing of it can be drawn" in person.window.canvas.overlays.banner.text
    assert not hint.isVisible()
    person.window.session.write("Repair", '{"SB1": {}}')
    assert hint.isVisible()


def test_messages_about_a_file_go_when_another_file_is_opened(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text('{"SB1": {"State_0": {}}}')
    person = sit(path)
    assert not person.window.files.open(tmp_path / "none.json")
    assert "cannot be read" in person.window.toast.words
    assert person.window.files.open(path)
    assert not person.window.toast.words
