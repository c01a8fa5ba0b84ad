"""A line edit for a name on the canvas, and the label for what is wrong with the name."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QLabel, QLineEdit, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.card import tint
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font


class NameLine(QLineEdit):
    """A line edit in the code font.

    Signals: ``done`` (Enter), ``left`` (Esc), ``moved`` (+1 or -1 for the arrows down and up),
    ``tabbed`` (Tab), ``tabbed_back`` (Shift+Tab).
    """

    done = Signal()
    left = Signal()
    moved = Signal(int)
    tabbed = Signal()
    tabbed_back = Signal()

    def __init__(self, parent: QWidget, tokens: Tokens, hint: str) -> None:
        super().__init__(parent)
        self.setFont(mono_font(12))
        self.setPlaceholderText(hint)
        self.setAccessibleName(plain_text(hint))
        self.setFrame(False)
        self.setStyleSheet(
            f"QLineEdit {{ background: {tokens.surf.name()}; color: {tokens.tx.name()};"
            f" border: 1px solid {tokens.nl.name()}; border-radius: 6px; padding: 3px 6px; }}"
            f" QLineEdit:focus {{ border: 1px solid {tokens.acc.name()}; }}"
        )
        self.setMinimumHeight(28)

    def event(self, event: QEvent) -> bool:
        """Keep letters from the window's shortcuts while a name is typed, and tell of Tab."""
        if isinstance(event, QKeyEvent) and event.type() is QEvent.Type.ShortcutOverride:
            # While a name is edited, plain keys belong to the field, not to the window's shortcuts.
            own = not event.modifiers() & Qt.KeyboardModifier.ControlModifier
            if own or self._steps_back(event):
                event.accept()
            return True
        if (
            isinstance(event, QKeyEvent)
            and event.type() is QEvent.Type.KeyPress
            and event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
        ):
            (self.tabbed if event.key() == Qt.Key.Key_Tab else self.tabbed_back).emit()
            return True
        return super().event(event)

    def _steps_back(self, event: QKeyEvent) -> bool:
        """Whether it undoes or redoes what is typed here. Without that the window undoes a step."""
        undoes = event.matches(QKeySequence.StandardKey.Undo) and self.isUndoAvailable()
        return undoes or (event.matches(QKeySequence.StandardKey.Redo) and self.isRedoAvailable())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Emit the signal of Enter, Escape, Up or Down; other keys type."""
        key = event.key()
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.done.emit()
        elif key == Qt.Key.Key_Escape:
            self.left.emit()
        elif key in (Qt.Key.Key_Up, Qt.Key.Key_Down):
            self.moved.emit(1 if key == Qt.Key.Key_Down else -1)
        else:
            super().keyPressEvent(event)
            return
        event.accept()


def error_label(parent: QWidget, tokens: Tokens) -> QLabel:
    """A hidden label in the colour of errors, for what is wrong with a name."""
    label = Label("", parent)
    label.setFont(text_font(12))
    label.setWordWrap(True)
    label.setContentsMargins(7, 0, 7, 2)
    tint(label, tokens.bad)
    label.hide()
    return label


def complain(label: QLabel, reason: str, width: int) -> None:
    """Show a reason in such a label with this width (pixels); empty hides it."""
    label.setText(reason)
    label.setFixedWidth(width)
    label.setFixedHeight(label.heightForWidth(width) if reason else 0)
    label.setAccessibleName(plain_text(reason))
    label.setVisible(bool(reason))
