"""A line for a name in place, and what is said beside it when the name does not fit."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLabel, QLineEdit, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.card import tint
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font


class NameLine(QLineEdit):
    """A line for a name, in the code font; Enter and Esc are told, Tab goes to the next line."""

    done = Signal()
    left = Signal()
    moved = Signal(int)
    tabbed = Signal()

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
        """Keep letters from the window's shortcuts while a name is typed, and tell Tab."""
        if isinstance(event, QKeyEvent) and event.type() is QEvent.Type.ShortcutOverride:
            # Keys belong to the field while it is edited, not to the window's shortcuts.
            if not event.modifiers() & Qt.KeyboardModifier.ControlModifier:
                event.accept()
            return True
        if (
            isinstance(event, QKeyEvent)
            and event.type() is QEvent.Type.KeyPress
            and event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
        ):
            self.tabbed.emit()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Tell Enter, Escape and the arrows up and down; other keys are typed."""
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
    """A hidden label that says in the colour of errors why a name does not fit."""
    label = Label("", parent)
    label.setFont(text_font(12))
    label.setWordWrap(True)
    label.setContentsMargins(7, 0, 7, 2)
    tint(label, tokens.bad)
    label.hide()
    return label


def complain(label: QLabel, reason: str, width: int) -> None:
    """Say a reason in such a label, this many pixels wide; empty hides it."""
    label.setText(reason)
    label.setFixedWidth(width)
    label.setFixedHeight(label.heightForWidth(width) if reason else 0)
    label.setAccessibleName(plain_text(reason))
    label.setVisible(bool(reason))
