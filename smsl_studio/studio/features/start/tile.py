"""Tile: a card, row or link of the start page. A click or Enter opens what it stands for."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt, Signal
from PySide6.QtGui import QFocusEvent, QFontMetricsF, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import RADIUS_CARD, RADIUS_CHIP, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

ARROWS = (Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down)
WRAPPED = Qt.TextFlag.TextWordWrap.value
TOP_LEFT = Qt.AlignmentFlag.AlignTop.value | Qt.AlignmentFlag.AlignLeft.value


class Tile(QAbstractButton):
    """A painted button. ``name`` and ``words`` are what a screen reader says."""

    focused = Signal()

    def __init__(self, name: str, words: str, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.setText(plain_text(name))
        self.setAccessibleName(plain_text(name))
        self.setAccessibleDescription(plain_text(words))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter opens. Arrows are left to the page, which knows what stands around."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        elif event.key() in ARROWS:
            event.ignore()
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Tell the page, which draws the ring."""
        super().focusInEvent(event)
        self.focused.emit()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ground, then the content."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self.paint_ground(painter)
        self.paint_content(painter)
        painter.end()

    def paint_ground(self, painter: QPainter) -> None:
        """Paint a card; its line is darker under the pointer."""
        painter.setPen(QPen(self.tokens.nl if self.underMouse() else self.tokens.line2, 1))
        painter.setBrush(self.tokens.surf)
        box = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(box, RADIUS_CARD, RADIUS_CARD)

    def paint_content(self, painter: QPainter) -> None:
        """Paint what stands on the ground."""
        raise NotImplementedError

    # For the content.

    def say(self, painter: QPainter, at: QRectF, words: str, size: int, weight: int = 400) -> None:
        """Paint words in one line, without their middle if they do not fit."""
        font = text_font(size, weight)
        painter.setFont(font)
        shown = QFontMetricsF(font).elidedText(
            plain_text(words), Qt.TextElideMode.ElideMiddle, at.width()
        )
        painter.drawText(at, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, shown)

    def say_wrapped(self, painter: QPainter, at: QRectF, words: str, size: int) -> None:
        """Paint words in several lines."""
        painter.setFont(text_font(size))
        painter.drawText(at, TOP_LEFT | WRAPPED, words)

    def show_key(self, painter: QPainter, left: float, top: float, key: str) -> None:
        """Paint a key, as on a keyboard."""
        paint_key(painter, left, top, key, self.tokens)

    def tip(self, words: str) -> None:
        """Set the tooltip."""
        self.setToolTip(tip_text(words))


def paint_key(painter: QPainter, left: float, top: float, key: str, tokens: Tokens) -> float:
    """Paint a key, as on a keyboard, 20 pixels high; returns its width."""
    font = text_font(11, 500)
    wide = QFontMetricsF(font).horizontalAdvance(key) + 13
    box = QRectF(left, top, wide, 20)
    painter.setPen(QPen(tokens.line2, 1))
    painter.setBrush(tokens.win)
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), RADIUS_CHIP, RADIUS_CHIP)
    painter.setPen(tokens.tx2)
    painter.setFont(font)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, key)
    return wide
