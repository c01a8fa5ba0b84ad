"""The text of the rules, with line numbers and a mark at each line that cannot be read."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QRect, QRectF, QSize, Qt
from PySide6.QtGui import (
    QFocusEvent,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QTextCharFormat,
    QTextCursor,
)
from PySide6.QtWidgets import QPlainTextEdit, QTextEdit, QWidget

from smsl_studio.errors import TextFix
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.features.rules.word_list import WordList

MARK, GAP = 18, 8
"""The width of a mark, and the room beside the numbers (pixels)."""


_OF_LIST = (Qt.Key.Key_Escape, Qt.Key.Key_Tab, Qt.Key.Key_Return, Qt.Key.Key_Enter)
_HELD = (Qt.Key.Key_Shift, Qt.Key.Key_Control, Qt.Key.Key_Alt, Qt.Key.Key_AltGr)


def _asks(event: QKeyEvent) -> bool:
    held = event.modifiers() == Qt.KeyboardModifier.ControlModifier
    return event.key() == Qt.Key.Key_Space and held


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
        self.words = WordList(self)
        self._make_room()

    def event(self, event: QEvent) -> bool:
        """Keep Ctrl+Space, and the keys of the open list, from the window."""
        if event.type() is QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            listed = not self.words.isHidden() and event.key() in _OF_LIST
            if listed or _asks(event):
                event.accept()
                return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Offer what fits after Ctrl+Space, and narrow it with every key."""
        if _asks(event):
            self.words.ask()
            return
        if self.words.answer(event):
            return
        super().keyPressEvent(event)
        if self.words.isHidden():
            return
        if event.text() and (event.text().isprintable() or event.key() == Qt.Key.Key_Backspace):
            self.words.ask()
        elif event.key() not in _HELD:
            self.words.hide()

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Keep the keyboard while Tab takes a word."""
        return self.words.isHidden() and super().focusNextPrevChild(forward)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Close the list."""
        self.words.hide()
        super().focusOutEvent(event)

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

    def repair(self, fix: TextFix) -> None:
        """Apply a repair as one step that can be undone."""
        cursor = QTextCursor(self.document())
        # Qt counts letters outside the basic plane twice.
        start, end = (_places(self.toPlainText()[:at]) for at in (fix.start, fix.end))
        cursor.setPosition(start)
        cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
        cursor.insertText(fix.text)
        self.setTextCursor(cursor)
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


def _places(text: str) -> int:
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


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
