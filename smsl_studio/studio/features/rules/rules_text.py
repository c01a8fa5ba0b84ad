"""The text of the rules, with line numbers and a mark at each line that cannot be read."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QRect, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import QPlainTextEdit, QTextEdit, QWidget

from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.theme import Tokens, mono_font

MARK, GAP = 18, 8
"""The width of a mark, and the room beside the numbers (pixels)."""


class RulesText(QPlainTextEdit):
    """A text widget. Lines are counted from 1."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._faults: Mapping[int, str] = {}
        self._numbers = _Numbers(self)
        self.setFont(mono_font(13))
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.setTabChangesFocus(True)
        self.setAccessibleName("Rules")
        self.setProperty("role", "source")
        self.blockCountChanged.connect(lambda _: self._make_room())
        self.updateRequest.connect(self._scrolled)
        self.cursorPositionChanged.connect(self._mark_lines)
        self._make_room()

    @property
    def caret(self) -> tuple[int, int]:
        """Line and column of the caret, from 1."""
        cursor = self.textCursor()
        return cursor.blockNumber() + 1, cursor.positionInBlock() + 1

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._mark_lines()
        self._numbers.update()

    def show_faults(self, faults: Mapping[int, str]) -> None:
        """Mark these lines. Each has a sentence."""
        self._faults = faults
        self._mark_lines()
        self._numbers.update()

    def go_to(self, line: int) -> None:
        """Put the caret at the beginning of a line, and bring it into view."""
        block = self.document().findBlockByNumber(line - 1)
        if block.isValid():
            self.setTextCursor(QTextCursor(block))
            self.centerCursor()
        self.setFocus()

    def replace_all(self, text: str) -> None:
        """Replace the whole text as one step that can be undone."""
        cursor = QTextCursor(self.document())
        cursor.select(QTextCursor.SelectionType.Document)
        cursor.insertText(text)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the numbers at the left side."""
        super().resizeEvent(event)
        inner = self.contentsRect()
        wide = self._numbers.sizeHint().width()
        self._numbers.setGeometry(QRect(inner.left(), inner.top(), wide, inner.height()))

    def paint_numbers(self, painter: QPainter, wide: int) -> None:
        """Paint the numbers of the lines in view, and the marks."""
        block = self.firstVisibleBlock()
        top = self.blockBoundingGeometry(block).translated(self.contentOffset()).top()
        painter.setFont(self.font())
        while block.isValid() and top <= self.viewport().height():
            high = self.blockBoundingRect(block).height()
            line = block.blockNumber() + 1
            bad = line in self._faults
            colour = severity_colour("E", self._tokens) if bad else self._tokens.tx3
            if bad:
                box = QRectF(2, top + (high - 13) / 2, 13, 13)
                draw(painter, SEVERITY_ICON["E"], box, colour, self._tokens.surf)
            painter.setPen(colour)
            room = QRectF(MARK, top, wide - MARK - GAP, high)
            painter.drawText(room, Qt.AlignmentFlag.AlignRight, str(line))
            top += high
            block = block.next()

    def _make_room(self) -> None:
        self.setViewportMargins(self._numbers.sizeHint().width(), 0, 0, 0)
        self._numbers.updateGeometry()

    def _scrolled(self, rect: QRect, down: int) -> None:
        if down:
            self._numbers.scroll(0, down)
        else:
            self._numbers.update(0, rect.y(), self._numbers.width(), rect.height())

    def _mark_lines(self) -> None:
        here = self._band(self.textCursor().blockNumber(), "accs")
        self.setExtraSelections([here, *(self._band(line - 1, "bads") for line in self._faults)])

    def _band(self, number: int, token: str) -> QTextEdit.ExtraSelection:
        band = QTextEdit.ExtraSelection()
        look = QTextCharFormat()
        look.setBackground(getattr(self._tokens, token))
        look.setProperty(QTextCharFormat.Property.FullWidthSelection, True)
        band.format = look
        cursor = QTextCursor(self.document().findBlockByNumber(number))
        band.cursor = cursor
        return band


class _Numbers(QWidget):
    """The column at the left of the text."""

    def __init__(self, text: RulesText) -> None:
        super().__init__(text)
        self._text = text
        self.setAccessibleName("Line numbers")

    def sizeHint(self) -> QSize:
        """As wide as the largest number and a mark need."""
        digits = max(3, len(str(self._text.blockCount())))
        return QSize(MARK + GAP + self._text.fontMetrics().horizontalAdvance("0") * digits, 0)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the numbers in view."""
        painter = QPainter(self)
        painter.fillRect(event.rect(), self._text.palette().base())
        self._text.paint_numbers(painter, self.width())
        painter.end()
