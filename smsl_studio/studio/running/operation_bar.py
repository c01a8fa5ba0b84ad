"""The bar of the running operation: what runs, from where to where, and how far it is."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

HIGH, RIGHT = 40, 8
"""The height, and the margin at the right, as beside the tiles (pixels)."""
NOTHING = "No operation runs"


class OperationBar(QWidget):
    """A line of words with a bar below it. Without an operation the bar is empty."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.words = self.time = ""
        """What runs, and its time in words."""
        self.share: float | None = None
        self.setFixedHeight(HIGH)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.show_operation("", "", None)

    def sizeHint(self) -> QSize:
        """As wide as there is room."""
        return QSize(240, HIGH)

    def show_operation(self, words: str, time: str, share: float | None, why: str = "") -> None:
        """Show an operation and how far it is (0 to 1); None if this is not known.

        ``why`` explains its time in the tooltip.
        """
        words = words or NOTHING
        if words != self.words:
            self.setAccessibleName(plain_text(words))
        self.setToolTip(tip_text(f"{words}. {why}" if why else words))
        if (words, time, share) != (self.words, self.time, self.share):
            self.words, self.time, self.share = words, time, share
            self.setAccessibleDescription(plain_text(time))
            self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the words, the time, and the bar."""
        t, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        line = QRectF(2, 6, self.width() - RIGHT - 2, 18)
        used = paint_text(painter, line, self.time, TextInk(t.tx2, 12), right=True)
        room = line.adjusted(0, 0, -used - 12, 0)
        paint_text(painter, room, self.words, TextInk(t.tx if self.share is not None else t.tx2))
        bar = QRectF(0, 28, self.width() - RIGHT, 6)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(t.line)
        painter.drawRoundedRect(bar, 3, 3)
        if self.share:
            bar.setWidth(max(bar.width() * self.share, 6))
            painter.setBrush(t.acc)
            painter.drawRoundedRect(bar, 3, 3)
