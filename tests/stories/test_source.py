"""The source pane in the window: one text, one graph, one history."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.blueprint.address import Address
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
HFSM = SAMPLES / "hfsm.json"
FAULTY = """{
    "SB1": {
        "HEADER": {"INITIAL": "State_0"},
        "State_0": {"Op_1": "State_1" "Op_2": "State_2"},
        "State_1" {"Back": "State_0"},
        "State_2": {"Back": "State_0",}
    }
}
"""


def open_source(person: Person) -> None:
    """Show the source and put the focus there."""
    person.ctrl(Key.Key_U)
    editor = person.window.source.editor
    person.until(editor.isVisible)
    editor.setFocus()
    person.until(editor.hasFocus)


def caret_behind(person: Person, words: str) -> None:
    """Find words by Ctrl+F, as a person does, and stand behind them."""
    person.ctrl(Key.Key_F)
    bar = person.window.source.find_bar
    person.until(bar.words.hasFocus)
    person.type(words)
    person.press(Key.Key_Escape)
    person.press(Key.Key_Right)


def test_a_state_is_typed_found_on_the_canvas_dragged_and_undone(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "hfsm.json"
    text = HFSM.read_text("utf-8")
    path.write_text(text, "utf-8")
    person = sit(path)
    source, canvas = person.window.source, person.window.canvas
    open_source(person)
    caret_behind(person, '"State111": { }')
    person.type(",")
    person.press(Key.Key_Return)
    person.type('"State001": {"Again": "State000"}')
    person.until(lambda: "State001" in person.blueprint["SB1"].table)
    state = Address("SB1", "State001")
    person.until(lambda: canvas.rect_of(state) is not None)
    assert source.editor.hasFocus()
    canvas.fit(smooth=False)
    place = person.place("SB1/State001")
    person.click_canvas(place)
    assert person.selected() == ["SB1/State001"]
    person.drag(place, place + QPoint(60, 40))
    person.until(lambda: "_layout" in source.editor.sheet.text)
    assert [one.split()[0] for one in person.steps()] == ["Type", "Move"]
    source.editor.setFocus()
    person.ctrl(Key.Key_Z)
    assert "_layout" not in source.editor.sheet.text
    assert "State001" in source.editor.sheet.text
    canvas.setFocus()
    person.ctrl(Key.Key_Z)
    assert source.editor.sheet.text == text
    assert "State001" not in person.blueprint["SB1"].table
    assert not person.window.session.edited
    person.press(Key.Key_Z, [CTRL, SHIFT])
    source.editor.setFocus()
    person.press(Key.Key_Z, [CTRL, SHIFT])
    assert "_layout" in source.editor.sheet.text
    assert person.blueprint["SB1"].table["State001"] == {"Again": "State000"}


def test_a_file_with_three_faults_is_repaired_by_quick_fixes_alone(
    sit: Sit, tmp_path: Path
) -> None:
    path = tmp_path / "faulty.json"
    path.write_text(FAULTY, "utf-8")
    person = sit(path)
    session, source = person.window.session, person.window.source
    assert session.broken is not None
    assert len(session.broken.error.faults) == 3
    person.until(source.isVisible)
    assert source.editor.sheet.text == FAULTY
    assert len(source.editor.gutter.marks) == 3
    assert source.faults.said.text().startswith("3 faults: line 4")
    assert person.window.canvas.rect_of(Address("SB1", "State_0")) is not None
    source.editor.setFocus()
    for left in (2, 1, 0):
        person.ctrl(Key.Key_Period)
        menu = QApplication.activePopupWidget()
        assert isinstance(menu, QMenu)
        person.press(Key.Key_Return) if menu.hasFocus() else menu.activeAction().trigger()
        menu.close()
        faults = session.broken.error.faults if session.broken else ()
        assert len(faults) == left
    assert not source.faults.isVisible()
    assert person.blueprint["SB1"].table == {
        "State_0": {"Op_1": "State_1", "Op_2": "State_2"},
        "State_1": {"Back": "State_0"},
        "State_2": {"Back": "State_0"},
    }
    assert len(person.steps()) == 3
    person.window.files.save()
    assert path.read_text("utf-8") == source.editor.sheet.text


def test_nothing_runs_and_nothing_is_drawn_while_the_text_is_broken(sit: Sit) -> None:
    person = sit(HFSM)
    open_source(person)
    person.type("x")
    person.window.canvas.setFocus()
    assert person.window.session.broken is not None
    count = person.window.session.history.count()
    person.window.actions_table["add_branch"].trigger()
    assert person.window.session.history.count() == count
    assert "cannot be read, line 1" in person.window.toast.words
    person.press(Key.Key_F5)
    assert not person.window.features.run.pane.run.exists
    assert "cannot be read" in person.window.features.run.pane.canvas.banner
    person.ctrl(Key.Key_1)
    person.ctrl(Key.Key_Z)
    assert person.window.session.broken is None


def test_the_status_line_says_where_the_caret_is(sit: Sit) -> None:
    person = sit(HFSM)
    open_source(person)
    caret_behind(person, '"State111": { }')
    line, column = person.window.source.editor.caret
    assert person.window.status_line.place.text() == f"Line {line + 1}, column {column + 1}"
    person.type(",")
    person.window.source.settle()
    assert person.window.session.broken is not None
    person.type('"State001": {}')
    person.window.source.settle()
    column += len(',"State001": {}')
    assert person.window.session.broken is None
    assert person.window.status_line.place.text() == f"Line {line + 1}, column {column + 1}"
