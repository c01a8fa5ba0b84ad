"""The line around a canvas that has the keys."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPaintEvent, QRegion
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.theme import Tokens

WIDE = 2


class FocusRing(QWidget):
    """Covers only the border, so that the canvas is not painted again because of it."""

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.hide()

    def place(self, width: int, height: int) -> None:
        """Lie around a view of this size."""
        self.setGeometry(0, 0, width, height)
        inner = self.rect().adjusted(WIDE, WIDE, -WIDE, -WIDE)
        self.setMask(QRegion(self.rect()).subtracted(QRegion(inner)))

    def show_focus(self, has: bool) -> None:
        """Show whether keys go to the canvas."""
        self.setVisible(has)
        if has:
            self.raise_()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the border with the accent."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.tokens.acc)
        painter.end()
