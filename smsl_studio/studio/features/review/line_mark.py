"""The mark of a line: its number in a circle, which shows how far its answer is."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens, text_font

ANSWERED, ASKED, OPEN = "approved", "commented", "open"


class LineMark(QWidget):
    """A circle with the number of the line: green if approved, amber with an open comment."""

    def __init__(self, mark: str, state: str, tokens: Tokens, size: float) -> None:
        super().__init__()
        self._mark, self._state, self._tokens = mark, state, tokens
        self._side = round(36 * min(size, 1.5))
        self.setFixedSize(self.sizeHint())

    def sizeHint(self) -> QSize:
        """A circle, wider for a long number."""
        return QSize(max(self._side, 14 + 9 * len(self._mark)), self._side)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the circle with its number, or with the icon of its answer."""
        tokens = self._tokens
        ink, ground = {
            ANSWERED: (tokens.ok, tokens.oks),
            ASKED: (tokens.risk, tokens.risks),
        }.get(self._state, (tokens.nl, tokens.surf))
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(ink, 1.2))
        painter.setBrush(ground)
        box = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        painter.drawRoundedRect(box, box.height() / 2, box.height() / 2)
        text = tokens.tx if self._state == OPEN else ink
        if self._mark:
            painter.setPen(text)
            painter.setFont(text_font(round(self._side * 0.42), 600))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, self._mark)
        else:
            icon = {ANSWERED: "check", ASKED: "slip"}.get(self._state)
            if icon:
                middle = QRectF(0, 0, 16, 16)
                middle.moveCenter(box.center())
                draw(painter, icon, middle, ink, ground)
        painter.end()
