"""Signs of a comparison: each change has a sign, a line pattern and a colour.

Sign and pattern are enough without the colour. Red is kept for errors, so what was removed is not
red.
"""

from __future__ import annotations

from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPainter, QPolygonF

from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, pen
from smsl_studio.studio.base.theme import Tokens


def change_colours(sign: str, tokens: Tokens) -> tuple[QColor, QColor]:
    """The line and fill colours for ``+`` (added), ``-`` (removed) or ``~`` (changed)."""
    return {
        "+": (tokens.ok, tokens.oks),
        "-": (tokens.risk, tokens.risks),
    }.get(sign, (tokens.acc, tokens.accs))


def change_dashes(sign: str) -> tuple[float, ...]:
    """The dashes of the line; empty for a solid line."""
    return (4.0, 3.0) if sign == "-" else ()


def draw_change(
    painter: QPainter, x: float, y: float, radius: float, sign: str, tokens: Tokens
) -> None:
    """Draw a filled disc with the sign in it."""
    painter.setPen(NO_PEN)
    painter.setBrush(change_colours(sign, tokens)[0])
    painter.drawEllipse(QPointF(x, y), radius, radius)
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(tokens.onacc, 1.5))
    arm = radius * 0.55
    if sign == "~":
        wave = [(-1.0, 0.2), (-0.5, -0.45), (0.0, 0.0), (0.5, 0.45), (1.0, -0.2)]
        painter.drawPolyline(QPolygonF([QPointF(x + a * arm, y + b * arm) for a, b in wave]))
        return
    painter.drawLine(QPointF(x - arm, y), QPointF(x + arm, y))
    if sign == "+":
        painter.drawLine(QPointF(x, y - arm), QPointF(x, y + arm))
