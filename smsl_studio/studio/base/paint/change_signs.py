"""Signs of a comparison: each change has a sign, a line pattern and a colour.

In a merge the letters of the sides stand before the sign: M is a filled square, T an outlined disc.

Sign and pattern are enough without the colour. Red is kept for errors, so what was removed is not
red.
"""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, pen
from smsl_studio.studio.base.theme import Tokens, text_font

MINE, THEIRS, BASE = "M", "T", "B"
SIDES = MINE + THEIRS
PROPOSED = "?"
"""Stands before the sign of what is proposed in a run and does not count yet."""
SIGN_WIDTH = 13.0
"""Pixels from one sign to the next."""


def draw_side(
    painter: QPainter, x: float, y: float, radius: float, letter: str, tokens: Tokens
) -> None:
    """Draw the sign of a side of a merge: M a filled square, T an outlined disc, B a short line."""
    area = QRectF(x - radius, y - radius, 2 * radius, 2 * radius)
    if letter == BASE:
        painter.setPen(pen(tokens.accl, 2.0))
        painter.drawLine(QPointF(x - radius, y), QPointF(x + radius, y))
        return
    mine = letter == MINE
    painter.setPen(NO_PEN if mine else pen(tokens.slate, 1.4))
    painter.setBrush(tokens.acc if mine else tokens.surf)
    if mine:
        painter.drawRoundedRect(area, 2.5, 2.5)
    else:
        painter.drawEllipse(area)
    painter.setBrush(NO_BRUSH)
    painter.setPen(tokens.onacc if mine else tokens.slate)
    painter.setFont(text_font(max(8, round(radius * 1.5)), 700))
    painter.drawText(area, Qt.AlignmentFlag.AlignCenter, letter)


def draw_conflict(painter: QPainter, x: float, y: float, number: str, tokens: Tokens) -> None:
    """Draw the disc of a conflict or a difference with its number; a tick if it is chosen."""
    painter.setPen(NO_PEN)
    chosen = number == CHOSEN
    painter.setBrush(conflict_colour(number, tokens))
    number = number.lstrip(MISSING + ODD)
    half = max(8.0, 3.2 * len(number) + 4.0)
    painter.drawRoundedRect(QRectF(x - half, y - 8.0, 2 * half, 16.0), 8.0, 8.0)
    painter.setBrush(NO_BRUSH)
    if chosen:
        painter.setPen(pen(tokens.onacc, 1.8))
        tick = [QPointF(x - 3.6, y + 0.2), QPointF(x - 1.0, y + 2.8), QPointF(x + 3.8, y - 2.8)]
        painter.drawPolyline(QPolygonF(tick))
        return
    painter.setPen(tokens.onacc)
    painter.setFont(text_font(11, 600))
    area = QRectF(x - half, y - 8.0, 2 * half, 16.0)
    painter.drawText(area, Qt.AlignmentFlag.AlignCenter, number)


def conflict_colour(number: str, tokens: Tokens) -> QColor:
    """The colour of the ring of a conflict, and of the disc with a number."""
    if number.startswith(MISSING):
        return tokens.acc
    return tokens.ok if number == CHOSEN else tokens.bad


CHOSEN = "\u2713"
"""Stands for the number of a conflict that is chosen."""


MISSING, ODD = "+", "-"
"""Stand before the number of an operation that the drawing lacks, or that no rule gives."""


def change_colours(sign: str, tokens: Tokens) -> tuple[QColor, QColor]:
    """The line and fill colours for ``+`` (added), ``-`` (removed) or ``~`` (changed), or for the
    side of a merge (``M~``)."""
    if sign[0] in SIDES:
        return (tokens.acc if sign[0] == MINE else tokens.slate), tokens.surf
    return {
        "+": (tokens.ok, tokens.oks),
        "-": (tokens.risk, tokens.risks),
    }.get(sign, (tokens.acc, tokens.accs))


def change_dashes(sign: str) -> tuple[float, ...]:
    """The dashes of the line; empty for a solid line."""
    return (4.0, 3.0) if sign.endswith("-") or sign.startswith(PROPOSED) else ()


def draw_change(
    painter: QPainter, x: float, y: float, radius: float, sign: str, tokens: Tokens
) -> None:
    """Draw a filled disc with the sign in it, and before it the sides of a merge, from x on."""
    for letter in sign[:-1].removeprefix(PROPOSED):
        draw_side(painter, x, y, radius, letter, tokens)
        x += SIGN_WIDTH
    sign = sign[-1]
    painter.setPen(NO_PEN)
    painter.setBrush(change_colours(sign, tokens)[0])
    painter.drawEllipse(QPointF(x, y), radius, radius)
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(tokens.onacc, 1.5))
    arm = radius * 0.55
    if sign == "~":
        wave = [(-1.0, 0.2), (-0.5, -0.45), (0.0, 0.0), (0.5, 0.45), (1.0, -0.2)]
        painter.drawPolyline(QPolygonF([QPointF(x + a * arm, y + b * arm) for a, b in wave]))
        return
    painter.drawLine(QPointF(x - arm, y), QPointF(x + arm, y))
    if sign == "+":
        painter.drawLine(QPointF(x, y - arm), QPointF(x, y + arm))
