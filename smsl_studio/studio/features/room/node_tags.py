"""The tags of nodes on the plan of a room."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPen, QPolygonF

from smsl_studio.front.views.room_view import CONTESTED, FRESH, SILENT, STALE, NodeTag
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CHIP, RADIUS_NODE, Tokens, text_font

MARKS = {STALE: "clock", SILENT: "unknown", CONTESTED: "layers"}
"""The icons of the standings. What is fresh has bars."""


def ink_of(tag: NodeTag, tokens: Tokens) -> QColor:
    """The colour of a node's standing."""
    return {FRESH: tokens.ok, CONTESTED: tokens.bad}.get(tag.standing, tokens.unk)


def ground_of(tag: NodeTag, tokens: Tokens) -> QColor:
    """The colour below a node's words."""
    grounds = {SILENT: tokens.unks, CONTESTED: tokens.bads}
    return grounds.get(tag.standing, tokens.surf)


def dashed(ink: QColor, wide: float) -> QPen:
    """A dashed pen."""
    pen = QPen(ink, wide)
    pen.setDashPattern([4, 3])
    return pen


def paint_tag(painter: QPainter, tag: NodeTag, place: QRectF, chosen: bool, tokens: Tokens) -> None:
    """Paint the tag of a node: its name, the number of its facts, a mark and its age."""
    fresh = tag.standing == FRESH
    ink = ink_of(tag, tokens)
    painter.setPen(QPen(tokens.nl, 1.2) if fresh else _pen(tag, ink))
    painter.setBrush(ground_of(tag, tokens))
    painter.drawRoundedRect(place, RADIUS_NODE - 3, RADIUS_NODE - 3)
    if tag.standing == SILENT:
        hatch = QColor(tokens.unk)
        hatch.setAlpha(60)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(hatch)
        painter.setBrush(_hatch(hatch))
        painter.drawRoundedRect(place, RADIUS_NODE - 3, RADIUS_NODE - 3)
    if tag.standing == CONTESTED:
        corner = place.topRight()
        cut = QPolygonF([corner, corner + QPointF(-11, 0), corner + QPointF(0, 11)])
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(tokens.bad)
        painter.drawPolygon(cut)
    if chosen:
        painter.setPen(QPen(tokens.acc, 2))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRoundedRect(place.adjusted(-3, -3, 3, 3), RADIUS_NODE, RADIUS_NODE)
    name = place.adjusted(8, 2, -26, -17)
    paint_text(painter, name, tag.title, TextInk(tokens.tx, 12, 600))
    mark = QRectF(place.left() + 8, place.bottom() - 16, 12, 12)
    if fresh:
        _bars(painter, mark, tokens.ok)
    else:
        draw(painter, MARKS[tag.standing], mark, ink, tokens.surf)
    words = place.adjusted(24, 17, -6, -2)
    paint_text(painter, words, tag.words, TextInk(tokens.tx2 if fresh else ink, 11, 500))
    count = QRectF(place.right() - 24, place.top() + 3, 16, 15)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(tokens.sunk)
    painter.drawRoundedRect(count, RADIUS_CHIP, RADIUS_CHIP)
    painter.setPen(tokens.tx)
    painter.setFont(text_font(11, 500))
    painter.drawText(count, Qt.AlignmentFlag.AlignCenter, str(len(tag.facts)))


def _pen(tag: NodeTag, ink: QColor) -> QPen:
    return QPen(ink, 1.4) if tag.standing == CONTESTED else dashed(ink, 1.4)


def _bars(painter: QPainter, room: QRectF, ink: QColor) -> None:
    """Paint the four bars of what is fresh."""
    for bar in range(4):
        high = 4 + 2 * bar
        box = QRectF(room.left() + 3.4 * bar, room.bottom() - 1 - high, 2.4, high)
        painter.fillRect(box, ink)


def _hatch(ink: QColor) -> QBrush:
    return QBrush(ink, Qt.BrushStyle.BDiagPattern)
