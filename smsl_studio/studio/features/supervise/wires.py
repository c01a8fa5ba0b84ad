"""The wires of the partial view: from the active state to the cards, and on to their targets. And
the dots behind them."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPolygonF

from smsl_studio.front.views.partial import (
    NEXT,
    PAUSED,
    PROPOSED,
    PRUNED,
    REFUSED,
    RISKY,
    RUNNING,
    UNKNOWN,
    VETOED,
    WAITS,
)
from smsl_studio.studio.base.paint.ink import faded, pen
from smsl_studio.studio.base.theme import Tokens

HEAD = 8.0
DOTS = 16
"""The distance of the dots of the background (pixels)."""
LIT = (WAITS, PROPOSED, RUNNING, PAUSED, NEXT)
FAN = 5.0
"""Pixels between two wires where they leave the state."""


def wire_pen(standing: str, tokens: Tokens) -> QPen:
    """The pen for the wire of an operation; dashes say the same as colours."""
    t = tokens
    if standing in (WAITS, RUNNING, PAUSED):
        return pen(t.acc, 2.2)
    if standing == PROPOSED:
        return pen(t.acc, 2.2, (4.0, 3.0))
    if standing == NEXT:
        return pen(t.acc, 1.8, (4.0, 4.0))
    if standing == UNKNOWN:
        return pen(t.edge, 1.4, (6.0, 3.0))
    if standing == PRUNED:
        return pen(t.edge, 1.5, (2.0, 4.0))
    if standing == RISKY:
        return pen(t.risk, 1.5)
    return pen(t.dim if standing in (REFUSED, VETOED) else t.edge, 1.4)


def curve(start: QPointF, end: QPointF) -> QPainterPath:
    """A curve that begins and ends horizontally."""
    path = QPainterPath(start)
    bend = max((end.x() - start.x()) * 0.55, 16.0)
    path.cubicTo(QPointF(start.x() + bend, start.y()), QPointF(end.x() - bend, end.y()), end)
    return path


def draw_wire(
    painter: QPainter, start: QPointF, end: QPointF, standing: str, tokens: Tokens, head: bool
) -> None:
    """Draw one wire; ``head`` adds an arrowhead."""
    line = wire_pen(standing, tokens)
    stop = QPointF(end.x() - (HEAD - 2 if head else 0), end.y())
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(line)
    painter.drawPath(curve(start, stop))
    if head:
        draw_head(painter, end, line.color())


def draw_head(painter: QPainter, tip: QPointF, colour: QColor) -> None:
    """Draw an arrowhead that points to the right."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    painter.drawPolygon(
        QPolygonF([tip, tip + QPointF(-HEAD, -HEAD / 2), tip + QPointF(-HEAD, HEAD / 2)])
    )


def draw_way(painter: QPainter, start: QPointF, end: QPointF, tokens: Tokens) -> None:
    """Draw the line from the previous to the active state, on a wide pale band."""
    stop = QPointF(end.x() - HEAD + 2, end.y())
    painter.setPen(pen(faded(tokens.acc, 0.16), 9))
    painter.drawLine(start, stop)
    painter.setPen(pen(tokens.acc, 2.4))
    painter.drawLine(start, stop)
    draw_head(painter, end, tokens.acc)


def draw_way_down(painter: QPainter, x: float, top: float, end: float, tokens: Tokens) -> None:
    """Draw the same line downwards."""
    painter.save()
    painter.translate(x, top)
    painter.rotate(90)
    draw_way(painter, QPointF(0, 0), QPointF(end - top, 0), tokens)
    painter.restore()


def fan(count: int) -> list[float]:
    """The vertical offsets from the middle at which so many wires leave the state (pixels)."""
    apart = min(FAN, 36.0 / max(count, 1))
    return [(at - (count - 1) / 2) * apart for at in range(count)]


def draw_dots(painter: QPainter, rect: QRect, tokens: Tokens) -> None:
    """Paint the dots of the background, 16 pixels apart."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(tokens.dot)
    for y in range(rect.top() // DOTS * DOTS, rect.bottom() + 1, DOTS):
        for x in range(rect.left() // DOTS * DOTS, rect.right() + 1, DOTS):
            painter.drawRect(x, y, 1, 1)
