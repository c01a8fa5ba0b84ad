"""A panel that lies over the body of a narrow window until the person is done with it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QRect, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QFrame, QVBoxLayout, QWidget


class Drawer(QFrame):
    """One widget over its host. It closes when the focus leaves it, and by Escape."""

    toggled = Signal(bool)
    """bool: whether it is open now."""

    def __init__(
        self, host: QWidget, area: Callable[[], QRect], back: Callable[[], QWidget], words: str
    ) -> None:
        """``area`` is its place in the host (pixels). ``back`` gets the focus after Escape."""
        super().__init__(host)
        self._area, self._back = area, back
        self._content: QWidget | None = None
        self.setProperty("role", "float")
        self.setAccessibleName(words)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 1, 1, 1)
        self.hide()
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._focus_moved)
        host.installEventFilter(self)

    def take(self, widget: QWidget) -> None:
        """Put this widget into the drawer."""
        layout = self.layout()
        assert layout is not None
        layout.addWidget(widget)
        self._content = widget

    def toggle(self) -> None:
        """Open the drawer and give it the keyboard focus, or close it."""
        if self.isVisible():
            self.close_drawer()
        else:
            self._place()
            self.show()
            self.raise_()
            if self._content is not None:
                self._content.setFocus()
            self.toggled.emit(True)

    def close_drawer(self) -> None:
        """Close the drawer."""
        if not self.isHidden():
            self.hide()
            self.toggled.emit(False)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Stay in place when the host changes its size."""
        if event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return super().eventFilter(watched, event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape closes the drawer and gives the keyboard focus back."""
        if event.key() == Qt.Key.Key_Escape:
            self.close_drawer()
            self._back().setFocus()
            return
        super().keyPressEvent(event)

    def _place(self) -> None:
        self.setGeometry(self._area())

    def _focus_moved(self, _: QWidget | None, now: QWidget | None) -> None:
        if self.isVisible() and now is not None and now is not self and not self.isAncestorOf(now):
            self.close_drawer()
