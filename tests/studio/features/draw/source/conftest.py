"""Fixtures: a source pane with a text, and hands that type keys."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.forms import form_named, form_of
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source.pane import SourcePane

HFSM = """{
    "SB1": {
        "HEADER": {"INITIAL": "State_0"},
        "State_0": {
            "Op_1": "State_1",
            "Op_2": "State_2"
        },
        "State_1": {},
        "State_2": {"Back": "State_0"}
    }
}
"""
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
ALT, NONE = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.NoModifier


def read(text: str, file: str = "a.json") -> Blueprint:
    return read_blueprint(form_named(form_of(file, text)).parse(text, file))


@dataclass
class Writer:
    """Somebody at a source pane."""

    pane: SourcePane
    session: Session
    qtbot: QtBot

    @property
    def text(self) -> str:
        """The exact text."""
        return self.pane.editor.sheet.text

    @property
    def lines(self) -> list[str]:
        """What the widget shows."""
        document = self.pane.editor.document()
        return [document.findBlockByNumber(at).text() for at in range(document.blockCount())]

    @property
    def words(self) -> list[str]:
        """The words of every step."""
        history = self.session.history
        return [history.text(at) for at in range(history.count())]

    def go(self, word: str, behind: bool = True, nth: int = 0) -> None:
        """Put the caret behind (or before) a word of the text."""
        at = -1
        for _ in range(nth + 1):
            at = self.text.index(word, at + 1)
        self.pane.editor.set_caret(at + len(word) if behind else at)

    def mark(self, start: str, end: str) -> None:
        """Mark from the beginning of one word to the end of another."""
        first = self.text.index(start)
        self.pane.editor.set_caret(first, self.text.index(end, first) + len(end))

    def type(self, text: str) -> None:
        QTest.keyClicks(self.pane.editor, text)

    def key(self, key: Qt.Key, held: Qt.KeyboardModifier = NONE) -> None:
        QTest.keyClick(self.pane.editor, key, held)

    def until(self, condition: Callable[[], bool]) -> None:
        self.qtbot.waitUntil(condition, timeout=5000)

    def states(self, branch: str = "SB1") -> Sequence[str]:
        return list(self.session.blueprint[branch].table)


@pytest.fixture
def at_text(qtbot: QtBot, qapp: QApplication) -> Iterator[Callable[..., Writer]]:
    """Open a text in a pane and put the focus there."""
    made: list[SourcePane] = []

    def open_on(text: str = HFSM, file: str = "a.json", session: Session | None = None) -> Writer:
        session = session or Session(read(text, file))
        pane = SourcePane(session, LIGHT)
        made.append(pane)
        pane.resize(364, 600)
        pane.show()
        pane.activateWindow()
        qtbot.waitUntil(pane.isActiveWindow)
        pane.setFocus()
        qtbot.waitUntil(pane.editor.hasFocus)
        return Writer(pane, session, qtbot)

    yield open_on
    for pane in made:
        pane.typing.stop()
        pane.close()
        pane.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
