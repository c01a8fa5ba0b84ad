"""After any typing, drawing, undo and redo the pane shows the text of the session."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st
from PySide6.QtGui import QTextCursor
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source.pane import SourcePane
from tests.studio.features.draw.source.conftest import HFSM, read

TEXTS = (HFSM, "\ufeff" + HFSM.replace("\n", "\r\n"), HFSM.replace('"Op_1"', '"O\u2028p 𝛼"'))
TYPED = st.sampled_from(["x", "\n", '"', "}", ', "State_7": {}', "", "𝛼"])
DEEDS = st.one_of(
    st.tuples(st.just("type"), st.integers(0, 260), st.integers(0, 6), TYPED),
    st.tuples(st.sampled_from(["draw", "undo", "redo", "settle", "fold", "unfold"])),
)


@settings(max_examples=25)
@given(st.sampled_from(TEXTS), st.lists(DEEDS, max_size=14))
def test_the_pane_shows_the_text_of_the_session(
    qapp: QApplication, text: str, deeds: list[tuple[str, int, int, str]]
) -> None:
    session = Session(read(text))
    pane = SourcePane(session, LIGHT)
    pane.show()
    for number, deed in enumerate(deeds):
        _do(session, pane, deed, number)
        pane.settle()
        _agree(session, pane)
    session.history.setIndex(0)
    _agree(session, pane)
    assert pane.editor.sheet.text == text
    pane.close()
    pane.deleteLater()


def _do(session: Session, pane: SourcePane, deed: tuple[str, int, int, str], number: int) -> None:
    kind, editor = deed[0], pane.editor
    if kind == "type":
        cursor = QTextCursor(editor.document())
        # As an arrow key goes: never into a character of two units.
        cursor.movePosition(cursor.MoveOperation.Right, cursor.MoveMode.MoveAnchor, deed[1])
        cursor.movePosition(cursor.MoveOperation.Right, cursor.MoveMode.KeepAnchor, deed[2])
        cursor.insertText(deed[3])
    elif kind == "draw":
        session.edit("Draw", lambda bp: editing.add_state(bp, "SB1", f"New_{number}"))
    elif kind in ("undo", "redo"):
        getattr(pane, kind)()
    elif kind == "fold":
        pane.folding.fold_all()
    elif kind == "unfold":
        pane.folding.unfold_all()


def _agree(session: Session, pane: SourcePane) -> None:
    document, sheet = pane.editor.document(), pane.editor.sheet
    blocks = [document.findBlockByNumber(at).text() for at in range(document.blockCount())]
    assert sheet.text == session.texts["a.json"]
    assert sheet.shown.split("\n") == blocks
    shown = [document.findBlockByNumber(at).isVisible() for at in range(document.blockCount())]
    hidden = {at for fold in pane.editor.folds.all for at in range(fold.first + 1, fold.last + 1)}
    assert {at for at, visible in enumerate(shown) if not visible} == hidden
