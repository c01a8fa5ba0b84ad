"""The look of the text: rows, gutter, colours, folds and font size.

``Editor`` adds the text itself and its changes.
"""

from __future__ import annotations

from PySide6.QtCore import QRect, QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent, QTextCursor, QWheelEvent
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.features.draw.source.colours import Colours
from smsl_studio.studio.features.draw.source.gutter import Gutter
from smsl_studio.studio.features.draw.source.text_rows import TextRows

SIZE, SMALLEST, LARGEST = 12, 8, 32


class TextSurface(TextRows):
    """A text with its gutter, its colours and its folds."""

    reshaped = Signal()
    """Lines have moved, or the width for them has changed."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(tokens, parent)
        self.form = "json"
        self._caret_line, self._size = 0, SIZE
        self.setUndoRedoEnabled(False)
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.setFont(mono_font(SIZE))
        self.document().setDocumentMargin(2)
        # Keep brackets in order in lines that begin with a right-to-left name.
        option = self.document().defaultTextOption()
        option.setTextDirection(Qt.LayoutDirection.LeftToRight)
        self.document().setDefaultTextOption(option)
        self.colours = Colours(self, tokens)
        self.gutter = Gutter(self)
        self.blockCountChanged.connect(self._place_gutter)
        self.updateRequest.connect(self._scroll_gutter)
        self.cursorPositionChanged.connect(self._keep_caret_out_of_folds)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        self.colours.set_tokens(tokens)
        self.viewport().update()
        self.gutter.update()

    def set_form(self, form: str) -> None:
        """Set the written form of the text (json, smsl or yaml)."""
        self.form = form
        self.colours.set_form(form)

    def fold(self, first: int, last: int) -> None:
        """Fold some lines; a caret in them moves to the line before."""
        cursor = self.textCursor()
        blocks = [self.document().findBlock(at).blockNumber()
                  for at in (cursor.selectionStart(), cursor.selectionEnd())]  # fmt: skip
        if any(first <= one <= last for one in blocks):
            block = self.document().findBlockByNumber(first - 1)
            cursor.setPosition(block.position() + block.length() - 1)
            self.setTextCursor(cursor)
        self.folds.fold(first, last)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Colour the visible blocks, then paint the text and the folds."""
        high = max(1, int(self.fontMetrics().height()))
        self.colours.dress(self.firstVisibleBlock(), self.viewport().height() // high + 2)
        super().paintEvent(event)
        if self.folds.all:
            self._paint_folds()

    def _paint_folds(self) -> None:
        painter = QPainter(self.viewport())
        painter.setFont(text_font(self._size))
        for line, top, height in self.rows():
            fold = self.folds.at(line)
            if fold is not None:
                band = QRectF(0, top, self.viewport().width(), height)
                painter.fillRect(band, self.tokens.sunk)
                painter.setPen(self.tokens.tx2)
                words = self.folds.words(fold, self.sheet, self.form)
                painter.drawText(
                    band.adjusted(16, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, plain_text(words)
                )
        painter.end()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """With Ctrl, change the font size; else scroll."""
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            step = (event.angleDelta().y() > 0) - (event.angleDelta().y() < 0)
            self._size = max(SMALLEST, min(LARGEST, self._size + step))
            self.setFont(mono_font(self._size))
            self._place_gutter()
            event.accept()
            return
        super().wheelEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the gutter again."""
        super().resizeEvent(event)
        self._place_gutter()

    def _place_gutter(self, _: int = 0) -> None:
        wide = self.gutter.needed()
        self.setViewportMargins(wide, 0, 0, 0)
        inside = self.contentsRect()
        self.gutter.setGeometry(QRect(inside.left(), inside.top(), wide + 3, inside.height()))
        self.reshaped.emit()

    def _scroll_gutter(self, rect: QRect, down: int) -> None:
        if down:
            self.gutter.scroll(0, down)
        else:
            self.gutter.update(0, rect.y(), self.gutter.width(), rect.height())

    def _keep_caret_out_of_folds(self) -> None:
        """Move the caret over a fold as over one line."""
        line, before = self.textCursor().blockNumber(), self._caret_line
        fold = self.folds.at(line)
        if fold is not None:
            down = before < fold.first and fold.last + 1 < self.blockCount()
            block = self.document().findBlockByNumber(fold.last + 1 if down else fold.first - 1)
            cursor = self.textCursor()
            keep = QTextCursor.MoveMode.KeepAnchor if cursor.hasSelection() else None
            cursor.setPosition(block.position(), keep or QTextCursor.MoveMode.MoveAnchor)
            line = block.blockNumber()
            self._caret_line = line
            self.setTextCursor(cursor)
        self._caret_line = line
