"""The things of a room in outline, on a grid in which 1 is half of a thing's width."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

HALF = 15.0
"""Half of the width of a thing, in pixels."""


def draw_thing(painter: QPainter, what: str, at: QPointF, ink: QColor, ground: QColor) -> None:
    """Draw one thing around a point. The pen keeps its dashes."""
    painter.save()
    painter.translate(at)
    pen = QPen(painter.pen())
    pen.setColor(ink)
    pen.setWidthF(1.4)
    painter.setPen(pen)
    painter.setBrush(ground)
    _DRAWN.get(what, _box)(painter, ink)
    painter.restore()


def draw_patient(painter: QPainter, table: QRectF, line: QColor, ground: QColor) -> None:
    """Draw the table and a patient who lies on it."""
    painter.save()
    painter.setPen(QPen(line, 1.2))
    painter.setBrush(ground)
    painter.drawRoundedRect(table, 10, 10)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    middle, wide = table.center().y(), table.width()
    head = QPointF(table.left() + 0.12 * wide, middle)
    painter.drawEllipse(head, 0.055 * wide, 0.045 * wide)
    body = QRectF(table.left() + 0.18 * wide, middle - 0.09 * wide, 0.4 * wide, 0.18 * wide)
    painter.drawRoundedRect(body, 16, 16)
    for side in (-1, 1):
        leg = QPolygonF(
            [
                QPointF(body.right(), middle + side * 0.06 * wide),
                QPointF(table.right() - 0.06 * wide, middle + side * 0.035 * wide),
                QPointF(table.right() - 0.06 * wide, middle + side * 0.012 * wide),
                QPointF(body.right(), middle + side * 0.008 * wide),
            ]
        )
        painter.drawPolyline(leg)
    painter.restore()


def _box(painter: QPainter, ink: QColor) -> None:
    painter.drawRoundedRect(QRectF(-11, -9, 22, 18), 4, 4)


def _reader(painter: QPainter, ink: QColor) -> None:
    painter.drawEllipse(QPointF(0, 0), 11, 11)
    painter.setBrush(ink)
    painter.drawEllipse(QPointF(0, 0), 2.4, 2.4)


def _monitor(painter: QPainter, ink: QColor) -> None:
    painter.drawRoundedRect(QRectF(-18, -12, 36, 24), 4, 4)
    wave = [(-14, 0), (-6, 0), (-3, -6), (1, 7), (4, 0), (14, 0)]
    painter.drawPolyline(QPolygonF([QPointF(x, y) for x, y in wave]))


def _lights(painter: QPainter, ink: QColor) -> None:
    painter.drawEllipse(QPointF(0, 0), 13, 13)
    painter.drawEllipse(QPointF(0, 0), 6, 6)


def _tracker(painter: QPainter, ink: QColor) -> None:
    painter.drawRoundedRect(QRectF(-6, -19, 12, 38), 6, 6)
    painter.setBrush(ink)
    for y in (-10, 10):
        painter.drawEllipse(QPointF(0, y), 2.8, 2.8)


def _arm(painter: QPainter, ink: QColor) -> None:
    painter.drawRoundedRect(QRectF(-26, -14, 52, 28), 5, 5)
    painter.drawLine(QPointF(-4, -14), QPointF(-4, -34))
    painter.drawLine(QPointF(4, -14), QPointF(4, -34))
    painter.drawArc(QRectF(-30, -92, 60, 60), 0, 360 * 16)


def _drill(painter: QPainter, ink: QColor) -> None:
    painter.rotate(-20)
    painter.drawRoundedRect(QRectF(-12, -5, 18, 9), 2, 2)
    painter.drawRoundedRect(QRectF(-6, 4, 6, 9), 2, 2)
    painter.drawLine(QPointF(6, 0), QPointF(16, 0))


def _tray(painter: QPainter, ink: QColor) -> None:
    painter.drawRoundedRect(QRectF(-40, -20, 80, 40), 6, 6)


def _camera(painter: QPainter, ink: QColor) -> None:
    painter.drawRoundedRect(QRectF(-11, -7, 16, 14), 3, 3)
    painter.drawPolygon(QPolygonF([QPointF(5, -3), QPointF(12, -7), QPointF(12, 7), QPointF(5, 3)]))


_DRAWN = {
    "reader": _reader,
    "monitor": _monitor,
    "lights": _lights,
    "tracker": _tracker,
    "arm": _arm,
    "drill": _drill,
    "tray": _tray,
    "camera": _camera,
}
