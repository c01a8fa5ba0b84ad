"""Batch painting: QPainter gets a whole numpy buffer in one call."""

from __future__ import annotations

from typing import Any

import numpy as np
import shiboken6
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

Floats = NDArray[np.float64]


def draw_lines(painter: QPainter, lines: Floats) -> None:
    """Draw lines, (n, 4): x1, y1, x2, y2."""
    buffer = np.ascontiguousarray(lines, dtype=np.float64)
    if len(buffer):
        call: Any = painter.drawLines
        call(_wrapped(buffer, QLineF), len(buffer))


def draw_points(painter: QPainter, points: Floats) -> None:
    """Draw points, (n, 2), as dots of the pen's width."""
    buffer = np.ascontiguousarray(points, dtype=np.float64)
    if len(buffer):
        call: Any = painter.drawPoints
        call(_wrapped(buffer, QPointF), len(buffer))


def draw_rects(painter: QPainter, rects: Floats) -> None:
    """Draw rectangles, (n, 4): x, y, width, height."""
    buffer = np.ascontiguousarray(rects, dtype=np.float64)
    if len(buffer):
        call: Any = painter.drawRects
        call(_wrapped(buffer, QRectF), len(buffer))


def _wrapped(buffer: Floats, kind: type) -> Any:
    return shiboken6.wrapInstance(buffer.ctypes.data, kind)


def draw_grid(painter: QPainter, area: QRectF, step: float, size: float, colour: QColor) -> None:
    """Draw small squares at the multiples of ``step`` in an area (scene units)."""
    xs = np.arange(np.floor(area.left() / step), np.ceil(area.right() / step) + 1) * step
    ys = np.arange(np.floor(area.top() / step), np.ceil(area.bottom() / step) + 1) * step
    corners = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2) - size / 2
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colour)
    draw_rects(painter, np.hstack([corners, np.full_like(corners, size)]))
