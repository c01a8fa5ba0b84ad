"""The dashed path and the words of a ghost, painted over the picture of a world."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPen, QPolygonF

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens, text_font
from smsl_studio.studio.running.scene.camera import WorldCamera
from smsl_studio.studio.running.scene.ghost import GhostPlace

HIGH, AWAY = 24.0, 18.0
"""The height of the words, and how far they stand from the tip of the tool (pixels)."""


def paint_ghost_words(
    painter: QPainter, room: QSizeF, camera: WorldCamera, place: GhostPlace, tool: int,
    tokens: Tokens,
) -> QRectF:  # fmt: skip
    """Paint the way of the shape with the number ``tool``, and the words at its end.

    Returns where the words stand (pixels); an empty place if they are not in the picture.
    """
    at = 7 * tool
    points = np.array([one[at : at + 3] for one in (*place.path, place.poses)])
    found = camera.pixels(points, room.width(), room.height())
    if found is None:
        return QRectF()
    line = [QPointF(x, y) for x, y in found.tolist()]
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(tokens.surf, 3.0))
    painter.drawPolyline(QPolygonF(line[:-1]))
    painter.setPen(QPen(tokens.acc, 2.0, Qt.PenStyle.CustomDashLine))
    dashes = painter.pen()
    dashes.setDashPattern([2.0, 2.0])
    painter.setPen(dashes)
    painter.drawPolyline(QPolygonF(line[:-1]))
    return _paint_words(painter, room, line[-1], place, tokens)


def _paint_words(
    painter: QPainter, room: QSizeF, tip: QPointF, place: GhostPlace, tokens: Tokens
) -> QRectF:
    if not QRectF(QPointF(0, 0), room).contains(tip):
        return QRectF()
    painter.setFont(text_font(12, 500))
    wide = QFontMetricsF(painter.font()).horizontalAdvance(place.words) + 20
    left = tip.x() + AWAY if tip.x() + AWAY + wide < room.width() - 8 else tip.x() - AWAY - wide
    box = QRectF(max(left, 8.0), min(max(tip.y() - HIGH / 2, 48.0), room.height() - 72), wide, HIGH)
    painter.setPen(QPen(tokens.acc, 1.2, Qt.PenStyle.DashLine))
    painter.setBrush(tokens.accs)
    painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
    painter.setPen(tokens.acc)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, plain_text(place.words))
    return box
