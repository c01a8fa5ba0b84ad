"""A sketch: states and operations that an edit would add, as the canvas shows them before it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter, QPainterPath

from smsl_studio.picture.levels import FULL_SIZE
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, Ink, pen

LOOP = 26.0
"""The width of a sketched loop (scene units)."""


@dataclass(frozen=True)
class Sketch:
    """States as (rectangle, name), operations as (rectangle of source, of target, name).

    All rectangles are in scene units.
    """

    states: tuple[tuple[QRectF, str], ...] = ()
    operations: tuple[tuple[QRectF, QRectF, str], ...] = ()

    @property
    def area(self) -> QRectF:
        """The part of the scene that it covers."""
        area = QRectF()
        for rect in self._rects():
            area = area.united(rect)
        return area.adjusted(-60.0, -60.0, 60.0, 60.0) if not area.isNull() else area

    def _rects(self) -> Iterable[QRectF]:
        yield from (rect for rect, _ in self.states)
        for source, target, _ in self.operations:
            yield source
            yield target


def node_rect(at: tuple[float, float]) -> QRectF:
    """The rectangle of a new state whose centre is at a scene point."""
    wide, high = FULL_SIZE
    return QRectF(at[0] - wide / 2, at[1] - high / 2, wide, high)


def paint_sketch(painter: QPainter, sketch: Sketch, ink: Ink, pixel: float) -> None:
    """Paint it dashed, in the accent colour. ``pixel`` is one pixel in scene units."""
    dashes = (4.0 * pixel, 3.0 * pixel)
    for source, target, name in sketch.operations:
        painter.setPen(pen(ink.tokens.acc, 2.0 * pixel, dashes))
        painter.setBrush(NO_BRUSH)
        if source == target:
            corner = source.bottomRight()
            painter.drawEllipse(corner, LOOP / 2, LOOP / 2)
            _paint_name(painter, corner + QPointF(LOOP, LOOP), name, ink)
            continue
        start, end = _border(source, target.center()), _border(target, source.center())
        painter.drawLine(start, end)
        _paint_head(painter, start, end, ink, pixel)
        _paint_name(painter, (start + end) / 2, name, ink)
    for rect, name in sketch.states:
        painter.setPen(pen(ink.tokens.acc, 1.6 * pixel, dashes))
        painter.setBrush(ink.tokens.surf)
        painter.drawRoundedRect(rect, 8.0, 8.0)
        shown = ink.name.elided(name, rect.width() - 12.0)
        ink.name.draw(painter, rect.center().x(), rect.center().y(), shown, ink.tokens.tx)


def _border(rect: QRectF, to: QPointF) -> QPointF:
    """Where the line from the middle of a node to a point leaves the node."""
    step = to - rect.center()
    reach = min(
        rect.width() / 2 / max(abs(step.x()), 1e-6), rect.height() / 2 / max(abs(step.y()), 1e-6)
    )
    return rect.center() + step * min(reach, 0.5)


def _paint_head(painter: QPainter, start: QPointF, end: QPointF, ink: Ink, pixel: float) -> None:
    step = end - start
    unit = step / ((step.x() ** 2 + step.y() ** 2) ** 0.5 or 1.0)
    across, base = QPointF(-unit.y(), unit.x()) * 4.2 * pixel, end - unit * 9.0 * pixel
    head = QPainterPath(end)
    head.lineTo(base + across)
    head.lineTo(base - across)
    head.closeSubpath()
    painter.setPen(NO_PEN)
    painter.setBrush(ink.tokens.acc)
    painter.drawPath(head)


def _paint_name(painter: QPainter, at: QPointF, name: str, ink: Ink) -> None:
    if name:
        wide = ink.label.width(name) + 8.0
        painter.setPen(NO_PEN)
        painter.setBrush(ink.tokens.canvas)
        painter.drawRect(QRectF(at.x() - wide / 2, at.y() - 8.0, wide, 16.0))
        ink.label.draw(painter, at.x(), at.y(), name, ink.tokens.acc)
