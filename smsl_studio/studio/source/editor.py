"""Editor: the text of one file in a text widget, and exactly what stands in the file behind it.

Whoever types changes the widget, and the sheet follows; whoever changes the text from elsewhere
(the canvas, a fix, a replacement) puts it into the sheet, and the widget shows what differs. So
neither a keystroke nor an edit ever sets the whole text anew, and caret and scroll stay.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QPoint, QRect, QRectF, Qt, Signal
from PySide6.QtGui import (
    QFocusEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QTextCursor,
    QWheelEvent,
)
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from smsl_studio.studio.source.colours import Colours
from smsl_studio.studio.source.folds import Folds
from smsl_studio.studio.source.gutter import Gutter
from smsl_studio.studio.source.patches import Patch, common_prefix, common_suffix
from smsl_studio.studio.source.sheet import Sheet
from smsl_studio.studio.source.spelling import from_units, units
from smsl_studio.studio.theme import Tokens, mono_font, text_font

SIZE, SMALLEST, LARGEST = 12, 8, 32
TOGETHER = 300
"""Patches from which on they are made as one."""


class Editor(QPlainTextEdit):
    """The text itself. Lines and columns are those shown, from 0, counted in characters."""

    typed = Signal(int)
    """The text was changed by hand; in which line."""
    caret_moved = Signal()
    clicked = Signal(QPoint)
    """A click that marked nothing; where."""
    called = Signal(QPoint)
    """A click with Ctrl held: where what stands there is defined."""
    left = Signal()
    """The focus goes elsewhere."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.sheet = Sheet()
        self.form = "json"
        self._own, self._blocks, self._caret_line, self._size = False, 1, 0, SIZE
        self.setAccessibleName("Source text")
        self.setUndoRedoEnabled(False)
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.setFont(mono_font(SIZE))
        self.document().setDocumentMargin(2)
        self.folds = Folds(self)
        self.colours = Colours(self, tokens)
        self.gutter = Gutter(self)
        self.document().contentsChange.connect(self._contents_changed)
        self.blockCountChanged.connect(self._place_gutter)
        self.updateRequest.connect(self._scroll_gutter)
        self.cursorPositionChanged.connect(self._keep_caret_out_of_folds)
        self.cursorPositionChanged.connect(self.caret_moved)

    def set_tokens(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.colours.set_tokens(tokens)
        self.viewport().update()
        self.gutter.update()

    def set_writable(self, writable: bool) -> None:
        """Whether one may type; the text can always be marked and copied."""
        flags = Qt.TextInteractionFlag.TextEditorInteraction
        if not writable:
            flags = (
                Qt.TextInteractionFlag.TextSelectableByMouse
                | Qt.TextInteractionFlag.TextSelectableByKeyboard
            )
        if self.textInteractionFlags() != flags:
            self.setReadOnly(not writable)
            self.setTextInteractionFlags(flags)

    # The text.

    def set_form(self, form: str) -> None:
        """The written form of the text."""
        self.form = form
        self.colours.set_form(form)

    def load(self, text: str) -> None:
        """Show another text from its beginning."""
        self.folds.all.clear()
        self.sheet = Sheet(text)
        self._own = True
        self.setPlainText(self.sheet.shown)
        self._own = False
        self._blocks = self.blockCount()

    def apply(self, patches: Sequence[Patch]) -> None:
        """Replace parts of the text, the last one first; what is seen stays where it is."""
        if len(patches) > TOGETHER:
            patches = [_joined(self.sheet.text, patches)]
        top = self.firstVisibleBlock()
        for start, end, part in patches:
            first, old, new = self.sheet.put(start, end, part)
            self._show(first, old, new)
        if top.isValid() and top.isVisible() and self.verticalScrollBar().value():
            self.verticalScrollBar().setValue(top.firstLineNumber())

    def _show(self, first: int, old: list[str], new: list[str]) -> None:
        before, after = "\n".join(old), "\n".join(new)
        head = common_prefix(before, after)
        tail = common_suffix(before, after, min(len(before), len(after)) - head)
        if len(before) == len(after) == head:
            return
        base = self.document().findBlockByNumber(first).position()
        cursor = QTextCursor(self.document())
        cursor.setPosition(base + units(before[:head]))
        end = base + units(before[: len(before) - tail])
        cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
        self._own = True
        cursor.insertText(after[head : len(after) - tail])
        self._own = False

    def replace(self, start: int, end: int, part: str, caret: int | None = None) -> None:
        """Replace, as if typed, what stands between two offsets; then put the caret somewhere."""
        line = self.sheet.where(start)[0]
        self.apply([(start, end, part)])
        if caret is not None:
            self.set_caret(caret)
        self.typed.emit(line)

    def _contents_changed(self, position: int, _removed: int, added: int) -> None:
        document = self.document()
        block = document.findBlock(position)
        if not block.isValid():
            block = document.lastBlock()
        last = document.findBlock(min(position + added, document.characterCount() - 1))
        end = last.blockNumber() if last.isValid() else self.blockCount() - 1
        first, grown = block.blockNumber(), self.blockCount() - self._blocks
        self._blocks = self.blockCount()
        self.colours.forget(block, end)
        self.folds.changed(first, end - first + 1 - grown, end - first + 1)
        if self._own:
            return
        column = from_units(block.text(), position - block.position())
        lines = []
        while block.isValid() and block.blockNumber() <= end:
            lines.append(block.text())
            block = block.next()
        if self.sheet.typed(first, end - grown, lines, column):
            self.typed.emit(first)

    # Caret and places.

    @property
    def caret(self) -> tuple[int, int]:
        """The line and column of the caret."""
        return self.place_of(self.textCursor())

    @property
    def marked(self) -> tuple[int, int]:
        """The offsets in the exact text between which it is marked."""
        cursor, ends = self.textCursor(), []
        for at in (cursor.selectionStart(), cursor.selectionEnd()):
            block = self.document().findBlock(at)
            column = from_units(block.text(), at - block.position())
            ends.append(self.sheet.offset(block.blockNumber(), column))
        return ends[0], ends[1]

    def place_of(self, cursor: QTextCursor) -> tuple[int, int]:
        """The line and column of a text cursor."""
        block = cursor.block()
        return block.blockNumber(), from_units(block.text(), cursor.positionInBlock())

    def cursor_at(self, start: int, end: int | None = None) -> QTextCursor:
        """A text cursor at an offset of the exact text, or from one to another."""
        cursor = QTextCursor(self.document())
        cursor.setPosition(self._position(start))
        if end is not None:
            cursor.setPosition(self._position(end), QTextCursor.MoveMode.KeepAnchor)
        return cursor

    def set_caret(self, start: int, end: int | None = None) -> None:
        """Put the caret at an offset, or mark up to another one; folds give way."""
        for offset in (start, start if end is None else end):
            self.folds.reveal(self.sheet.where(offset)[0])
        self.setTextCursor(self.cursor_at(start, end))

    def reveal(self, line: int) -> None:
        """Put the caret at the beginning of a line, and show it."""
        self.folds.reveal(line)
        self.setTextCursor(QTextCursor(self.document().findBlockByNumber(line)))
        self.bring_into_view(line)

    def bring_into_view(self, line: int) -> None:
        """Scroll, if a line is not well in view, so that it is in the middle."""
        rows = [row for row, _, _ in self.rows()]
        if line not in rows[2 if rows[:1] != [0] else 0 : -2]:
            self.centerCursor()

    def _position(self, offset: int) -> int:
        line, column = self.sheet.where(offset)
        block = self.document().findBlockByNumber(line)
        return block.position() + units(block.text()[:column])

    def _keep_caret_out_of_folds(self) -> None:
        """The caret passes over a fold as over one line."""
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

    # What is seen.

    def rows(self) -> Iterator[tuple[int, float, float]]:
        """The lines in view: number, top and height in pixels."""
        block = self.firstVisibleBlock()
        top = self.blockBoundingGeometry(block).translated(self.contentOffset()).top()
        while block.isValid() and top <= self.viewport().height():
            height = self.blockBoundingRect(block).height()
            if block.isVisible():
                yield block.blockNumber(), top, height
                top += height
            block = block.next()

    def row_at(self, y: float) -> int | None:
        """The line at a height in pixels."""
        return next((line for line, top, high in self.rows() if top <= y < top + high), None)

    def place_at(self, at: QPoint) -> tuple[int, int] | None:
        """The line and column under a point; None where no text is."""
        cursor = self.cursorForPosition(at)
        beyond = at.x() > self.cursorRect(cursor).right() + self.fontMetrics().averageCharWidth()
        below = self.row_at(at.y()) is None
        return None if below or (beyond and cursor.atBlockEnd()) else self.place_of(cursor)

    def paintEvent(self, event: QPaintEvent) -> None:
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
                painter.drawText(band.adjusted(16, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, words)
        painter.end()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.left.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        line = self.row_at(event.position().y())
        fold = self.folds.at(line) if line is not None else None
        if fold is not None and event.button() is Qt.MouseButton.LeftButton:
            self.folds.unfold(fold)
            return
        super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        if event.button() is Qt.MouseButton.LeftButton and not self.textCursor().hasSelection():
            control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            (self.called if control else self.clicked).emit(event.position().toPoint())

    def wheelEvent(self, event: QWheelEvent) -> None:
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            step = (event.angleDelta().y() > 0) - (event.angleDelta().y() < 0)
            self._size = max(SMALLEST, min(LARGEST, self._size + step))
            self.setFont(mono_font(self._size))
            self._place_gutter()
            event.accept()
            return
        super().wheelEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_gutter()

    def _place_gutter(self, _: int = 0) -> None:
        wide = self.gutter.needed()
        self.setViewportMargins(wide, 0, 0, 0)
        inside = self.contentsRect()
        self.gutter.setGeometry(QRect(inside.left(), inside.top(), wide + 3, inside.height()))

    def _scroll_gutter(self, rect: QRect, down: int) -> None:
        if down:
            self.gutter.scroll(0, down)
        else:
            self.gutter.update(0, rect.y(), self.gutter.width(), rect.height())


def _joined(text: str, patches: Sequence[Patch]) -> Patch:
    """Several patches, the last one first, as one that spans them all."""
    parts: list[str] = []
    first, last = patches[-1][0], patches[0][1]
    at = first
    for start, end, part in reversed(patches):
        parts += [text[at:start], part]
        at = end
    return first, last, "".join(parts)
