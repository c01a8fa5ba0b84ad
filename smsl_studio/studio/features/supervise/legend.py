"""The legend of the partial view, shown where there is room for it."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QWidget

from smsl_studio.front.views.partial import PRUNED, UNKNOWN
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.paint.ink import Type, draw_sub_mark
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.features.supervise.wires import wire_pen

LINE, LEFT, WORDS = 22, 20, 62


class PartialLegend(QWidget):
    """Explains the signs in three lines, and in a fourth the sub-SB if there is one."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._sub = ""
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._say()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_sub(self, fact: str) -> None:
        """Set the name of the fact that a sub-SB expands; empty if there is none."""
        if fact != self._sub:
            self._sub = fact
            self._say()
            self.resize(self.sizeHint())
            self.update()

    def _lines(self) -> list[str]:
        lines = ["risk: low, medium, high", "held back by an unknown fact", "pruned until restored"]
        return [*lines, f"“{self._sub}” turns on, off, or with others"] if self._sub else lines

    def _say(self) -> None:
        self.setAccessibleName(plain_text("Legend: " + "; ".join(self._lines())))

    def sizeHint(self) -> QSize:
        """Wide enough for the longest line."""
        kind = Type(text_font(12))
        widest = max(kind.width(words) for words in self._lines())
        return QSize(round(WORDS + widest) + 8, len(self._lines()) * LINE + 8)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a sign and its words in each line."""
        t, kind = self._tokens, Type(text_font(12))
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for at, words in enumerate(self._lines()):
            y = at * LINE + LINE / 2
            self._sign(painter, at, y)
            kind.draw_from(painter, WORDS, y, words, t.tx2)
        painter.end()

    def _sign(self, painter: QPainter, at: int, y: float) -> None:
        t = self._tokens
        if at == 0:
            for one in range(3):
                x = LEFT + 5 + one * 10
                painter.setPen(t.risk if one < 2 else t.line2)
                painter.setBrush(t.risk if one < 2 else Qt.BrushStyle.NoBrush)
                painter.drawPolygon(
                    QPolygonF([QPointF(x, y - 4), QPointF(x + 4.4, y + 4), QPointF(x - 4.4, y + 4)])
                )
        elif at < 3:
            painter.setPen(wire_pen(UNKNOWN if at == 1 else PRUNED, t))
            painter.drawLine(QPointF(LEFT, y), QPointF(LEFT + 30, y))
        else:
            for one, mark in enumerate(("rise", "fall", "mixed")):
                draw_sub_mark(painter, LEFT + 5 + one * 11, y, mark, t.acc, t.canvas)
