"""The list of words below the caret of the rules. It never takes the keyboard focus."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QKeyEvent, QTextCursor
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QPlainTextEdit

from smsl_studio.generate.rule_conditions import Alphabets
from smsl_studio.legible import one_line
from smsl_studio.studio.base.controls import NameDelegate
from smsl_studio.studio.features.rules.completion import FittingWord, offers

ROW, ROWS, WIDE, MOST = 22, 8, 260, 200


class WordList(QListWidget):
    """Ctrl+Space opens it. Up and Down choose, Enter and Tab insert, Escape closes it; any other
    key is typed and narrows it."""

    def __init__(self, text: QPlainTextEdit) -> None:
        super().__init__(text)
        self._text = text
        self.facts: Alphabets = {}
        self._begun = ""
        self.setProperty("role", "float")
        self.setItemDelegate(NameDelegate(self))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setAccessibleName("Words that fit")
        self.setUniformItemSizes(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.itemClicked.connect(lambda _: self.take())
        text.verticalScrollBar().valueChanged.connect(self.hide)
        self.hide()

    @property
    def words(self) -> list[str]:
        """The words that are offered."""
        return [self._offer(at).word for at in range(self.count())]

    def ask(self) -> None:
        """Show what fits at the caret, or hide if nothing does."""
        cursor = self._text.textCursor()
        before = cursor.block().text()[: cursor.positionInBlock()]
        self._begun, found = offers(before, self.facts)
        self.clear()
        for offer in found[:MOST]:
            item = QListWidgetItem(one_line(f"{offer.word}   {offer.kind}"))
            item.setSizeHint(QSize(0, ROW))
            item.setData(Qt.ItemDataRole.UserRole, offer)
            self.addItem(item)
        if not found:
            self.hide()
            return
        self.setCurrentRow(0)
        self._place()
        self.show()
        self.raise_()

    def answer(self, event: QKeyEvent) -> bool:
        """Handle a key for the open list. Return whether it was one."""
        if self.isHidden() or event.modifiers() != Qt.KeyboardModifier.NoModifier:
            return False
        steps = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1,
                 Qt.Key.Key_PageUp: -ROWS, Qt.Key.Key_PageDown: ROWS}  # fmt: skip
        key, last = event.key(), self.count() - 1
        if key in steps:
            self.setCurrentRow(max(0, min(last, self.currentRow() + steps[Qt.Key(key)])))
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Tab):
            self.take()
        elif key == Qt.Key.Key_Escape:
            self.hide()
        else:
            return False
        return True

    def take(self) -> None:
        """Write the chosen word in place of what was begun, as one step of the undo."""
        cursor = self._text.textCursor()
        cursor.movePosition(
            QTextCursor.MoveOperation.Left, QTextCursor.MoveMode.KeepAnchor, len(self._begun)
        )
        cursor.insertText(self._offer(self.currentRow()).word)
        self.hide()

    def _offer(self, at: int) -> FittingWord:
        offer: FittingWord = self.item(at).data(Qt.ItemDataRole.UserRole)
        return offer

    def _place(self) -> None:
        """Stand below the caret, above it where there is no room below."""
        view = self._text.viewport()
        high = ROW * min(ROWS, self.count()) + 2 * self.frameWidth() + 2
        caret = self._text.cursorRect()
        at = view.mapTo(self._text, caret.bottomLeft())
        if at.y() + high > self._text.height():
            at.setY(max(0, view.mapTo(self._text, caret.topLeft()).y() - high))
        self.setGeometry(max(0, min(at.x(), self._text.width() - WIDE)), at.y(), WIDE, high)
