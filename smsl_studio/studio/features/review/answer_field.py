"""The field in which a person writes a comment, a reply or a note, at the line that it is about."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QTextCursor
from PySide6.QtWidgets import QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from smsl_studio.inspection.review.review_file import LONGEST
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, row

_RETURN = (Qt.Key.Key_Return, Qt.Key.Key_Enter)


class AnswerField(QWidget):
    """A text of several lines. Ctrl+Enter keeps it, Escape leaves it."""

    given = Signal(str)
    left = Signal()

    def __init__(self, question: str, verb: str) -> None:
        super().__init__()
        self.text = _Text(self)
        self.text.setProperty("role", "field")
        self.text.setAccessibleName(plain_text(question))
        self.text.setPlaceholderText(plain_text(question))
        self.text.setTabChangesFocus(True)
        self.text.setFixedHeight(84)
        self.keep = QPushButton(verb)
        self.keep.setProperty("role", "primary")
        self.keep.setEnabled(False)
        self.cancel = QPushButton("Cancel")
        # Shortened where it has no room, so that it never makes the line wider than the page. The
        # words are short enough for the lowest window.
        hint = Elided("Ctrl+Enter")
        hint.setProperty("role", "readSmall")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 4, 0, 0)
        column.addWidget(self.text)
        last = row(self.keep, self.cancel, hint)
        last.setStretch(2, 1)
        column.addLayout(last)
        self.text.textChanged.connect(self._typed)
        self.keep.clicked.connect(self.give)
        self.cancel.clicked.connect(self.left)

    def give(self) -> None:
        """Hand over what is written, if there is something."""
        text = self.written.strip()
        if text:
            self.given.emit(text[:LONGEST])

    @property
    def written(self) -> str:
        """The text so far."""
        return self.text.toPlainText()

    def begin(self, text: str) -> None:
        """Show a text that was begun before, with the cursor behind it."""
        self.text.setPlainText(text)
        self.text.moveCursor(QTextCursor.MoveOperation.End)

    def stand_as(self, other: AnswerField) -> None:
        """Put the cursor, and what is marked, where they are in another field of the same text."""
        if self.written != other.written:
            return
        theirs, mine = other.text.textCursor(), self.text.textCursor()
        mine.setPosition(theirs.anchor())
        mine.setPosition(theirs.position(), QTextCursor.MoveMode.KeepAnchor)
        self.text.setTextCursor(mine)

    def _typed(self) -> None:
        self.keep.setEnabled(bool(self.written.strip()))


class _Text(QPlainTextEdit):
    def __init__(self, field: AnswerField) -> None:
        super().__init__()
        self._field = field

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keep the text, leave it, or type."""
        if event.key() == Qt.Key.Key_Escape:
            self._field.left.emit()
        elif event.key() in _RETURN and event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self._field.give()
        else:
            super().keyPressEvent(event)
