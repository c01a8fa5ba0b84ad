"""A line for words of several lines."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QPlainTextEdit

from smsl_studio.studio.base.lines.line import VARIOUS, FormLine, ShownValue, same

HIGH = 62


class TextBox(QPlainTextEdit):
    """Text that is given back once when it is meant: on leaving it, or on Ctrl+Enter.

    Escape puts the old text back.
    """

    done = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._settled = ""
        self.setProperty("role", "field")
        self.setTabChangesFocus(True)
        self.setFixedHeight(HIGH)

    @property
    def changed(self) -> bool:
        """Whether the text is another than the one that was shown."""
        return self.toPlainText() != self._settled

    def settle(self, text: str) -> None:
        """Show a value; what was being typed is over."""
        self._settled = text
        if self.toPlainText() != text:
            self.setPlainText(text)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape puts the old text back, Ctrl+Enter gives the new one; other keys are typed."""
        held = event.modifiers() & Qt.KeyboardModifier.ControlModifier
        if event.key() == Qt.Key.Key_Escape and self.changed:
            self.setPlainText(self._settled)
            self.selectAll()
        elif held and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.done.emit()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Give the text, unless only a menu took the keys."""
        super().focusOutEvent(event)
        if event.reason() is not Qt.FocusReason.PopupFocusReason:
            self.done.emit()


class BoxLine(FormLine):
    """Words of several lines."""

    def __init__(self, words: str, tip: str) -> None:
        self.field: TextBox = TextBox()
        super().__init__(words, self.field, f"{tip}. Ctrl+Enter, or leaving the field, keeps it.")
        self.name.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.name.setContentsMargins(0, 6, 0, 0)
        self.field.done.connect(self._typed)

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show the words where all entries have the same; else say that they differ."""
        super().show_values(shown)
        values = [one.value or "" for one in shown]
        alike = bool(values) and same(values)
        self.field.settle(values[0] if alike else "")
        self.field.setPlaceholderText("" if alike else VARIOUS)

    def _typed(self) -> None:
        if self.field.changed:
            self.given.emit(self.field.toPlainText().strip() or None)
