"""The sky of a scene, and plates with words over it: names of things, and what the world tells."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QLinearGradient, QPainter, QPen

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, RADIUS_CONTROL, Tokens, mono_font, text_font
from smsl_studio.studio.running.scene.name_places import SMALL, free_place, is_aside

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


def paint_names(
    painter: QPainter, things: Sequence[tuple[str, QRectF]], room: QRectF, tokens: Tokens
) -> None:
    """Paint the names of things close to what they cover, none over another or over a small thing.
    A line leads from a name that has to stand aside to its thing."""
    painter.setFont(mono_font(12, 600))
    metrics = QFontMetricsF(painter.font())
    taken = [seen for _, seen in things if max(seen.width(), seen.height()) < SMALL]
    for name, seen in things:
        words, foot = plain_text(name), (seen.center().x(), seen.bottom())
        wide = max(18.0, metrics.horizontalAdvance(words) + 10)
        box = free_place(foot, wide, taken, room)
        taken.append(box)
        if is_aside(box, foot):
            painter.setPen(QPen(tokens.tx3, 1.0))
            painter.drawLine(box.center(), seen.center())
        paint_plate(painter, box, words, tokens.tx, tokens)


def paint_sky(painter: QPainter, room: QRect, tokens: Tokens) -> None:
    """Paint what is behind all things."""
    sky = QLinearGradient(0, 0, 0, room.height())
    sky.setColorAt(0, tokens.win if tokens.dark else QColor("#e9edf3"))
    sky.setColorAt(1, tokens.canvas)
    painter.fillRect(room, sky)
