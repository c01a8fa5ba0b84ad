"""Folding hides lines and never changes text."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from tests.studio.features.draw.source.conftest import CTRL, SHIFT, Writer

At = Callable[..., Writer]
SAMPLES = Path(__file__).parents[5] / "samples"
FOLD, UNFOLD = Qt.Key.Key_BraceLeft, Qt.Key.Key_BraceRight


def hanoi(at_text: At) -> Writer:
    return at_text((SAMPLES / "hanoi.json").read_text("utf-8"), "hanoi.json")


def seen(writer: Writer) -> list[int]:
    """The lines that are shown."""
    document = writer.pane.editor.document()
    return [n for n in range(document.blockCount()) if document.findBlockByNumber(n).isVisible()]


def test_what_is_marked_is_folded_and_says_what_it_is(at_text: At) -> None:
    writer = hanoi(at_text)
    text, editor = writer.text, writer.pane.editor
    line = writer.lines.index('        "State_bab": {')
    writer.mark('"State_bab": {', '"State_aab": {')
    writer.key(FOLD, CTRL | SHIFT)
    fold = editor.folds.at(line + 1)
    assert fold is not None
    count = fold.last - fold.first + 1
    words = editor.folds.words(fold, editor.sheet, "json")
    assert words == f"{count} lines folded: State_bab to State_aab"
    assert writer.lines[fold.last + 1].strip().startswith('"State_')
    assert len(seen(writer)) == len(writer.lines) - count + 1
    assert writer.text == text
    writer.key(UNFOLD, CTRL | SHIFT)
    assert len(seen(writer)) == len(writer.lines)


def test_the_arrow_in_the_gutter_folds_and_unfolds(at_text: At) -> None:
    writer = hanoi(at_text)
    editor = writer.pane.editor
    writer.go('"State_baa": {')
    line = editor.caret[0]
    top = next(top for row, top, _ in editor.rows() if row == line)
    at = QPoint(editor.gutter.width() - 10, int(top) + 6)
    QTest.mouseClick(editor.gutter, Qt.MouseButton.LeftButton, pos=at)
    assert editor.folds.at(line + 1) is not None
    QTest.mouseClick(editor.gutter, Qt.MouseButton.LeftButton, pos=at)
    assert not editor.folds.all


def test_the_caret_passes_over_a_fold(at_text: At) -> None:
    writer = hanoi(at_text)
    writer.go('"State_bab": {')
    line = writer.pane.editor.caret[0]
    writer.key(FOLD, CTRL | SHIFT)
    fold = writer.pane.editor.folds.all[0]
    writer.key(Qt.Key.Key_Down)
    assert writer.pane.editor.caret[0] == fold.last + 1
    writer.key(Qt.Key.Key_Up)
    assert writer.pane.editor.caret[0] == line


def test_what_leads_into_a_fold_unfolds_it(at_text: At) -> None:
    writer = hanoi(at_text)
    writer.pane.folding.fold_all()
    assert len(seen(writer)) < 10
    edge = Address("SB1", "State_cbb", "Op_1c")
    writer.pane.editor.clearFocus()
    writer.session.select([edge])
    assert not writer.pane.editor.folds.all
    assert writer.lines[writer.pane.editor.caret[0]].strip() == '"Op_1c": "State_bbb",'


def test_edits_in_and_above_a_fold_keep_what_is_folded(at_text: At) -> None:
    writer = hanoi(at_text)
    writer.go('"State_bab": {')
    writer.key(FOLD, CTRL | SHIFT)
    before = writer.pane.editor.folds.all[0]
    writer.pane.editor.clearFocus()
    writer.session.edit(
        "Rename", lambda bp: editing.rename(bp, Address("SB1", "State_aab"), "State_xxx")
    )
    assert writer.pane.editor.folds.all == [before]
    writer.go('"State_aaa": {')
    writer.key(Qt.Key.Key_Return)
    assert writer.pane.editor.folds.all[0].first == before.first + 1
    writer.session.edit("Delete", lambda bp: editing.delete(bp, [Address("SB1", "State_bab")]))
    assert not writer.pane.editor.folds.all
    assert len(seen(writer)) == len(writer.lines)
    assert "\n".join(writer.lines) == writer.text


def test_what_is_deleted_in_one_fold_opens_no_other(at_text: At) -> None:
    writer = at_text((SAMPLES / "hfsm.json").read_text("utf-8"), "hfsm.json")
    folds = writer.pane.editor.folds
    writer.pane.folding.fold_all()
    gone = [Address("SB1", "State110")]
    writer.session.edit("Delete State110", lambda bp: editing.delete(bp, gone))
    assert '"State110": {' not in writer.text
    last = folds.all[-1]
    assert [line for line in seen(writer) if last.first <= line <= last.last] == [last.first]
    hidden = sum(fold.last - fold.first for fold in folds.all)
    assert len(seen(writer)) == len(writer.lines) - hidden
    writer.session.history.undo()
    hidden = sum(fold.last - fold.first for fold in folds.all)
    assert len(seen(writer)) == len(writer.lines) - hidden
