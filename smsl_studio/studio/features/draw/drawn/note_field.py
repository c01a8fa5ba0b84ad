"""A field for the words of a note, over the note on the canvas."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QMimeData, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from smsl_studio.blueprint.annotations import LONGEST
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.lines.box import gives_up, keeps
from smsl_studio.studio.base.overlays.text_card import TextCard
from smsl_studio.studio.base.theme import Tokens, text_font

WIDE, HIGH = 236, 104
TOO_LONG = f"A note has room for {LONGEST:,} characters. Put longer texts into a file."


class NoteBox(QPlainTextEdit):
    """The text of a note.

    Enter begins a new line. Ctrl+Enter and Esc emit ``done``, and Shift+Esc emits ``left``. The
    field never accepts a text that is too long for a note, so the text can always be kept.
    """

    done = Signal()
    left = Signal()
    refused = Signal()
    """There was no space for typed or pasted text."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setProperty("role", "field")
        self.setFont(text_font(12))
        self.setPlaceholderText("What should others know?")
        self.setAccessibleName("Note")
        self.setTabChangesFocus(True)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keep the text, leave it, or type."""
        if gives_up(event):
            self.left.emit()
        elif keeps(event):
            self.done.emit()
        elif not self._has_room(_typed(event)):
            self.refused.emit()
        else:
            super().keyPressEvent(event)

    def insertFromMimeData(self, source: QMimeData) -> None:
        """Paste a text, unless it is too long. Qt would lay out every line of it first."""
        if self._has_room(source.text()):
            super().insertFromMimeData(source)
        else:
            self.refused.emit()

    def _has_room(self, text: str) -> bool:
        """Whether the note has room for a text in place of the selected part."""
        if len(text) > LONGEST:
            return False
        kept = self.document().characterCount() - 1 - len(self.textCursor().selectedText())
        return kept + len(text) <= LONGEST


def _typed(event: QKeyEvent) -> str:
    """The text that a key adds. Empty for keys that move the caret or delete."""
    if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
        return "\n"
    return event.text() if event.text().isprintable() else ""


class NoteField(TextCard):
    """Edits the words of one note.

    ``commit`` takes the text and returns why it is refused, or the empty text. Ctrl+Enter commits.
    Esc and a click elsewhere commit too if the text was changed. Shift+Esc closes the field without
    an edit.
    """

    def __init__(
        self, parent: QWidget, tokens: Tokens, text: str, commit: Callable[[str], str]
    ) -> None:
        super().__init__(parent, tokens, commit)
        self._before = text
        self.field = NoteBox(self)
        self.field.setPlainText(text)
        self.field.selectAll()
        self.field.setFixedSize(WIDE, HIGH)
        self.hold(self.field)
        self.column.addWidget(label("Esc keeps the text, Shift+Esc drops it", "hint"))
        self.field.done.connect(self.settle)
        self.field.left.connect(self.close_field)
        self.field.refused.connect(lambda: self.complain(TOO_LONG))
        self.field.textChanged.connect(lambda: self.complain(""))

    def settle(self) -> None:
        """Commit a changed text; close the field unless that is refused."""
        if self.field.toPlainText() == self._before:
            self.close_field()
        else:
            self.commit()

    def commit(self) -> None:
        """Take the text over. If that is refused, show why and keep what was typed."""
        self.take(self.field.toPlainText())
