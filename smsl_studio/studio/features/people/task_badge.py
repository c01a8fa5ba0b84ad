"""A badge in the top row that shows an open task while its card is not visible."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.people.task_card import TaskCard

HEIGHT, LEFT, TIME, PAD = 24, 30, 36, 10


class TaskBadge(QAbstractButton):
    """Keeps an open task visible in every mode.

    It stands in the row of badges, so that nothing below moves when it appears, least of all Stop.
    """

    def __init__(self, card: TaskCard, tokens: Tokens) -> None:
        super().__init__()
        self._card, self._tokens = card, tokens
        self._font = text_font(12, 600)
        self._time = ""
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setFixedHeight(HEIGHT)
        self.setAccessibleName("Task")
        card.changed.connect(self.refresh)
        self.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def refresh(self) -> None:
        """Show the task, unless its card is visible."""
        card = self._card.card
        self.setVisible(card is not None and not self._card.isVisible())
        if card is None:
            return
        others = len(self._card.tasks) - 1
        more = f", {others} more" if others else ""
        self._time = card.left
        self.setText(f"{card.heading}{more}")
        self.setToolTip(tip_text(f"{card.question} {card.left} left. Show the task (F4)"))
        self.setAccessibleName(plain_text(f"{card.heading}{more}: {card.question}"))
        self.setFixedWidth(self.sizeHint().width())
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough for the words and the time left."""
        wide = QFontMetricsF(self._font).horizontalAdvance(self.text())
        return QSize(round(LEFT + wide + 8 + TIME + PAD), HEIGHT)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the hand, the words and the time left."""
        tokens, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(tokens.tx if self.hasFocus() else tokens.acc, 1.5))
        painter.setBrush(tokens.acc)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 6, 6)
        draw(painter, "hand", QRectF(9, 5, 14, 14), tokens.onacc, tokens.acc)
        painter.setPen(tokens.onacc)
        painter.setFont(self._font)
        side = Qt.AlignmentFlag
        room = self.rect().adjusted(LEFT, 0, -PAD, 0)
        painter.drawText(room, side.AlignVCenter | side.AlignLeft, plain_text(self.text()))
        painter.drawText(room, side.AlignVCenter | side.AlignRight, plain_text(self._time))
        painter.end()
