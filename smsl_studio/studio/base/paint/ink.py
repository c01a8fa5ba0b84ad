"""Ink: the fonts, text sizes and small signs that all painters of the canvas use."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import (
    QBitmap,
    QBrush,
    QColor,
    QFont,
    QFontMetricsF,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font

ROUND = Qt.PenCapStyle.RoundCap
FLAT = Qt.PenCapStyle.FlatCap
NO_PEN = Qt.PenStyle.NoPen
NO_BRUSH = Qt.BrushStyle.NoBrush


class Type:
    """One font with its metrics; the widths of texts are cached."""

    def __init__(self, font: QFont) -> None:
        self.font = font
        self.metrics = QFontMetricsF(font)
        # Centres on the height of capitals and digits, which looks better than the middle of the
        # line.
        self.rise = self.metrics.capHeight() / 2
        self.width = lru_cache(maxsize=20_000)(self._measured)

    def _measured(self, text: str) -> float:
        return self.metrics.horizontalAdvance(plain_text(text))

    def elided(self, text: str, width: float) -> str:
        """The text, without its middle if it is wider than ``width`` (pixels)."""
        if self.width(text) <= width:
            return text
        return self.metrics.elidedText(plain_text(text), Qt.TextElideMode.ElideMiddle, width)

    def draw(self, painter: QPainter, x: float, y: float, text: str, colour: QColor) -> None:
        """Draw a text centred on (x, y)."""
        painter.setFont(self.font)
        painter.setPen(colour)
        painter.drawText(QPointF(x - self.width(text) / 2, y + self.rise), plain_text(text))

    def draw_from(self, painter: QPainter, x: float, y: float, text: str, colour: QColor) -> None:
        """Draw a text that begins at x, centred on y."""
        painter.setFont(self.font)
        painter.setPen(colour)
        painter.drawText(QPointF(x, y + self.rise), plain_text(text))


class Ink:
    """The fonts and colours of the canvas in one theme."""

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.name = Type(text_font(12, 600))
        self.label = Type(text_font(11, 500))
        self.plain = Type(text_font(12))
        self.strong = Type(text_font(12, 600))
        self.chip = Type(mono_font(12, 500))
        self.short = Type(_spaced(mono_font(12, 600), 0.6))
        self.mono_label = Type(mono_font(11, 500))
        self.boxed = Type(mono_font(11, 700))
        self.count = Type(text_font(9, 600))
        self.note = Type(text_font(11))
        self.note_title = Type(text_font(11, 600))


def _spaced(font: QFont, pixels: float) -> QFont:
    font.setLetterSpacing(QFont.SpacingType.AbsoluteSpacing, pixels)
    return font


def faded(colour: QColor, alpha: float) -> QColor:
    """A colour with this opacity."""
    found = QColor(colour)
    found.setAlphaF(alpha)
    return found


def draw_veil(painter: QPainter, box: QRect, tokens: Tokens) -> None:
    """Half hide the drawing behind floating words, so that the words can be read."""
    painter.fillRect(box, faded(tokens.canvas, 0.88))


def pen(colour: QColor, width: float, dashes: tuple[float, ...] = ()) -> QPen:
    """A pen; ``dashes`` are lengths in the same unit as the width."""
    found = QPen(colour, width)
    found.setCapStyle(FLAT)
    found.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    if dashes:
        found.setDashPattern([d / width for d in dashes])
    return found


def hatch(colour: QColor) -> QBrush:
    """A brush of thin diagonal lines, the sign for unknown."""
    rows = bytes(sum(1 << ((x) % 8) for x in range(8) if (x + y) % 4 == 0) for y in range(8))
    from PySide6.QtCore import QSize

    brush = QBrush(QBitmap.fromData(QSize(8, 8), rows))
    brush.setColor(colour)
    return brush


def rounded_rect(x: float, y: float, w: float, h: float, radius: float) -> QPainterPath:
    """A rectangle with rounded corners, as a path."""
    path = QPainterPath()
    path.addRoundedRect(QRectF(x, y, w, h), radius, radius)
    return path


def draw_octagon(painter: QPainter, x: float, y: float, size: float, tokens: Tokens) -> None:
    """Draw the sign of an error: a filled octagon with a cross."""
    r, c = size / 2, size / 2 * 0.414
    corners = [(-c, -r), (c, -r), (r, -c), (r, c), (c, r), (-c, r), (-r, c), (-r, -c)]
    painter.setPen(NO_PEN)
    painter.setBrush(tokens.bad)
    painter.drawPolygon(QPolygonF([QPointF(x + a, y + b) for a, b in corners]))
    painter.setPen(pen(tokens.surf, max(size * 0.13, 1.0)))
    k = size * 0.19
    painter.drawLine(QPointF(x - k, y - k), QPointF(x + k, y + k))
    painter.drawLine(QPointF(x - k, y + k), QPointF(x + k, y - k))


def draw_warning(painter: QPainter, x: float, y: float, size: float, tokens: Tokens) -> None:
    """Draw the sign of a warning or a risk: a filled triangle with a stroke."""
    r = size / 2
    painter.setPen(pen(tokens.risk, 1.0))
    painter.setBrush(tokens.risk)
    painter.drawPolygon(
        QPolygonF([QPointF(x, y - r), QPointF(x + r, y + r * 0.8), QPointF(x - r, y + r * 0.8)])
    )
    painter.setPen(pen(tokens.surf, max(size * 0.12, 1.2)))
    painter.drawLine(QPointF(x, y - r * 0.35), QPointF(x, y + r * 0.2))
    painter.drawLine(QPointF(x, y + r * 0.42), QPointF(x, y + r * 0.55))


def draw_note(painter: QPainter, x: float, y: float, size: float, tokens: Tokens) -> None:
    """Draw the sign of a note: a circle with an i."""
    r = size / 2 - 0.6
    painter.setPen(pen(tokens.slate, 1.3))
    painter.setBrush(tokens.surf)
    painter.drawEllipse(QPointF(x, y), r, r)
    painter.drawLine(QPointF(x, y - size * 0.04), QPointF(x, y + size * 0.25))
    painter.drawLine(QPointF(x, y - size * 0.25), QPointF(x, y - size * 0.18))


def draw_finding(
    painter: QPainter, x: float, y: float, size: float, letter: str, tokens: Tokens
) -> None:
    """Draw the sign of a finding; ``letter`` is its severity (E, W or I)."""
    draw = {"E": draw_octagon, "W": draw_warning}.get(letter, draw_note)
    draw(painter, x, y, size, tokens)


def draw_sub_mark(
    painter: QPainter, x: float, y: float, kind: str, colour: QColor, ground: QColor
) -> None:
    """Draw the sign rise, fall or mixed, 9 wide, centred on (x, y)."""
    if kind == "mixed":
        painter.setPen(pen(colour, 1.3))
        painter.setBrush(ground)
        r = 4.4
        painter.drawPolygon(
            QPolygonF([QPointF(x, y - r), QPointF(x + r, y), QPointF(x, y + r), QPointF(x - r, y)])
        )
        painter.setPen(NO_PEN)
        painter.setBrush(colour)
        painter.drawPolygon(QPolygonF([QPointF(x, y - r), QPointF(x + r, y), QPointF(x - r, y)]))
        return
    up = -1.0 if kind == "rise" else 1.0
    painter.setPen(NO_PEN)
    painter.setBrush(colour)
    painter.drawPolygon(
        QPolygonF(
            [QPointF(x, y + 4 * up), QPointF(x + 4.2, y - 3.6 * up), QPointF(x - 4.2, y - 3.6 * up)]
        )
    )


def draw_barred(painter: QPainter, x: float, y: float, r: float, tokens: Tokens) -> None:
    """Draw the sign of a pruned operation: a circle with a bar."""
    painter.setPen(pen(tokens.slate, 1.4))
    painter.setBrush(tokens.canvas)
    painter.drawEllipse(QPointF(x, y), r, r)
    k = r * 0.707
    painter.drawLine(QPointF(x - k, y + k), QPointF(x + k, y - k))


def draw_unknown(painter: QPainter, x: float, y: float, size: float, ink: Ink) -> None:
    """Draw the sign for unknown: a hatched, dashed box with a question mark."""
    tokens = ink.tokens
    box = rounded_rect(x - size / 2, y - size / 2, size, size, 4.0)
    painter.setPen(NO_PEN)
    painter.fillPath(box, tokens.unks)
    painter.fillPath(box, hatch(faded(tokens.unk, 0.35)))
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(tokens.unk, 1.2, (3.0, 2.0)))
    painter.drawPath(box)
    ink.chip.draw(painter, x, y, "?", tokens.unk)
