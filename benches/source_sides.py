"""The two sides of the bench of the source pane: ours, and Qt's bare text widget."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QPlainTextEdit

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.source.pane import SourcePane

WORD = '"Op_1"'


class Ours:
    """The source pane with a text. The caret is in its middle."""

    def __init__(self, text: str, size: tuple[int, int]) -> None:
        self._text, self._size = text, size
        self._session = Session(read_blueprint(form_named("json").parse(text, "a.json")))
        self._pane = SourcePane(self._session, LIGHT)
        self._pane.resize(*size)

    @property
    def text(self) -> str:
        return self._pane.editor.sheet.text

    def open(self) -> None:
        """Make and show another pane."""
        pane = SourcePane(self._session, LIGHT)
        pane.resize(*self._size)
        pane.show()
        pane.grab()
        pane.close()
        pane.deleteLater()

    def show(self) -> None:
        self._pane.show()
        self._pane.editor.set_caret(_middle(self._text))
        self._pane.grab()

    def key(self) -> None:
        """Type a letter, and repaint the text and its gutter."""
        _press(self._pane.editor)
        self._pane.editor.gutter.repaint()

    def names(self) -> None:
        """Make the list of names that fit here."""
        self._pane.popup.ask()

    def forget(self) -> None:
        """Show the text as it was before the keys."""
        self._pane.popup.hide()
        self._pane.typing.forget()
        self._pane.editor.load(self._text)

    def edit(self) -> None:
        """Make an edit from the canvas, patch it into the text, and paint."""
        state = next(reversed(self._session.blueprint["SB1"].table))
        address = Address("SB1", state)
        self._session.edit("Rename", lambda bp: editing.rename(bp, address, f"{state}1"))
        self._pane.editor.viewport().repaint()

    def close(self) -> None:
        self._pane.typing.stop()
        self._pane.close()


class Bare:
    """Qt's text widget with the same text. Other editors in Qt are based on it."""

    def __init__(self, text: str, size: tuple[int, int]) -> None:
        self._edit = QPlainTextEdit()
        self._edit.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._edit.setUndoRedoEnabled(False)
        self._edit.resize(*size)
        self._edit.setPlainText(text)
        self._at = _middle(text)

    @property
    def text(self) -> str:
        return self._edit.toPlainText()

    def show(self) -> None:
        self._edit.show()
        cursor = self._edit.textCursor()
        cursor.setPosition(self._at)
        self._edit.setTextCursor(cursor)
        self._edit.grab()

    def key(self) -> None:
        """Type a letter, and repaint the text."""
        _press(self._edit)

    def close(self) -> None:
        self._edit.close()


def _middle(text: str) -> int:
    return text.index(WORD, len(text) // 2) + 4


def _press(edit: QPlainTextEdit) -> None:
    event = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_X, Qt.KeyboardModifier.NoModifier, "x")
    QApplication.sendEvent(edit, event)
    edit.viewport().repaint()
