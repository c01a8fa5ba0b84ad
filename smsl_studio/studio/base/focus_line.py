"""A line around a list, a table or a page while the keys go to it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

WIDE = 2.0
"""The width of the line (pixels)."""


class FocusLine(QWidget):
    """Lies over its owner and is seen only while that has the keyboard focus.

    It uses the colour of the palette for what is chosen, so it follows the theme by itself.
    """

    def __init__(self, owner: QWidget) -> None:
        super().__init__(owner)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        owner.installEventFilter(self)
        self.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the focus and the size of the owner."""
        kind = event.type()
        if kind == QEvent.Type.FocusIn:
            self._cover()
            self.show()
            self.raise_()
        elif kind == QEvent.Type.FocusOut:
            self.hide()
        elif kind == QEvent.Type.Resize:
            self._cover()
        return super().eventFilter(watched, event)

    def _cover(self) -> None:
        owner = self.parentWidget()
        if owner is not None:
            self.setGeometry(owner.rect())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line just inside the edge."""
        painter = QPainter(self)
        painter.setPen(QPen(self.palette().highlight().color(), WIDE))
        half = WIDE / 2
        painter.drawRect(QRectF(self.rect()).adjusted(half, half, -half, -half))
        painter.end()
