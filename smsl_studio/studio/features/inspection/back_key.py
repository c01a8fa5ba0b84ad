"""BackKey: Alt+Left inside a page, before any other part of the window gets it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget


class BackKey(QObject):
    """Watches widgets for Alt+Left. Buttons and scroll areas would move the focus or scroll, and
    the window has an action of the same key for the drawing."""

    pressed = Signal()

    def watch(self, widget: QWidget) -> None:
        """Watch a widget and everything in it, as it is now."""
        for one in (widget, *widget.findChildren(QWidget)):
            one.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the key, and emit ``pressed``."""
        kind = event.type()
        if kind not in (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress):
            return False
        assert isinstance(event, QKeyEvent)
        if event.key() != Qt.Key.Key_Left or event.modifiers() != Qt.KeyboardModifier.AltModifier:
            return False
        event.accept()
        if kind == QEvent.Type.KeyPress:
            self.pressed.emit()
        return True
