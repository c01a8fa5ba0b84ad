"""Paints a fact as a tile: its values as places, and a token at the value that it has."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QFontMetricsF, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from smsl_studio.front.views.fact_tiles import FactTile
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CARD, RADIUS_CHIP, Tokens, mono_font

Index = QModelIndex | QPersistentModelIndex
GAP, INSET = 8, 10
"""Pixels between two tiles, and between the edge of a tile and its words."""
PLACE, APART = 22, 4
"""The least width of the place of a value, and the gap between two places (pixels)."""
MOST_PLACES = 8
TALL = 76
"""The height (pixels) from which the meaning of a value has a line of its own."""


class TilePainter(QStyledItemDelegate):
    """Paints tiles. ``share`` is how far the running operation has got, from 0 to 1.

    ``lit`` are the facts whose values have just changed.
    """

    def __init__(self, tokens: Tokens, parent: QObject) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.size = QSize(GAP, GAP)
        """The size of a tile with the gaps beside it."""
        self.share = 0.0
        self.lit: frozenset[tuple[str, int]] = frozenset()
        self.chosen: frozenset[tuple[str, int]] = frozenset()

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """The size of every tile."""
        return self.size

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one tile."""
        tile: FactTile = index.data(Qt.ItemDataRole.UserRole)
        box = QRectF(option.rect).adjusted(0.5, 0.5, -GAP - 0.5, -GAP - 0.5)
        focused = option.state & QStyle.StateFlag.State_HasFocus
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._ground(painter, box, tile, bool(focused) or tile.key in self.chosen)
        inner = box.adjusted(INSET, 6, -INSET, -6)
        t, tall = self.tokens, box.height() >= TALL
        name = QRectF(inner.left(), inner.top(), inner.width(), 16)
        if tile.group:
            room = name.adjusted(name.width() * 0.5, 0, 0, 0)
            name.setRight(inner.right() - 8 - paint_text(
                painter, room, tile.group, TextInk(t.tx3, 11), right=True))  # fmt: skip
        paint_text(painter, name, tile.name, TextInk(t.tx2, 12, 500))
        values = QRectF(inner.left(), name.bottom() + 3, inner.width(), 22)
        used = self._values(painter, values, tile)
        ink = self._ink(tile)
        if tall:
            below = QRectF(inner.left(), values.bottom() + 3, inner.width(), 16)
            beside = values.adjusted(used + 8, 0, 0, 0)
            words = tile.words or tile.meaning
            if tile.meaning and tile.words and beside.width() > 30:
                paint_text(painter, beside, tile.meaning, TextInk(t.tx, 13))
            paint_text(painter, below, words, TextInk(ink if tile.words else t.tx, 12))
        else:
            beside = values.adjusted(used + 8, 0, 0, 0)
            words = "; ".join(part for part in (tile.meaning, tile.words) if part)
            if beside.width() > 20:
                paint_text(painter, beside, words, TextInk(ink if tile.words else t.tx, 12))
        painter.restore()

    def _ink(self, tile: FactTile) -> QColor:
        t = self.tokens
        known = {"differs": t.bad, "unknown": t.unk, "transit": t.acc}
        return known.get(tile.quality, t.tx2)

    def _ground(self, painter: QPainter, box: QRectF, tile: FactTile, focused: bool) -> None:
        """Paint the box of a tile: its colour, and a line or a cut corner for what is wrong."""
        t = self.tokens
        fill = {"differs": t.bads, "unknown": t.unks}.get(tile.quality, t.surf)
        line, style, wide = t.line2, Qt.PenStyle.SolidLine, 1.0
        if tile.quality == "differs":
            line, wide = t.bad, 1.4
        elif tile.quality == "unknown":
            line, style, wide = t.unk, Qt.PenStyle.DashLine, 1.2
        elif tile.key in self.lit:
            fill, line, wide = t.accs, t.acc, 2.0
        elif tile.quality == "transit":
            line, style, wide = t.acc, Qt.PenStyle.DashLine, 1.4
        painter.setPen(QPen(line, wide, style))
        painter.setBrush(fill)
        if tile.quality == "differs":
            painter.drawPolygon(_cut(box))
        else:
            painter.drawRoundedRect(box, RADIUS_CARD, RADIUS_CARD)
        if tile.quality == "unknown":
            painter.fillRect(box.adjusted(4, 4, -4, -4),
                             QBrush(_faint(t.unk), Qt.BrushStyle.BDiagPattern))  # fmt: skip
        if focused:
            painter.setPen(QPen(t.acc, 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(box.adjusted(2, 2, -2, -2), RADIUS_CARD - 2, RADIUS_CARD - 2)

    def _values(self, painter: QPainter, room: QRectF, tile: FactTile) -> float:
        """Paint the value among all others if they have room, else alone; returns its width."""
        places = self._places(room, tile)
        painter.setFont(mono_font(12, 600))
        if tile.value not in places:
            return self._alone(painter, room, tile)
        t = self.tokens
        for value, place in places.items():
            wanted = value == tile.target
            painter.setPen(QPen(t.acc, 1.4, Qt.PenStyle.DashLine) if wanted else QPen(t.line2, 1))
            painter.setBrush(t.sunk if tile.quality in ("agrees", "believed") else t.surf)
            painter.drawRoundedRect(place, RADIUS_CHIP, RADIUS_CHIP)
            painter.setPen(t.acc if wanted else t.tx3)
            painter.drawText(place, Qt.AlignmentFlag.AlignCenter, plain_text(value))
        token = QRectF(places[tile.value or ""])
        if tile.target in places:
            to = places[tile.target]
            token.moveLeft(token.left() + (to.left() - token.left()) * self.share)
            token.setWidth(token.width() + (to.width() - token.width()) * self.share)
        self._token(painter, token, tile)
        return max(place.right() for place in places.values()) - room.left()

    def _alone(self, painter: QPainter, room: QRectF, tile: FactTile) -> float:
        words = f"{tile.shown} → {tile.target}" if tile.target else tile.shown
        metrics = QFontMetricsF(painter.font())
        wide = min(max(metrics.horizontalAdvance(words) + 12, PLACE), room.width())
        place = QRectF(room.left(), room.top(), wide, room.height())
        self._token(painter, place, tile, words)
        return wide

    def _token(self, painter: QPainter, place: QRectF, tile: FactTile, words: str = "") -> None:
        t = self.tokens
        ground = {"transit": t.acc, "differs": t.bad, "unknown": t.unk}.get(tile.quality, t.slate)
        ink = {"transit": t.onacc, "agrees": t.onslate, "believed": t.onslate}.get(
            tile.quality, t.surf
        )
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(t.acc if tile.key in self.lit else ground)
        painter.drawRoundedRect(place, RADIUS_CHIP, RADIUS_CHIP)
        painter.setPen(t.onacc if tile.key in self.lit else ink)
        shown = QFontMetricsF(painter.font()).elidedText(
            plain_text(words or tile.shown), Qt.TextElideMode.ElideMiddle, place.width() - 8
        )
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, shown)

    def _places(self, room: QRectF, tile: FactTile) -> dict[str, QRectF]:
        """Where each value stands; empty if they are too many or too long."""
        if not 2 <= len(tile.values) <= MOST_PLACES or max(map(len, tile.values)) > 12:
            return {}
        metrics, left, places = QFontMetricsF(mono_font(12, 600)), room.left(), {}
        for value in tile.values:
            wide = max(metrics.horizontalAdvance(plain_text(value)) + 10, PLACE)
            places[value] = QRectF(left, room.top(), wide, room.height())
            left += wide + APART
        return places if left - APART <= room.right() else {}


def _cut(box: QRectF) -> QPolygonF:
    """A box with a cut corner at the top right, the mark of a value that differs."""
    cut = 10.0
    return QPolygonF([
        box.topLeft(), QPointF(box.right() - cut, box.top()),
        QPointF(box.right(), box.top() + cut), box.bottomRight(), box.bottomLeft(),
    ])  # fmt: skip


def _faint(colour: QColor) -> QColor:
    found = QColor(colour)
    found.setAlpha(38)
    return found
