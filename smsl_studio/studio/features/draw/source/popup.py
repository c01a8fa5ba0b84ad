"""The list of names below the caret while one types. It never takes the keyboard focus."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPoint, QSize, Qt, QTimer
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QListWidget, QListWidgetItem

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.controls import NameDelegate
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.source.around import Around, around
from smsl_studio.studio.features.draw.source.completion import Completion, offers, written
from smsl_studio.studio.features.draw.source.editor import Editor

ROW, ROWS, WIDE = 22, 8, 260
_NONE, _CTRL = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier


class Popup(QListWidget):
    """Offers names in one editor.

    ``blueprint`` returns the current one, ``library`` holds names of plugins.

    Up and Down choose, Enter and Tab insert, Escape closes the list. Every other key is typed.
    """

    def __init__(self, editor: Editor, blueprint: Callable[[], Blueprint]) -> None:
        super().__init__(editor)
        self._editor, self._blueprint = editor, blueprint
        self.library: Sequence[str] = ()
        self._here: Around | None = None
        self._line, self._asked, self._goes_on = 0, False, False
        self.setProperty("role", "float")
        self.setItemDelegate(NameDelegate(self))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName("Names that fit")
        self.setUniformItemSizes(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.itemClicked.connect(lambda _: self._take())
        # After the key is painted, because the search may take longer than a frame.
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.timeout.connect(self._offer)
        editor.left.connect(self.hide)
        editor.verticalScrollBar().valueChanged.connect(self.hide)
        editor.caret_moved.connect(self._caret_moved)
        self.hide()

    @property
    def names(self) -> list[str]:
        """The names that are offered."""
        return [self.item(at).data(Qt.ItemDataRole.UserRole).name for at in range(self.count())]

    def ask(self) -> bool:
        """Offer what fits here, even if nothing was typed."""
        self._asked, self._goes_on = True, False
        self._offer()
        return True

    def typed(self, event: QKeyEvent) -> None:
        """Update the list after a key was typed: open it for a letter, narrow it if it is open."""
        letter = event.text()
        in_word = bool(letter) and (letter.isalnum() or letter in "_-")
        self._goes_on = in_word and not self.isHidden()
        if in_word or letter == '"':
            self._asked = False
            self._later.start(0)
        elif not self.isHidden():
            self._later.start(0)

    def answer(self, event: QKeyEvent) -> bool:
        """Handle a key for the list. Returns whether it was one."""
        if self.isHidden() or event.modifiers() != _NONE:
            return False
        key, last = event.key(), self.count() - 1
        steps = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1,
                 Qt.Key.Key_PageUp: -ROWS, Qt.Key.Key_PageDown: ROWS}  # fmt: skip
        if key in steps:
            self.setCurrentRow(max(0, min(last, self.currentRow() + steps[Qt.Key(key)])))
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Tab):
            self._take()
        elif key == Qt.Key.Key_Escape:
            self.hide()
        else:
            return False
        return True

    def _caret_moved(self) -> None:
        if not self.isHidden() and self._editor.caret[0] != self._line:
            self.hide()

    def _offer(self) -> None:
        editor = self._editor
        if editor.isReadOnly() or editor.textCursor().hasSelection():
            self.hide()
            return
        self._line, column = editor.caret
        known = self._here.path if self._here and self._goes_on else None
        here = around(editor.sheet.pieces, self._line, column, editor.form, known)
        found = offers(self._blueprint(), self.library, here)
        if not found or not (self._asked or self._wanted(here, found, column)):
            self.hide()
            return
        self._here = here
        self.clear()
        for offer in found:
            words = f"{offer.name}   {offer.detail}" if offer.detail else offer.name
            item = QListWidgetItem(words, self)
            item.setData(Qt.ItemDataRole.UserRole, offer)
            item.setToolTip(tip_text(words))
            item.setSizeHint(QSize(0, ROW))
        self.setCurrentRow(0)
        self._place()

    def _wanted(self, here: Around, found: Sequence[Completion], column: int) -> bool:
        """Whether to open the list unasked: a name was begun here and is not complete."""
        shown = self._editor.sheet.shown_piece(self._line)
        quoted = shown[column - 1 : column] == '"'
        if not here.word:
            return quoted
        closed = quoted and column - 1 > here.start
        return not closed and [one.name for one in found[:2]] != [here.typed]

    def _place(self) -> None:
        """Place it below the caret, or above if there is no room below."""
        editor = self._editor
        self.setFont(editor.font())
        high = ROW * min(ROWS, self.count()) + 4
        wide = min(WIDE, editor.width() - 16)
        caret = editor.cursorRect()
        at = editor.viewport().mapTo(editor, QPoint(caret.left(), caret.bottom() + 2))
        if at.y() + high > editor.height():
            at.setY(max(0, at.y() - high - caret.height() - 4))
        at.setX(max(4, min(at.x(), editor.width() - wide - 8)))
        self.setGeometry(at.x(), at.y(), wide, high)
        self.show()
        self.raise_()

    def _take(self) -> None:
        """Replace the word at the caret with the chosen name."""
        item, here, editor = self.currentItem(), self._here, self._editor
        self.hide()
        if item is None or here is None:
            return
        offer: Completion = item.data(Qt.ItemDataRole.UserRole)
        shown = editor.sheet.shown_piece(self._line)
        part = written(offer, here, editor.form, shown[here.end :])
        start, end = (editor.sheet.offset(self._line, at) for at in (here.start, here.end))
        number = editor.sheet.line_of(self._line) + 1
        editor.replace(start, end, part, f"Type in line {number}", start + len(part))
