"""A badge in the top row that says how many conflicts of a merge are open."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.words import counted


class ConflictBadge(QAbstractButton):
    """Visible in every mode while conflicts are open. A click shows the page Merge."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._font = text_font(12, 500)
        self.setFixedHeight(22)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setToolTip("A merge left conflicts open. Show the page Merge")
        self.setAccessibleName("Open conflicts")
        self.hide()

    def show_number(self, number: int) -> None:
        """Show the number of open conflicts; 0 hides the badge."""
        self.setText(f"{counted(number, 'conflict')} open")
        self.setAccessibleName(plain_text(self.text()))
        self.setFixedWidth(self.sizeHint().width())
        self.setVisible(number > 0)
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough for the words."""
        return QSize(round(QFontMetricsF(self._font).horizontalAdvance(self.text())) + 38, 22)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a dashed box with icon and words."""
        tokens, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(tokens.bad, 2 if self.hasFocus() else 1)
        pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.setBrush(tokens.bads)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 6, 6)
        draw(painter, "error", QRectF(9, 4.5, 13, 13), tokens.bad, tokens.bads)
        painter.setPen(tokens.bad)
        painter.setFont(self._font)
        room = self.rect().adjusted(28, 0, 0, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, plain_text(self.text()))
        painter.end()
