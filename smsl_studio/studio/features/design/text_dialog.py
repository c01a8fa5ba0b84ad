"""A text of the consultation, opened at a line that is cited."""

from __future__ import annotations

from PySide6.QtGui import QTextCharFormat, QTextCursor
from PySide6.QtWidgets import QDialog, QPlainTextEdit, QPushButton, QTextEdit, QVBoxLayout, QWidget

from smsl_studio.generate.text.expert_text import ExpertText
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens, mono_font


class TextDialog(QDialog):
    """Shows a text with the numbers of its lines. It can only be read."""

    def __init__(self, text: ExpertText, where: str, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._text, self._tokens = text, tokens
        self.setWindowTitle(plain_text(text.file))
        self.place = Elided(where)
        self.place.setProperty("role", "small")
        self.lines = QPlainTextEdit()
        self.lines.setReadOnly(True)
        self.lines.setFont(mono_font(12))
        self.lines.setAccessibleName("Text")
        self.lines.setLineWrapMode(QPlainTextEdit.LineWrapMode.WidgetWidth)
        self.lines.setPlainText(plain_lines(text))
        done = QPushButton("Close")
        done.clicked.connect(self.accept)
        column = QVBoxLayout(self)
        column.addWidget(self.place)
        column.addWidget(self.lines, 1)
        column.addLayout(row(None, done))
        open_at(self, 640, 480)

    def go_to(self, line: int, page: int) -> None:
        """Mark a line (of a page, in a PDF) and scroll to it."""
        at = next(
            (n for n, one in enumerate(self._text.lines) if (one.number, one.page) == (line, page)),
            0,
        )
        cursor = QTextCursor(self.lines.document().findBlockByNumber(at))
        ground = QTextCharFormat()
        ground.setBackground(self._tokens.accs)
        ground.setForeground(self._tokens.tx)
        ground.setProperty(QTextCharFormat.Property.FullWidthSelection, True)
        marked = QTextEdit.ExtraSelection()
        marked.cursor, marked.format = cursor, ground
        self.lines.setExtraSelections([marked])
        self.lines.setTextCursor(cursor)
        self.lines.centerCursor()

    @property
    def marked(self) -> str:
        """The line that is marked."""
        return self.lines.textCursor().block().text()


def plain_lines(text: ExpertText) -> str:
    """Return the lines with their numbers, and with their pages in a PDF."""
    told = []
    for line in text.lines:
        page = f"{line.page}." if line.page else ""
        told.append(f"{page}{line.number:>3}  {plain_text(line.text)}")
    return "\n".join(told)
