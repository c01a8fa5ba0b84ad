"""The outline around a canvas that has the keyboard focus."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPaintEvent, QRegion
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.theme import Tokens

WIDE = 2


class FocusRing(QWidget):
    """A widget that covers only the border, so that the canvas below is not repainted for it."""

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.hide()

    def place(self, width: int, height: int) -> None:
        """Fit around a view of this size (pixels)."""
        self.setGeometry(0, 0, width, height)
        inner = self.rect().adjusted(WIDE, WIDE, -WIDE, -WIDE)
        self.setMask(QRegion(self.rect()).subtracted(QRegion(inner)))

    def show_focus(self, has: bool) -> None:
        """Show or hide the outline."""
        self.setVisible(has)
        if has:
            self.raise_()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the border in the accent colour."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.tokens.acc)
        painter.end()
