"""The badge of trust in the top row of the window, and the card with the reasons."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QFrame, QVBoxLayout, QWidget

from smsl_studio.front.approval_badge import UNINSPECTED, ApprovalWords
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens, text_font

LOOKING = ApprovalWords("Looking at the record", ("Signatures are being verified.",))
WIDE = 420
"""The width of the card (pixels)."""


class ApprovalBadge(QAbstractButton):
    """Says in a few words whether the blueprint is approved. A click shows the reasons.

    A dashed border means that the blueprint is not approved, or that this is not known yet.
    """

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.said = UNINSPECTED
        self._tokens, self._font = tokens, text_font(12, 500)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setToolTip("Whether people have inspected and signed this blueprint. Show the reasons")
        self.show_words(UNINSPECTED)

    def show_words(self, said: ApprovalWords) -> None:
        """Show the words for another state of the approval."""
        self.said = said
        self.setText(said.words)
        self.setAccessibleName(plain_text(said.words))
        self.setAccessibleDescription(plain_text(" ".join((*said.reasons, said.advice))))
        self.setFixedSize(self.sizeHint())
        self.update()

    def sizeHint(self) -> QSize:
        """The size that the icon and the words need."""
        return QSize(round(QFontMetricsF(self._font).horizontalAdvance(self.text())) + 38, 22)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the icon, the words and the border: a full green one if approved, else a dashed
        one.
        """
        tokens, painter = self._tokens, QPainter(self)
        good = self.said.is_good
        ink, ground = (tokens.ok, tokens.oks) if good else (tokens.risk, tokens.risks)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(ink, 2 if self.hasFocus() else 1)
        if not good:
            pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.setBrush(ground)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6)
        draw(painter, "shield", QRectF(9, 4.5, 13, 13), ink, ground)
        painter.setPen(ink)
        painter.setFont(self._font)
        room = self.rect().adjusted(28, 0, 0, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, plain_text(self.text()))
        painter.end()


class ReasonCard(QFrame):
    """The reasons for what the badge says.

    The card closes if the person clicks elsewhere or presses Escape.
    """

    def __init__(self, parent: QWidget, said: ApprovalWords) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setProperty("role", "float")
        self.setFixedWidth(WIDE)
        self.setAccessibleName(plain_text(said.words))
        column = QVBoxLayout(self)
        column.setContentsMargins(14, 12, 14, 12)
        column.setSpacing(8)
        self.lines = (said.words, *said.reasons, *((said.advice,) if said.advice else ()))
        for number, text in enumerate(self.lines):
            line = label(text, "" if number == 0 else "second")
            line.setWordWrap(True)
            column.addWidget(line)

    def open_below(self, badge: QWidget) -> None:
        """Show the card below a badge, inside the window."""
        self.adjustSize()
        corner = badge.mapToGlobal(QPoint(badge.width() - self.width(), badge.height() + 6))
        self.move(corner)
        self.show()
