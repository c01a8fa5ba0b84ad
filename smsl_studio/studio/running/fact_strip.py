"""The values of a fact over the time of a plot, as a strip below it."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QBrush, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from smsl_studio.front.views.measure_traces import SPAN
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font

HIGH = 20
UNKNOWN = "?"


class FactStrip(QWidget):
    """Spans of values from 30 s ago to now. ``left`` pixels stay free for the word."""

    def __init__(self, tokens: Tokens, left: int) -> None:
        super().__init__()
        self._tokens, self._left = tokens, left
        self.values: tuple[tuple[float, float, str], ...] = ()
        """From, to (s, negative: ago) and value of each span."""
        self.setFixedHeight(HIGH)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_values(self, values: tuple[tuple[float, float, str], ...], now: float) -> None:
        """Show spans of simulated time as they are at ``now`` (s)."""
        self.values = tuple((begin - now, end - now, value) for begin, end, value in values)
        said = (f"{value} from {-begin:.1f} s ago" for begin, _, value in self.values)
        self.setAccessibleName("Values of the fact in the last 30 s")
        self.setAccessibleDescription(plain_text("; ".join(said)))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the spans: unknown ones hatched, with their values where there is room."""
        painter, tokens = QPainter(self), self._tokens
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(text_font(11))
        painter.setPen(tokens.tx2)
        sides = Qt.AlignmentFlag
        word = QRectF(0, 0, self._left - 6, self.height())
        painter.drawText(word, sides.AlignRight | sides.AlignVCenter, "fact")
        wide = self.width() - self._left
        painter.setFont(mono_font(11, 600))
        for at, (begin, end, value) in enumerate(self.values):
            left = self._left + (begin / SPAN + 1) * wide
            box = QRectF(left, 2, max((end - begin) / SPAN * wide, 1.0), self.height() - 4)
            unknown, even = value == UNKNOWN, at % 2 == 0
            painter.setPen(QPen(tokens.unk if unknown else tokens.line2, 1))
            painter.setBrush(tokens.unks if unknown else tokens.surf if even else tokens.sunk)
            painter.drawRoundedRect(box, 3, 3)
            if unknown:
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(QBrush(tokens.unk, Qt.BrushStyle.BDiagPattern))
                painter.drawRoundedRect(box, 3, 3)
            shown = plain_text(value)
            if painter.fontMetrics().horizontalAdvance(shown) + 6 < box.width():
                painter.setPen(tokens.unk if unknown else tokens.tx)
                painter.drawText(box, sides.AlignCenter, shown)
