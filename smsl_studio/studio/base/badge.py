"""A badge of the top row: an icon and some words in a box."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPen
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
        return QSize(badge_width(self.text(), self._font), 22)

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
        look = BadgeLook(icon, ink, ground, dashed)
        look.paint(painter, QRectF(self.rect()).adjusted(inset, inset, -inset, -inset),
                   self.text(), self._font, 2 if self.hasFocus() else 1)  # fmt: skip
        painter.end()


@dataclass(frozen=True)
class BadgeLook:
    """The icon and the colours of a badge. A dashed border means that it is not settled."""

    icon: str
    ink: QColor
    ground: QColor
    dashed: bool

    def paint(self, painter: QPainter, box: QRectF, words: str, font: QFont, line: int = 1) -> None:
        """Paint the box with its icon and words. The border has ``line`` pixels."""
        pen = QPen(self.ink, line)
        if self.dashed:
            pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.setBrush(self.ground)
        painter.drawRoundedRect(box, 6, 6)
        place = QRectF(box.left() + 8.5, box.center().y() - 6.5, 13, 13)
        draw(painter, self.icon, place, self.ink, self.ground)
        painter.setPen(self.ink)
        painter.setFont(font)
        room = box.adjusted(27.5, 0, 0, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, plain_text(words))


def badge_width(words: str, font: QFont) -> int:
    """Return the width of a badge with these words, in pixels."""
    return round(QFontMetricsF(font).horizontalAdvance(plain_text(words))) + 38
