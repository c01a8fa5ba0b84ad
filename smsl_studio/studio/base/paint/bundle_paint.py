"""Painting of a bundle: a thick line for several operations, and the chip with their number."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QPainter

from smsl_studio.picture.bundles import CHIP, chip_size, line_width
from smsl_studio.picture.shape import EdgeShape
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
    painter: QPainter, shape: EdgeShape, count: int, back: bool, colour: QColor, ink: LineInk
) -> None:
    """Paint the line of ``count`` operations, with a head at each end to which one leads.

    ``back`` is true if one of them leads the other way than the first.
    """
    unit = ink.unit
    head = (HEAD + WIDER - (1.0 if ink.compact else 0.0)) * unit
    short = head - 2.0 * unit
    first = short if back else 0.0
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(colour, line_width(count) * unit))
    painter.drawPolyline(polyline(shape.cut(first, max(shape.length - short, first))))
    paint_head(painter, shape, colour, head)
    if back:
        paint_head(painter, shape.reversed, colour, head)


def paint_count(
    painter: QPainter, at: tuple[float, float], count: int, ink: Ink, chosen: bool = False
) -> None:
    """Paint the chip with the number of operations, centred on a point (mark pixels)."""
    tokens = ink.tokens
    (x, y), (wide, high) = at, chip_size(count)
    painter.setPen(pen(tokens.slate if chosen else tokens.edge, 1.0))
    painter.setBrush(tokens.slate if chosen else tokens.canvas)
    painter.drawRoundedRect(QRectF(x - wide / 2, y - high / 2, wide, high), CHIP / 2, CHIP / 2)
    ink.label.draw(painter, x, y, str(count), tokens.onslate if chosen else tokens.tx)
