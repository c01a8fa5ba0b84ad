"""The sign of a guard: a lock whose shape says whether the required facts hold."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath

from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, faded, hatch, pen
from smsl_studio.studio.base.theme import Tokens, mono_font

DECLARED, HOLDS, MISSES, UNKNOWN = "declared", "true", "false", "unknown"
WORDS = {
    DECLARED: "",
    HOLDS: "what it needs holds",
    MISSES: "what it needs does not hold",
    UNKNOWN: "whether what it needs holds is unknown",
}


def draw_guard(painter: QPainter, x: float, y: float, how: str, tokens: Tokens) -> None:
    """Draw the lock, 9 mark pixels wide, centred on (x, y).

    Open: the facts hold. Closed and filled: they do not hold. Dashed with "?": unknown. Closed and
    pale: there is no run, so nothing is known.
    """
    if how == UNKNOWN:
        _unknown(painter, x, y, tokens)
        return
    colour = {HOLDS: tokens.ok, MISSES: tokens.slate}.get(how, tokens.tx2)
    _shackle(painter, x, y, colour, opened=how == HOLDS)
    body = QRectF(x - 4.0, y - 0.8, 8.0, 5.8)
    if how in (HOLDS, MISSES):
        painter.setPen(NO_PEN)
        painter.setBrush(colour)
        painter.drawRoundedRect(body, 1.4, 1.4)
    else:
        painter.setPen(pen(colour, 1.2))
        painter.setBrush(tokens.canvas)
        painter.drawRoundedRect(body.adjusted(0.6, 0.6, -0.6, -0.6), 1.0, 1.0)


def _shackle(painter: QPainter, x: float, y: float, colour: QColor, opened: bool) -> None:
    path = QPainterPath(QPointF(x - 2.4, y - 0.6))
    path.lineTo(x - 2.4, y - 2.6)
    path.arcTo(QRectF(x - 2.4, y - 5.0, 4.8, 4.8), 180.0, -180.0)
    if not opened:
        path.lineTo(x + 2.4, y - 0.6)
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(colour, 1.3))
    painter.drawPath(path)


def _unknown(painter: QPainter, x: float, y: float, tokens: Tokens) -> None:
    box = QRectF(x - 4.8, y - 5.5, 9.6, 11.0)
    painter.setPen(NO_PEN)
    painter.setBrush(tokens.unks)
    painter.drawRoundedRect(box, 2.0, 2.0)
    painter.setBrush(hatch(faded(tokens.unk, 0.35)))
    painter.setPen(pen(tokens.unk, 1.0, (2.0, 1.5)))
    painter.drawRoundedRect(box, 2.0, 2.0)
    painter.setPen(tokens.unk)
    painter.setFont(mono_font(9, 700))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, "?")
