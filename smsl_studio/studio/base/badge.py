"""A badge of the top row: an icon and some words in a box."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QAbstractButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens, text_font


class Badge(QAbstractButton):
    """A button that is as wide as its words. A dashed border means that it is not settled."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._font = tokens, text_font(12, 500)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    def sizeHint(self) -> QSize:
        """Wide enough for the words."""
        return QSize(round(QFontMetricsF(self._font).horizontalAdvance(self.text())) + 38, 22)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paint_box(
        self, icon: str, ink: QColor, ground: QColor, *, inset: float, dashed: bool
    ) -> None:
        """Paint the box, the icon and the words. The border is ``inset`` pixels inside."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(ink, 2 if self.hasFocus() else 1)
        if dashed:
            pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.setBrush(ground)
        box = QRectF(self.rect()).adjusted(inset, inset, -inset, -inset)
        painter.drawRoundedRect(box, 6, 6)
        draw(painter, icon, QRectF(9, 4.5, 13, 13), ink, ground)
        painter.setPen(ink)
        painter.setFont(self._font)
        room = self.rect().adjusted(28, 0, 0, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, plain_text(self.text()))
        painter.end()
