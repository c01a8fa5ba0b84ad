"""The editor: the text of one file in a text widget, and the exact text of the file behind it.

Typing changes the widget, and the sheet follows. Edits from elsewhere (the canvas, a fix, a
replacement) change the sheet, and the widget shows the difference. So neither a keystroke nor an
edit sets the whole text anew, and caret and scroll position stay.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QEvent, QMimeData, QPoint, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QDragLeaveEvent,
    QDropEvent,
    QFocusEvent,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QTextCursor,
)
from PySide6.QtWidgets import QToolTip, QWidget

from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.source.key_owner import Keys
from smsl_studio.studio.features.draw.source.patches import (
    Patch,
    common_prefix,
    common_suffix,
    joined,
)
from smsl_studio.studio.features.draw.source.sheet import TextSheet
from smsl_studio.studio.features.draw.source.shown_text import from_units, units
from smsl_studio.studio.features.draw.source.surface import TextSurface

TOGETHER = 300
"""More patches than this are joined to one."""


class Editor(TextSurface):
    """The text widget. Lines and columns are those shown, from 0, counted in characters."""

    starting = Signal()
    """A command is about to change the text; text typed before becomes a step of its own."""
    typed = Signal(str)
    """str: the person changed the text; the words of the undo step."""
    caret_moved = Signal()
    clicked = Signal(QPoint)
    """QPoint: a click without a selection, in pixels of the viewport."""
    called = Signal(QPoint)
    """QPoint: a click with Ctrl, which asks for the definition of the name there."""
    menu_wanted = Signal(QPoint, QPoint)
    """(point in the viewport, point on the screen): the context menu is wanted."""
    entered = Signal()
    """The text got the keyboard focus."""
    left = Signal()
    """The text lost the keyboard focus."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(tokens, parent)
        self._own, self._blocks = False, 1
        self.keys: Keys | None = None
        self.words_at: Callable[[int, int], str] = lambda line, column: ""
        self.setAccessibleName("Source text")
        self.document().contentsChange.connect(self._contents_changed)
        self.cursorPositionChanged.connect(self.caret_moved)

    def set_writable(self, writable: bool) -> None:
        """Set whether the text can be edited; it can always be selected and copied."""
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

    def load(self, text: str) -> None:
        """Show another text from its beginning."""
        self.folds.all.clear()
        self.sheet = TextSheet(text)
        self._own = True
        self.setPlainText(self.sheet.shown)
        self._own = False
        self._blocks = self.blockCount()

    def apply(self, patches: Sequence[Patch]) -> None:
        """Replace parts of the text, the last one first. The scroll position stays."""
        if len(patches) > TOGETHER:
            patches = [joined(self.sheet.text, patches)]
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

    def begin_command(self) -> None:
        """Emit ``starting``: the next change is not part of what was typed before."""
        self.starting.emit()

    def replace(
        self, start: int, end: int, part: str, words: str, caret: int | None = None
    ) -> None:
        """Replace the text between two offsets as if typed, and put the caret at an offset."""
        self.apply([(start, end, part)])
        if caret is not None:
            self.set_caret(caret)
        self.typed.emit(words)

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
            self.typed.emit(f"Type in line {self.sheet.line_of(first) + 1}")

    # Caret and places.

    @property
    def caret(self) -> tuple[int, int]:
        """The line and column of the caret."""
        return self.place_of(self.textCursor())

    @property
    def marked(self) -> tuple[int, int]:
        """The start and end of the selection, as offsets in the exact text."""
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
        """A text cursor at an offset of the exact text, or a selection up to another offset."""
        cursor = QTextCursor(self.document())
        cursor.setPosition(self._position(start))
        if end is not None:
            cursor.setPosition(self._position(end), QTextCursor.MoveMode.KeepAnchor)
        return cursor

    def set_caret(self, start: int, end: int | None = None) -> None:
        """Put the caret at an offset, or select up to another one; folds there are opened."""
        for offset in (start, start if end is None else end):
            self.folds.reveal(self.sheet.where(offset)[0])
        self.setTextCursor(self.cursor_at(start, end))

    def reveal(self, line: int) -> None:
        """Put the caret at the beginning of a line, and scroll to it."""
        self.folds.reveal(line)
        self.setTextCursor(QTextCursor(self.document().findBlockByNumber(line)))
        self.bring_into_view(line)

    def bring_into_view(self, line: int) -> None:
        """Centre a line, if it is not well inside the view."""
        rows = [row for row, _, _ in self.rows()]
        if line not in rows[2 if rows[:1] != [0] else 0 : -2]:
            self.centerCursor()

    def place_at(self, at: QPoint) -> tuple[int, int] | None:
        """The line and column under a point of the viewport; None if there is no text."""
        cursor = self.cursorForPosition(at)
        beyond = at.x() > self.cursorRect(cursor).right() + self.fontMetrics().averageCharWidth()
        below = self.row_at(at.y()) is None
        return None if below or (beyond and cursor.atBlockEnd()) else self.place_of(cursor)

    def _position(self, offset: int) -> int:
        line, column = self.sheet.where(offset)
        block = self.document().findBlockByNumber(line)
        return block.position() + units(block.text()[:column])

    # Keys, the clipboard, the pointer.

    def event(self, event: QEvent) -> bool:
        """Keep the keys of the editor from the window's shortcuts."""
        override = event.type() == QEvent.Type.ShortcutOverride
        if override and self.keys and isinstance(event, QKeyEvent) and self.keys.takes(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let the editor's own keys answer first; other keys are typed."""
        if self.keys is not None and self.keys.answer(event):
            event.accept()
            return
        super().keyPressEvent(event)
        if self.keys is not None:
            self.keys.typed(event)

    def viewportEvent(self, event: QEvent) -> bool:
        """Show the tip for the word under the pointer."""
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            place = self.place_at(event.pos())
            words = self.words_at(*place) if place else ""
            QToolTip.showText(event.globalPos(), tip_text(words), self.viewport())
            return True
        return super().viewportEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Emit ``menu_wanted``."""
        self.menu_wanted.emit(event.pos(), event.globalPos())

    def createMimeDataFromSelection(self) -> QMimeData:
        """The selected text as it is written in the file."""
        start, end = self.marked
        data = QMimeData()
        data.setText(self.sheet.text[start:end].replace("\r\n", "\n"))
        return data

    def canInsertFromMimeData(self, source: QMimeData) -> bool:
        """Whether the data is text. The window opens files that are dropped."""
        return source.hasText() and not any(url.isLocalFile() for url in source.urls())

    def insertFromMimeData(self, source: QMimeData) -> None:
        """Paste text as one undo step."""
        if self.isReadOnly():
            return
        start, end = self.marked
        part = self._spelt(source.text())
        words = f"Paste in line {self.sheet.line_of(self.sheet.where(start)[0]) + 1}"
        self.replace(start, end, part, words, start + len(part))
        self.ensureCursorVisible()

    def dropEvent(self, event: QDropEvent) -> None:
        """Insert dropped text where it falls; text dragged from here is moved."""
        data = event.mimeData()
        if self.isReadOnly() or not self.canInsertFromMimeData(data):
            super().dropEvent(event)
            return
        place = self.place_of(self.cursorForPosition(event.position().toPoint()))
        moved = (
            event.source() in (self, self.viewport())
            and event.dropAction() == Qt.DropAction.MoveAction
        )
        self.drop_text(data.text(), self.sheet.offset(*place), moved)
        event.acceptProposedAction()
        # This removes the drop caret.
        self.dragLeaveEvent(QDragLeaveEvent())

    def drop_text(self, text: str, at: int, moved: bool) -> None:
        """Insert text at an offset. ``moved`` also deletes the selection."""
        start, end = self.marked
        if moved and start <= at <= end:
            return
        part = self._spelt(text)
        patches = [(at, at, part)]
        if moved:
            patches = sorted([(start, end, ""), *patches], reverse=True)
        self.begin_command()
        self.apply(patches)
        first = at - (end - start) if moved and at >= end else at
        self.set_caret(first, first + len(part))
        self.typed.emit("Move text" if moved else "Drop text")

    def _spelt(self, text: str) -> str:
        """Text from elsewhere with the line ends of this file."""
        return text.replace("\r\n", "\n").replace("\n", self.sheet.newline)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Emit ``entered``."""
        super().focusInEvent(event)
        self.entered.emit()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Emit ``left``."""
        super().focusOutEvent(event)
        self.left.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Open a fold that is clicked; else put the caret there."""
        line = self.row_at(event.position().y())
        fold = self.folds.at(line) if line is not None else None
        if fold is not None and event.button() is Qt.MouseButton.LeftButton:
            self.folds.unfold(fold)
            return
        super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Emit ``clicked`` for a click without a selection; with Ctrl, emit ``called``."""
        super().mouseReleaseEvent(event)
        if event.button() is Qt.MouseButton.LeftButton and not self.textCursor().hasSelection():
            control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            (self.called if control else self.clicked).emit(event.position().toPoint())
