"""One answer as a large row: a circle, its words, and its letter."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy

from smsl_studio.front.views.card_view import OptionView
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import CONTROL_DECISION, RADIUS_CONTROL, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

LEFT, KEY, PAD = 34, 24, 12


class OptionRow(QAbstractButton):
    """A checkable row, at least 40 pixels high, higher if the words need more lines."""

    def __init__(self, option: OptionView, tokens: Tokens) -> None:
        super().__init__()
        self.option = option
        self._tokens = tokens
        self.setText(option.words)
        self.setCheckable(True)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setToolTip(tip_text(f"{option.words} ({option.letter})"))
        self.setAccessibleName(plain_text(f"{option.words}, key {option.letter}"))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def hasHeightForWidth(self) -> bool:
        """True, because a narrow row needs more lines."""
        return True

    def heightForWidth(self, width: int) -> int:
        """The height that the words need at this width (pixels)."""
        metrics = QFontMetrics(text_font(13, 500))
        room = QRect(0, 0, max(width - LEFT - KEY - 2 * PAD, 40), 10_000)
        needed = metrics.boundingRect(room, Qt.TextFlag.TextWordWrap, self.text())
        return max(CONTROL_DECISION, needed.height() + 20)

    def sizeHint(self) -> QSize:
        """The height that the words need at the present width."""
        return QSize(240, self.heightForWidth(max(self.width(), 240)))

    def minimumSizeHint(self) -> QSize:
        """The height of a decision button."""
        return QSize(120, CONTROL_DECISION)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint circle, words and letter, with a frame if it is selected or has the focus."""
        tokens, chosen, focus = self._tokens, self.isChecked(), self.hasFocus()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        lit = self.underMouse() and self.isEnabled()
        edge = tokens.acc if chosen or focus else tokens.nl if lit else tokens.line2
        wide = 2.0 if chosen or focus else 1.0
        painter.setPen(QPen(edge, wide))
        painter.setBrush(
            tokens.accs if chosen else tokens.surf if self.isEnabled() else tokens.sunk
        )
        inset = wide / 2
        box = QRectF(self.rect()).adjusted(inset, inset, -inset, -inset)
        painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
        self._circle(painter, chosen)
        painter.setPen(tokens.tx if self.isEnabled() else tokens.tx3)
        painter.setFont(text_font(13, 600 if chosen else 500))
        room = self.rect().adjusted(LEFT, 0, -(KEY + PAD), 0)
        middle = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft
        painter.drawText(room, middle | Qt.TextFlag.TextWordWrap, plain_text(self.text()))
        self._key(painter)
        painter.end()

    def _circle(self, painter: QPainter, chosen: bool) -> None:
        tokens = self._tokens
        middle = QPointF(20.0, self.height() / 2)
        painter.setPen(QPen(tokens.acc if chosen else tokens.nl, 1.5))
        painter.setBrush(tokens.surf)
        painter.drawEllipse(middle, 6.5, 6.5)
        if chosen:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(tokens.acc)
            painter.drawEllipse(middle, 3.5, 3.5)

    def _key(self, painter: QPainter) -> None:
        if not self.option.letter:
            return
        tokens = self._tokens
        box = QRectF(self.width() - KEY - 6.5, self.height() / 2 - 9.5, 20, 19)
        painter.setPen(QPen(tokens.line2, 1))
        painter.setBrush(tokens.win)
        painter.drawRoundedRect(box, 4, 4)
        painter.setPen(tokens.tx2)
        painter.setFont(text_font(11, 500))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, plain_text(self.option.letter))
