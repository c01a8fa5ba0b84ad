"""Typed text becomes a step after a pause, in one history with the canvas; faults are marked."""

from __future__ import annotations

from collections.abc import Callable

from hypothesis import given, settings
from hypothesis import strategies as st
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.draw.source.editor import Editor
from tests.counts import share_of
from tests.studio.features.draw.source.conftest import CTRL, HFSM, SHIFT, Writer

At = Callable[..., Writer]
MORE = ',\n"State_3": {"Op": "State_0"}'


def test_a_state_that_is_typed_is_there_after_a_pause(at_text: At) -> None:
    writer = at_text()
    writer.go('"State_1": {}')
    writer.type(MORE.replace("\n", ""))
    assert writer.states() == ["State_0", "State_1", "State_2"]
    writer.until(lambda: len(writer.states()) == 4)
    assert writer.states() == ["State_0", "State_1", "State_3", "State_2"]
    assert writer.words == ["Type in line 8"]
    assert writer.session.texts["a.json"] == writer.text


def test_caret_and_scroll_stay_while_the_graph_follows(at_text: At) -> None:
    states = "".join(f'"State_{n:03}": {{}},\n' for n in range(100, 400))
    writer = at_text('{"SB1": {\n' + states + '"State_999": {}\n}}\n')
    writer.go('"State_250": {')
    writer.pane.editor.centerCursor()
    top, caret = writer.pane.editor.verticalScrollBar().value(), writer.pane.editor.caret
    writer.type('"Op": "State_100"')
    writer.until(lambda: bool(writer.session.blueprint["SB1"].table["State_250"]))
    assert writer.pane.editor.verticalScrollBar().value() == top
    assert writer.pane.editor.caret == (caret[0], caret[1] + len('"Op": "State_100"'))


def test_undo_in_the_text_takes_back_what_was_typed_and_then_what_was_drawn(at_text: At) -> None:
    writer = at_text()
    writer.session.edit(
        "Rename", lambda bp: editing.rename(bp, Address("SB1", "State_1"), "State_9")
    )
    writer.go('"State_9": {}')
    writer.type(', "State_3": {}')
    writer.key(Qt.Key.Key_Z, CTRL)
    assert writer.words == ["Rename", "Type in line 8"]
    assert "State_3" not in writer.text
    writer.key(Qt.Key.Key_Z, CTRL)
    assert writer.text == HFSM
    assert writer.lines == HFSM.split("\n")
    writer.key(Qt.Key.Key_Z, CTRL | SHIFT)
    writer.key(Qt.Key.Key_Y, CTRL)
    assert writer.states() == ["State_0", "State_9", "State_3", "State_2"]


def test_an_edit_from_the_canvas_waits_for_what_is_typed(at_text: At) -> None:
    writer = at_text()
    writer.go("State_2", nth=1)
    writer.type("2")
    assert writer.session.edit(
        "Delete", lambda bp: editing.delete(bp, [Address("SB1", "State_22")])
    )
    assert writer.states() == ["State_0", "State_1"]
    assert writer.lines == writer.text.split("\n")


def test_a_canvas_edit_patches_the_lines_it_changes(at_text: At) -> None:
    writer = at_text()
    kept = writer.pane.editor.document().findBlockByNumber(3).revision()
    writer.session.edit("Add", lambda bp: editing.add_branch(bp, "SB2"))
    assert writer.lines == writer.text.split("\n") == writer.session.texts["a.json"].split("\n")
    assert writer.pane.editor.document().findBlockByNumber(3).revision() == kept


def test_a_broken_text_is_underlined_and_reported(at_text: At) -> None:
    writer = at_text()
    good = writer.session.blueprint
    writer.go('"State_1": {}')
    writer.key(Qt.Key.Key_Backspace)
    writer.key(Qt.Key.Key_Backspace)
    writer.pane.settle()
    assert writer.session.blueprint is good
    assert writer.session.broken is not None
    assert writer.pane.faults.isVisible()
    said = writer.pane.faults.said.text()
    assert said.startswith("1 fault: line ")
    assert said.endswith("the graph shows the last version that could be read.")
    assert "E" in {mark.severity for mark in writer.pane.editor.gutter.marks.values()}
    writer.type("{}")
    writer.pane.settle()
    assert writer.session.broken is None
    assert not writer.pane.faults.isVisible()
    assert not writer.pane.editor.gutter.marks


def test_leaving_the_text_takes_over_what_was_typed(at_text: At) -> None:
    writer = at_text()
    writer.go("State_2", nth=1)
    writer.type("2")
    writer.pane.editor.clearFocus()
    assert writer.words == ["Type in line 9"]


def test_a_large_text_is_read_beside_the_window(at_text: At) -> None:
    states = "".join(f'"State_{n:05}": {{}},\n' for n in range(20_000))
    writer = at_text('{"SB1": {\n' + states + '"State_99999": {}\n}}\n')
    writer.go('"State_00250": {')
    writer.type('"Op": "State_00000"')
    writer.pane.editor.clearFocus()
    assert writer.pane.typing.pending
    writer.until(lambda: not writer.pane.typing.pending)
    assert writer.session.blueprint["SB1"].table["State_00250"] == {"Op": "State_00000"}


def test_yaml_asks_before_it_is_first_edited(at_text: At) -> None:
    writer = at_text("SB1:\n  State_0: {Op: State_0}\n", "a.yaml")
    assert writer.pane.yaml.isVisible()
    assert "comments may move" in writer.pane.yaml.said.text()
    writer.type("x")
    assert writer.text.startswith("SB1")
    writer.pane.yaml.edit_button.click()
    writer.go("{Op: State_0")
    writer.type(", Op_2: State_0")
    writer.pane.settle()
    assert writer.session.blueprint["SB1"].table == {
        "State_0": {"Op": "State_0", "Op_2": "State_0"}
    }
    assert not writer.pane.yaml.isVisible()


PIECES = st.sampled_from(["a", '"', "\n", "é", "𝛼", "\t"])
MOVES = st.lists(
    st.tuples(st.integers(0, 99), st.integers(0, 4), st.lists(PIECES, max_size=3).map("".join)),
    max_size=8,
)
EXACT = st.lists(
    st.sampled_from(["b", "{", "\n", "\r\n", "\r", "\u2028", "𝛼", "\xa0", "\x85", "\ufffc"]),
    max_size=20,
).map("".join)


@settings(max_examples=share_of(60))
@given(st.sampled_from(["", "\ufeff"]), EXACT, MOVES)
def test_the_widget_shows_the_sheet_whatever_is_typed(
    qapp: object, bom: str, text: str, moves: list[tuple[int, int, str]]
) -> None:
    editor = Editor(LIGHT)
    editor.load(bom + text)
    for at, length, words in moves:
        cursor = QTextCursor(editor.document())
        last = editor.document().characterCount() - 1
        cursor.setPosition(min(at, last))
        cursor.movePosition(cursor.MoveOperation.Right, cursor.MoveMode.KeepAnchor, length)
        cursor.insertText(words)
        blocks = [editor.document().findBlockByNumber(n).text()
                  for n in range(editor.blockCount())]  # fmt: skip
        assert editor.sheet.shown.split("\n") == blocks
