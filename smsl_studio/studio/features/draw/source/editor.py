"""Editor: the text of one file in a text widget, and exactly what stands in the file behind it.

Whoever types changes the widget, and the sheet follows; whoever changes the text from elsewhere
(the canvas, a fix, a replacement) puts it into the sheet, and the widget shows what differs. So
neither a keystroke nor an edit ever sets the whole text anew, and caret and scroll stay.
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
"""Patches from which on they are made as one."""


class Editor(TextSurface):
    """The text itself. Lines and columns are those shown, from 0, counted in characters."""

    starting = Signal()
    """A command is about to change the text: what was typed before is a step of its own."""
    typed = Signal(str)
    """The text was changed by hand; the words for the step."""
    caret_moved = Signal()
    clicked = Signal(QPoint)
    """A click that marked nothing; where."""
    called = Signal(QPoint)
    """A click with Ctrl held: where what stands there is defined."""
    menu_wanted = Signal(QPoint, QPoint)
    """The context menu: where in the text, and where on the screen."""
    entered = Signal()
    left = Signal()
    """The focus came here, or goes elsewhere."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(tokens, parent)
        self._own, self._blocks = False, 1
        self.keys: Keys | None = None
        self.words_at: Callable[[int, int], str] = lambda line, column: ""
        self.setAccessibleName("Source text")
        self.document().contentsChange.connect(self._contents_changed)
        self.cursorPositionChanged.connect(self.caret_moved)

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

    def load(self, text: str) -> None:
        """Show another text from its beginning."""
        self.folds.all.clear()
        self.sheet = TextSheet(text)
        self._own = True
        self.setPlainText(self.sheet.shown)
        self._own = False
        self._blocks = self.blockCount()

    def apply(self, patches: Sequence[Patch]) -> None:
        """Replace parts of the text, the last one first; what is seen stays where it is."""
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
        """What follows is no part of what was typed before."""
        self.starting.emit()

    def replace(
        self, start: int, end: int, part: str, words: str, caret: int | None = None
    ) -> None:
        """Replace, as if typed, what stands between two offsets; then put the caret somewhere."""
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

    def place_at(self, at: QPoint) -> tuple[int, int] | None:
        """The line and column under a point; None where no text is."""
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
        """Keep the keys that the editor uses from the window's shortcuts."""
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
        """Show what is said of the word under the pointer as a tip."""
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            place = self.place_at(event.pos())
            words = self.words_at(*place) if place else ""
            QToolTip.showText(event.globalPos(), tip_text(words), self.viewport())
            return True
        return super().viewportEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the text."""
        self.menu_wanted.emit(event.pos(), event.globalPos())

    def createMimeDataFromSelection(self) -> QMimeData:
        """What is marked, spelt as it stands in the file."""
        start, end = self.marked
        data = QMimeData()
        data.setText(self.sheet.text[start:end].replace("\r\n", "\n"))
        return data

    def canInsertFromMimeData(self, source: QMimeData) -> bool:
        """Text; files that are dropped are opened by the window."""
        return source.hasText() and not any(url.isLocalFile() for url in source.urls())

    def insertFromMimeData(self, source: QMimeData) -> None:
        """Paste the text as one step of the history."""
        if self.isReadOnly():
            return
        start, end = self.marked
        part = self._spelt(source.text())
        words = f"Paste in line {self.sheet.line_of(self.sheet.where(start)[0]) + 1}"
        self.replace(start, end, part, words, start + len(part))
        self.ensureCursorVisible()

    def dropEvent(self, event: QDropEvent) -> None:
        """Text that is dropped goes where it falls; what is dragged from here is moved."""
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
        # The mark of where it would fall goes.
        self.dragLeaveEvent(QDragLeaveEvent())

    def drop_text(self, text: str, at: int, moved: bool) -> None:
        """Put text at an offset; ``moved`` takes away what is marked."""
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
        """Text from elsewhere with the line ends of this one."""
        return text.replace("\r\n", "\n").replace("\n", self.sheet.newline)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Tell that the text has the keys."""
        super().focusInEvent(event)
        self.entered.emit()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Tell that the text lost the keys."""
        super().focusOutEvent(event)
        self.left.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Unfold a fold that is clicked; else put the caret there."""
        line = self.row_at(event.position().y())
        fold = self.folds.at(line) if line is not None else None
        if fold is not None and event.button() is Qt.MouseButton.LeftButton:
            self.folds.unfold(fold)
            return
        super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Tell a click without a selection; with Ctrl it asks for the place named there."""
        super().mouseReleaseEvent(event)
        if event.button() is Qt.MouseButton.LeftButton and not self.textCursor().hasSelection():
            control = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            (self.called if control else self.clicked).emit(event.position().toPoint())
