"""Painting of a bundle: a thick line for several operations, and the chip with their number."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPolygonF

from smsl_studio.picture.bundles import chip_size
from smsl_studio.picture.returns import (
    CHIP_SIDES,
    HOUSE,
    house,
    lane_chip_size,
    lane_words,
    stub_of,
)
from smsl_studio.picture.shape import EdgeShape, NodeBox
from smsl_studio.studio.base.paint.edge_paint import HEAD, LineInk, paint_head, polyline
from smsl_studio.studio.base.paint.ink import NO_BRUSH, Ink, pen
from smsl_studio.studio.base.theme import Tokens

WIDER = 1.0
"""How much longer the heads are than those of one operation (mark pixels)."""


def bundle_colour(tokens: Tokens, chosen: bool, dimmed: bool) -> QColor:
    """The colour of a bundle; ``chosen`` is true while its card is open."""
    if chosen:
        return tokens.slate
    return tokens.dim if dimmed else tokens.edge


def paint_bundle(
    painter: QPainter, shape: EdgeShape, width: float, back: bool, colour: QColor, ink: LineInk
) -> None:
    """Paint the line of a bundle, with a head at each end to which an operation leads.

    ``back`` is true if one of them leads the other way than the first.
    """
    unit = ink.unit
    head = (HEAD + WIDER - (1.0 if ink.compact else 0.0)) * unit
    short = head - 2.0 * unit
    first = short if back else 0.0
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(colour, width * unit))
    painter.drawPolyline(polyline(shape.cut(first, max(shape.length - short, first))))
    paint_head(painter, shape, colour, head)
    if back:
        paint_head(painter, shape.reversed, colour, head)


def paint_count(
    painter: QPainter, at: tuple[float, float], count: int, ink: Ink, chosen: bool = False
) -> None:
    """Paint the chip with the number of operations, centred on a point (mark pixels)."""
    x, y = at
    colour = _ground(painter, at, chip_size(count), ink.tokens, chosen)
    ink.label.draw(painter, x, y, str(count), colour)


def paint_lane_chip(
    painter: QPainter, at: tuple[float, float], count: int, ink: Ink, chosen: bool = False
) -> None:
    """Paint the chip of the lane back to the start: a house, and how many operations lead there."""
    (x, y), size = at, lane_chip_size(count)
    colour = _ground(painter, at, size, ink.tokens, chosen)
    left = x - size[0] / 2
    painter.setPen(pen(colour if chosen else ink.tokens.acc, 1.3))
    painter.setBrush(NO_BRUSH)
    corners = house(left + CHIP_SIDES / 2 - 1.0, y)
    painter.drawPolygon(QPolygonF([QPointF(*corner) for corner in corners]))
    begin = left + CHIP_SIDES / 2 + HOUSE / 2 + 3.0
    ink.label.draw_from(painter, begin, y, lane_words(count), colour)


def paint_stub(painter: QPainter, box: NodeBox, colour: QColor, unit: float) -> None:
    """Paint the mark below a state from which an operation leads back to the start (scene
    units)."""
    line = [QPointF(*point) for point in stub_of(box, unit)]
    end, size = line[-1], 4.0 * unit
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(colour, 1.5 * unit))
    painter.drawPolyline(line)
    painter.drawPolyline([QPointF(end.x() + size, end.y() - size), end,
                          QPointF(end.x() + size, end.y() + size)])  # fmt: skip


def _ground(
    painter: QPainter,
    at: tuple[float, float],
    size: tuple[float, float],
    tokens: Tokens,
    chosen: bool,
) -> QColor:
    """Paint the ground of a chip; returns the colour of its words."""
    (x, y), (wide, high) = at, size
    painter.setPen(pen(tokens.slate if chosen else tokens.edge, 1.0))
    painter.setBrush(tokens.slate if chosen else tokens.canvas)
    painter.drawRoundedRect(QRectF(x - wide / 2, y - high / 2, wide, high), high / 2, high / 2)
    return tokens.onslate if chosen else tokens.tx
