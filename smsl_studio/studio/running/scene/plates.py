"""Words on plates over a scene: the names of things, and at the foot what the world tells."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, RADIUS_CONTROL, Tokens, text_font

EDGE, PLATE = 12.0, 24.0
"""The distance of the plates from the edges of the scene, and their height (pixels)."""


def plates(told: Sequence[str]) -> list[QRectF]:
    """Return the places of some words beside each other, from the left edge and at the height 0."""
    metrics, left, made = QFontMetricsF(text_font(12)), EDGE, []
    for words in told:
        wide = metrics.horizontalAdvance(words) + 20
        made.append(QRectF(left, 0.0, wide, PLATE))
        left += wide + 8
    return made


def paint_plate(painter: QPainter, box: QRectF, words: str, colour: QColor, tokens: Tokens) -> None:
    """Paint words in the font of the painter on a plate."""
    radius = RADIUS_CHIP if box.width() <= 20 else RADIUS_CONTROL
    painter.setPen(QPen(tokens.line2, 1))
    painter.setBrush(tokens.surf)
    painter.drawRoundedRect(box, radius, radius)
    painter.setPen(colour)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, plain_text(words))
