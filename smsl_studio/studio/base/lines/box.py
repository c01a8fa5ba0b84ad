"""A line for a text of several lines."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QMimeData, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QPlainTextEdit

from smsl_studio.studio.base.lines.line import VARIOUS, FormLine, ShownValue, same

HIGH = 62
MOST = 100_000
"""The largest number of characters of a pasted text. Qt lays out every line at once."""


def keeps(event: QKeyEvent) -> bool:
    """Whether a key ends a text of several lines and keeps it: Ctrl+Enter, or Escape.

    Escape keeps what was typed, because a long text is much work. Undo brings the former text back.
    """
    held = event.modifiers() & Qt.KeyboardModifier.ControlModifier
    enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
    return event.key() == Qt.Key.Key_Escape or bool(held and enter)


def gives_up(event: QKeyEvent) -> bool:
    """Whether a key drops what was typed into a text of several lines: Shift+Escape."""
    held = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
    return event.key() == Qt.Key.Key_Escape and bool(held)


class TextBox(QPlainTextEdit):
    """A text edit whose text counts when it is left, on Ctrl+Enter, or on Escape.

    Shift+Escape restores the old text.
    """

    done = Signal()
    refused = Signal()
    """A pasted text is too long."""

    def __init__(self, most: int = MOST) -> None:
        super().__init__()
        self._settled, self._most = "", most
        self.setProperty("role", "field")
        self.setTabChangesFocus(True)
        self.setFixedHeight(HIGH)

    @property
    def changed(self) -> bool:
        """Whether the text differs from the value that was shown."""
        return self.toPlainText() != self._settled

    def settle(self, text: str) -> None:
        """Show a value and drop what was being typed."""
        self._settled = text
        if self.toPlainText() != text:
            self.setPlainText(text)

    def insertFromMimeData(self, source: QMimeData) -> None:
        """Paste a text, unless it is too long."""
        if len(source.text()) > self._most:
            self.refused.emit()
        else:
            super().insertFromMimeData(source)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Shift+Escape restores the old text; Escape and Ctrl+Enter emit ``done``; other keys
        type."""
        if gives_up(event) and self.changed:
            self.setPlainText(self._settled)
            self.selectAll()
        elif keeps(event) and self.changed:
            self.done.emit()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Emit ``done``, unless only a menu took the focus."""
        super().focusOutEvent(event)
        if event.reason() is not Qt.FocusReason.PopupFocusReason:
            self.done.emit()


class BoxLine(FormLine):
    """A line for a text of several lines, with room for ``most`` characters of a pasted one."""

    def __init__(self, words: str, tip: str, most: int = MOST) -> None:
        self.field: TextBox = TextBox(most)
        super().__init__(
            words, self.field, f"{tip}. Esc, Ctrl+Enter, or leaving the field, keeps it."
        )
        self.name.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.name.setContentsMargins(0, 6, 0, 0)
        self.field.done.connect(self._typed)
        room = f"There is room for {most:,} characters. Put longer texts into a file."
        self.field.refused.connect(lambda: self.refuse(room))

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show the text if all entries have the same; otherwise say that they differ."""
        super().show_values(shown)
        values = [one.value or "" for one in shown]
        alike = bool(values) and same(values)
        self.field.settle(values[0] if alike else "")
        self.field.setPlaceholderText("" if alike else VARIOUS)

    def _typed(self) -> None:
        if self.field.changed:
            self.given.emit(self.field.toPlainText().strip() or None)
