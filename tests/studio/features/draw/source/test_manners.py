"""The editing keys of the source text: Enter, Tab, brackets, comments, moving lines."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QRawFont, QTextLayout
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base.theme import mono_font, text_font
from smsl_studio.studio.features.draw.source.colours import MANY, pieces
from tests.studio.features.draw.source.conftest import ALT, CTRL, HFSM, SHIFT, Writer

At = Callable[..., Writer]
NATIVE = "{\n    # NAME: SB1\n    State_0: [Op -> State_0]\n}\n"


def test_enter_keeps_the_indentation_and_opens_brackets(at_text: At) -> None:
    writer = at_text()
    writer.go('"State_1": {')
    writer.key(Qt.Key.Key_Return)
    assert '        "State_1": {\n            \n        },\n' in writer.text
    writer.type('"Op": "State_0",')
    writer.key(Qt.Key.Key_Return)
    assert writer.pane.editor.caret == (9, 12)


def test_quotes_and_brackets_close_themselves_modestly(at_text: At) -> None:
    writer = at_text()
    writer.go('"State_1": {}')
    writer.type(",")
    writer.key(Qt.Key.Key_Return)
    writer.type('"State_3": {"Op": "State_0"}')
    assert '"State_1": {},\n        "State_3": {"Op": "State_0"},\n' in writer.text
    writer.go("State_3", behind=False)
    writer.type('"')
    assert '""State_3"' in writer.text
    writer.go('"Back": "State_0"')
    writer.type(", {")
    writer.key(Qt.Key.Key_Backspace)
    assert '"State_0", }' in writer.text


def test_marked_lines_are_indented_and_back(at_text: At) -> None:
    writer = at_text()
    writer.mark('"Op_1"', '"Op_2"')
    writer.key(Qt.Key.Key_Tab)
    assert '\n                "Op_1"' in writer.text
    assert '\n                "Op_2"' in writer.text
    writer.key(Qt.Key.Key_Backtab, SHIFT)
    assert writer.text == HFSM
    writer.pane.settle()
    assert writer.words == ["Indent lines 5 to 6", "Unindent lines 5 to 6"]
    writer.go('"Op_1"', behind=False)
    writer.key(Qt.Key.Key_Tab)
    assert '\n                "Op_1"' in writer.text


def test_lines_are_doubled_and_moved(at_text: At) -> None:
    writer = at_text()
    writer.go('"Op_1"')
    writer.key(Qt.Key.Key_Down, ALT)
    assert writer.text.index("Op_2") < writer.text.index("Op_1")
    writer.key(Qt.Key.Key_Up, ALT)
    assert writer.text == HFSM
    writer.key(Qt.Key.Key_D, CTRL)
    assert writer.text.count('"Op_1": "State_1",\n') == 2
    assert writer.pane.editor.caret == (5, 18)


def test_native_lines_are_commented_and_json_has_no_comments(at_text: At) -> None:
    writer = at_text(NATIVE, "a.smsl")
    writer.go("State_0: ")
    writer.key(Qt.Key.Key_Slash, CTRL)
    assert "\n    // State_0: [Op" in writer.text
    writer.pane.settle()
    assert writer.states() == []
    writer.key(Qt.Key.Key_Slash, CTRL)
    assert writer.text == NATIVE
    other = at_text()
    other.key(Qt.Key.Key_Slash, CTRL)
    assert other.text == HFSM


def test_copy_gives_and_paste_takes_the_exact_text(at_text: At) -> None:
    text = '{"SB1": {\r\n"State_0": {}, "_note": "a\u2028b"\r\n}}\r\n'
    writer = at_text(text)
    writer.mark('"_note"', 'b"')
    writer.pane.editor.copy()
    assert QApplication.clipboard().text() == '"_note": "a\u2028b"'
    writer.pane.editor.cut()
    assert '"State_0": {}, \r\n' in writer.text
    writer.pane.editor.paste()
    assert writer.text == text
    writer.mark('"State_0"', "{}")
    QApplication.clipboard().setText('"State_0": {},\n"State_1": {}')
    writer.pane.editor.paste()
    assert '{},\r\n"State_1"' in writer.text
    writer.pane.settle()
    assert writer.states() == ["State_0", "State_1"]


def test_a_file_that_is_dropped_is_not_text(at_text: At) -> None:
    writer, data = at_text(), QMimeData()
    data.setText("file:///tmp/a.json")
    assert writer.pane.editor.canInsertFromMimeData(data)
    data.setUrls([QUrl("file:///tmp/a.json")])
    assert not writer.pane.editor.canInsertFromMimeData(data)


def test_text_is_dropped_where_it_falls_and_moved_within(at_text: At) -> None:
    writer, data = at_text(), QMimeData()
    data.setText('"State_3": {},\n        ')
    editor = writer.pane.editor
    at = QPointF(editor.cursorRect(editor.cursor_at(HFSM.index('"State_1": {'))).center())
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(at.toPoint(), Qt.DropAction.CopyAction, data, buttons, keys)
    QApplication.sendEvent(editor.viewport(), enter)
    drop = QDropEvent(at, Qt.DropAction.CopyAction, data, buttons, keys)
    QApplication.sendEvent(editor.viewport(), drop)
    writer.pane.settle()
    assert writer.states() == ["State_0", "State_3", "State_1", "State_2"]
    writer.mark('"State_3"', "{},\n        ")
    moved = editor.textCursor().selectedText().replace("\u2029", "\n")
    editor.drop_text(moved, writer.text.index('"State_2": {'), moved=True)
    writer.pane.settle()
    assert writer.states() == ["State_0", "State_1", "State_3", "State_2"]
    assert writer.words == ["Drop text", "Move text"]
    assert writer.lines == writer.text.split("\n")


@pytest.mark.parametrize("key", [Qt.Key.Key_Tab, Qt.Key.Key_Return])
def test_escape_and_tab_leave_the_text(at_text: At, key: Qt.Key) -> None:
    writer = at_text()
    writer.pane.find_bar.show()
    writer.key(Qt.Key.Key_Escape)
    assert not writer.pane.find_bar.isVisible()
    writer.key(Qt.Key.Key_Escape)
    writer.key(key)
    left = key == Qt.Key.Key_Tab
    assert (writer.text == HFSM) is left


RTL = HFSM.replace("State_0", "חדר_0").replace("State_1", "חדר_1")


def test_brackets_keep_their_order_beside_right_to_left_names(at_text: At) -> None:
    writer = at_text(RTL)
    writer.go('"חדר_1": {', behind=False)
    name = writer.pane.editor.cursorRect().left()
    writer.go('"חדר_1": {')
    assert name < writer.pane.editor.cursorRect().left()


def test_quotes_close_themselves_beside_right_to_left_names(at_text: At) -> None:
    writer = at_text(RTL)
    writer.go('"חדר_1": {')
    writer.type('"Op": "next"')
    assert '"חדר_1": {"Op": "next"' in writer.text
    writer.type(', "')
    writer.key(Qt.Key.Key_Backspace)
    assert '"חדר_1": {"Op": "next", }' in writer.text


def test_a_name_is_shown_as_it_is_written(qapp: QApplication) -> None:
    """No arrow is made of "->"."""
    for font in (text_font(), mono_font()):
        glyphs = QRawFont.fromFont(font).glyphIndexesForString("->")
        layout = QTextLayout("->", font)
        layout.beginLayout()
        layout.createLine()
        layout.endLayout()
        shown = [glyph for run in layout.glyphRuns() for glyph in run.glyphIndexes()]
        assert shown == glyphs


def test_after_a_large_paste_every_visible_line_has_the_colours_of_its_text(at_text: At) -> None:
    writer = at_text()
    editor = writer.pane.editor
    editor.grab()
    many = ",\n".join(f'  "State_{at}": {{"Op_{at}": "State_0"}}' for at in range(MANY + 10))
    data = QMimeData()
    data.setText('{"Another": {"HEADER": {"INITIAL": "State_7"},\n' + many + "\n}}\n")
    QApplication.clipboard().setMimeData(data)
    writer.key(Qt.Key.Key_A, CTRL)
    writer.key(Qt.Key.Key_V, CTRL)
    assert writer.text == data.text()
    writer.key(Qt.Key.Key_Home, CTRL)
    editor.grab()
    for at in range(10):
        block = editor.document().findBlockByNumber(at)
        dressed = [(part.start, part.start + part.length) for part in block.layout().formats()]
        assert dressed == [(start, end) for start, end, _ in pieces(block.text(), "json")]
        assert dressed
