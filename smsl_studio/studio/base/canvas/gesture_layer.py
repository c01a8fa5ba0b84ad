"""The layer that shows a gesture: band, drawn line, sketch, guides, handle, grip and bends."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath
from PySide6.QtWidgets import QGraphicsItem, QGraphicsView, QStyleOptionGraphicsItem, QWidget

from smsl_studio.picture.guides import Guide
from smsl_studio.studio.base.canvas.line_marks import LineMarks, paint_line_marks
from smsl_studio.studio.base.canvas.sketch import Sketch, paint_sketch
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, Ink, faded, pen

HANDLE_RADIUS = 8.0
BEYOND = 90.0
"""How far a guide goes beyond the centre of the last node on it (scene units)."""


@dataclass
class DrawnOperation:
    """The line of an operation that the user is drawing, from the source to the pointer (scene
    points)."""

    start: QPointF
    end: QPointF
    refused: bool = False
    moves_start: bool = False
    """Whether the pointer is at ``start``, and the operation leads to ``end`` as before."""
    ghost: bool = False
    """Whether the line ends on empty canvas, where a new state would be added."""


class GestureLayer(QGraphicsItem):
    """The topmost layer of the scene. Its signs have the same size in pixels at every zoom."""

    def __init__(self, view: QGraphicsView) -> None:
        super().__init__()
        self._view = view
        self._rect = QRectF()
        self.ink: Ink | None = None
        self.band: QRectF | None = None
        self.drawn: DrawnOperation | None = None
        self.handle: QPointF | None = None
        self.taken = False
        """Whether a press would take the handle."""
        self.grip: QPointF | None = None
        """The arrowhead of the selected operation."""
        self.tail: QPointF | None = None
        """The beginning of the selected operation."""
        self.guides: tuple[Guide, ...] = ()
        self.sketch: Sketch | None = None
        self.line: LineMarks | None = None
        self.setZValue(40.0)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)

    def cover(self, rect: QRectF) -> None:
        """Set the part of the scene that this layer covers."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect

    def clear(self) -> None:
        """Remove everything."""
        for name in ("band", "drawn", "sketch", "handle", "grip", "tail", "line"):
            self.put(name, None)
        self.put("guides", ())
        self.put("taken", False)

    def put(self, name: str, value: object) -> None:
        """Set one of the things that this layer shows, such as ``band`` or ``drawn``, and repaint
        only what it covers."""
        before = self._area()
        setattr(self, name, value)
        dirty = before.united(self._area())
        if not dirty.isEmpty() and self.scene() is not None:
            self.scene().update(dirty)

    def _area(self) -> QRectF:
        pixel = 1.0 / (self._view.transform().m11() or 1.0)
        rect = QRectF()
        if self.band is not None:
            rect = rect.united(self.band.normalized())
        ends = (self.drawn.start, self.drawn.end) if self.drawn is not None else ()
        for point in (self.handle, self.grip, self.tail, *ends):
            if point is not None:
                rect = rect.united(QRectF(point.x(), point.y(), pixel, pixel))
        for line in self._guide_lines():
            rect = rect.united(QRectF(line.p1(), line.p2()).adjusted(0.0, 0.0, pixel, pixel))
        if self.sketch is not None:
            rect = rect.united(self.sketch.area)
        if self.line is not None:
            rect = rect.united(self.line.area(pixel))
        pad = 16.0 * pixel
        if self.drawn is not None:
            pad = 80.0 * max(pixel, 1.0)
        return rect.adjusted(-pad, -pad, pad, pad) if not rect.isNull() else rect

    def boundingRect(self) -> QRectF:
        """The part of the scene that ``cover`` has set."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint guides, band, line, sketch, handle, bends and grip, if they are set."""
        ink = self.ink
        if ink is None:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pixel = 1.0 / (self._view.transform().m11() or 1.0)
        if self.guides:
            painter.setPen(pen(ink.tokens.acc, pixel))
            painter.drawLines(self._guide_lines())
        if self.band is not None:
            painter.setPen(pen(ink.tokens.acc, pixel))
            painter.setBrush(faded(ink.tokens.acc, 0.08))
            painter.drawRect(self.band)
        if self.drawn is not None:
            self._paint_drawn(painter, self.drawn, ink, pixel)
        if self.sketch is not None:
            paint_sketch(painter, self.sketch, ink, pixel)
        if self.handle is not None:
            _paint_plus(painter, self.handle, ink, pixel, self.taken)
        if self.line is not None:
            paint_line_marks(painter, self.line, ink, pixel)
        for end in (self.tail, self.grip):
            if end is not None:
                _paint_grip(painter, end, ink, pixel)

    def _guide_lines(self) -> list[QLineF]:
        """The guides as they are drawn: longer than from centre to centre, to be seen beside the
        nodes."""
        lines = []
        for x, y, x_end, y_end in self.guides:
            across, down = (0.0, BEYOND) if x == x_end else (BEYOND, 0.0)
            lines.append(QLineF(x - across, y - down, x_end + across, y_end + down))
        return lines

    def _paint_drawn(
        self, painter: QPainter, drawn: DrawnOperation, ink: Ink, pixel: float
    ) -> None:
        colour = ink.tokens.bad if drawn.refused else ink.tokens.acc
        step = drawn.end - drawn.start
        size = (step.x() ** 2 + step.y() ** 2) ** 0.5 or 1.0
        unit = step / size
        tip = drawn.end
        line = pen(colour, 2.0 * pixel, (4.0 * pixel, 3.0 * pixel))
        if drawn.ghost:
            box = QRectF(tip.x() - 54.0, tip.y() - 27.0, 108.0, 54.0)
            painter.setPen(pen(colour, 1.6 * pixel, (4.0 * pixel, 3.0 * pixel)))
            painter.setBrush(ink.tokens.surf)
            painter.drawRoundedRect(box, 8.0, 8.0)
            painter.save()
            ink.name.draw(painter, tip.x(), tip.y(), "New state", ink.tokens.tx)
            painter.restore()
            reach = min(54.0 / max(abs(unit.x()), 1e-6), 27.0 / max(abs(unit.y()), 1e-6))
            tip = tip - unit * min(reach + 2.0, size)
        painter.setPen(line)
        painter.setBrush(NO_BRUSH)
        painter.drawLine(drawn.start, tip - unit * 7.0 * pixel)
        head = QPainterPath(tip)
        across = QPointF(-unit.y(), unit.x()) * 4.2 * pixel
        base = tip - unit * 9.0 * pixel
        head.lineTo(base + across)
        head.lineTo(base - across)
        head.closeSubpath()
        painter.setPen(NO_PEN)
        painter.setBrush(colour)
        painter.drawPath(head)
        (_paint_grip if drawn.moves_start else _paint_plus)(painter, drawn.start, ink, pixel)


def _paint_grip(painter: QPainter, at: QPointF, ink: Ink, pixel: float) -> None:
    painter.setPen(pen(ink.tokens.acc, 2.0 * pixel))
    painter.setBrush(ink.tokens.surf)
    painter.drawEllipse(at, 4.5 * pixel, 4.5 * pixel)


def _paint_plus(
    painter: QPainter, at: QPointF, ink: Ink, pixel: float, filled: bool = False
) -> None:
    painter.setPen(pen(ink.tokens.acc, 1.6 * pixel))
    painter.setBrush(ink.tokens.acc if filled else ink.tokens.surf)
    painter.drawEllipse(at, 7.0 * pixel, 7.0 * pixel)
    painter.setPen(pen(ink.tokens.onacc if filled else ink.tokens.acc, 1.6 * pixel))
    k = 3.6 * pixel
    painter.drawLine(at - QPointF(k, 0), at + QPointF(k, 0))
    painter.drawLine(at - QPointF(0, k), at + QPointF(0, k))
