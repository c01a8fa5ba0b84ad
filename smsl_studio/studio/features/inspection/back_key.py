"""BackKey: handles Alt+Left inside a page before other parts of the window can use it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget


class BackKey(QObject):
    """Watches widgets for Alt+Left, and emits ``pressed``.

    Without it, buttons would move the focus, scroll areas would scroll, and the window would go
    back in the drawing.
    """

    pressed = Signal()

    def watch(self, widget: QWidget) -> None:
        """Watch a widget and all widgets that are in it now. Later ones need another call."""
        for one in (widget, *widget.findChildren(QWidget)):
            one.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep the key from the widget, and emit ``pressed``."""
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
