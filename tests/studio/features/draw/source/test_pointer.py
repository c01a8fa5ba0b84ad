"""Hovering shows what a name is, a jump goes to its element, several files give a choice."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.document.session import Session
from tests.studio.features.draw.source.conftest import CTRL, NONE, Writer

At = Callable[..., Writer]
SAMPLES = Path(__file__).parents[5] / "samples"


def point(writer: Writer, word: str) -> QPoint:
    """Where a word is shown."""
    at = writer.text.index(word) + 1
    cursor = writer.pane.editor.cursor_at(at)
    writer.pane.editor.setTextCursor(cursor)
    writer.pane.editor.centerCursor()
    return writer.pane.editor.cursorRect(cursor).center()


def test_hovering_says_facts_ways_costs_and_findings(at_text: At) -> None:
    writer = at_text((SAMPLES / "hanoi.json").read_text("utf-8"), "hanoi.json")
    writer.pane.set_findings(inspect(writer.session.blueprint))
    words, sheet = writer.pane.pointing.words_at, writer.pane.editor.sheet
    said = words(*sheet.where(writer.text.index('"State_cbb": {') + 1))
    assert "State_cbb" in said
    assert "Fact 1 c, Fact 2 b, Fact 3 b" in said
    said = words(*sheet.where(writer.text.index('"Op_1c": "State_bbb"') + 1))
    assert "State_cbb to State_bbb, cost 1" in said
    assert "Op_1b" in said.partition("\n\n")[0]
    assert "1 operation" not in said
    assert "27 states, 78 operations" in words(*sheet.where(writer.text.index('"SB1"') + 1))
    assert words(0, 0) == ""


def test_f12_and_ctrl_click_go_to_what_a_name_stands_for(at_text: At) -> None:
    writer = at_text((SAMPLES / "hfsm.json").read_text("utf-8"), "hfsm.json")
    writer.go('"Operation000": "State100', behind=True)
    writer.key(Qt.Key.Key_F12)
    line = writer.lines[writer.pane.editor.caret[0]]
    assert line.strip().startswith('"State100": {')
    assert writer.session.selection == (Address("SB1", "State100"),)
    viewport = writer.pane.editor.viewport()
    QTest.mouseClick(viewport, Qt.MouseButton.LeftButton, CTRL, point(writer, '"SB2": 1'))
    assert writer.session.branch == "SB2"
    assert writer.lines[writer.pane.editor.caret[0]].strip() == '"SB2": {'


def test_a_click_selects_also_while_the_text_is_broken(at_text: At) -> None:
    writer = at_text()
    writer.go('"State_2": {"Back": "State_0"')
    writer.key(Qt.Key.Key_Backspace)
    writer.pane.settle()
    assert writer.session.broken is not None
    viewport = writer.pane.editor.viewport()
    at = point(writer, '"Op_2"')
    QTest.mouseClick(viewport, Qt.MouseButton.LeftButton, NONE, at)
    assert writer.session.selection == (Address("SB1", "State_0", "Op_2"),)
    assert writer.pane.marked_lines == (6,)


def two_files(folder: Path) -> Session:
    (folder / "sub.json").write_text('{"SB2": {"State_0": {"On": "State_1"}, "State_1": {}}}\n')
    (folder / "main.json").write_text(
        '{"_imports": ["sub.json"],\n "SB1": {"HEADER": {"SUB_SBS": {"SB2": 0}},\n'
        '  "State_0": {"Go": "State_1"}, "State_1": {}}}\n'
    )
    return Session(read_blueprint(read_document(folder / "main.json")))


def test_the_file_of_the_shown_sb_is_shown_and_typed_in(at_text: At, tmp_path: Path) -> None:
    writer = at_text(session=two_files(tmp_path))
    pane, session = writer.pane, writer.session
    assert pane.files.isVisible()
    assert pane.files.choice.currentText() == "main.json"
    session.show_branch("SB2")
    assert pane.files.choice.currentText() == "sub.json"
    writer.go('"State_1": {')
    writer.type('"Off": "State_0"')
    pane.settle()
    assert session.blueprint["SB2"].table["State_1"] == {"Off": "State_0"}
    assert session.texts[pane.file] == writer.text
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_2"))
    session.history.undo()
    session.history.undo()
    assert session.blueprint["SB2"].table["State_1"] == {}


def test_while_one_file_is_broken_no_other_can_be_typed_in(at_text: At, tmp_path: Path) -> None:
    writer = at_text(session=two_files(tmp_path))
    pane, refused = writer.pane, list[StudioError]()
    writer.session.refused.connect(refused.append)
    writer.type("x")
    pane.settle()
    assert writer.session.broken is not None
    pane.files.choice.setCurrentIndex(1)
    pane.files.choice.activated.emit(1)
    assert pane.file.endswith("sub.json")
    assert pane.editor.isReadOnly()
    assert "main.json" in pane.faults.said.text()
    pane.faults.show_button.click()
    assert pane.file.endswith("main.json")
    assert not pane.editor.isReadOnly()
    assert not refused
