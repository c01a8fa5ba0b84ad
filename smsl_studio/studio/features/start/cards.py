"""The three cards of the start page, and the little drawings on them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.actions import key_words
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.start.tile import Tile

HIGH = 136
ART = 110
"""The width that the drawing at the right takes (pixels). A narrow card has none."""
NARROW = 340


@dataclass(frozen=True)
class CardWords:
    """What a card says. ``foot`` is its key, such as ``Ctrl+N``, or a remark."""

    title: str
    words: str
    key: str = ""
    remark: str = ""


NEW = CardWords(
    "Draw a new blueprint",
    "Start from one state. Every step can be undone.",
    key="Ctrl+N",
)
OPEN = CardWords(
    "Open a file",
    "JSON, YAML or .smsl, or drop it here. It is checked while it opens.",
    key="Ctrl+O",
)
TRY = CardWords(
    "Try it: fix and run Hanoi",
    "Find a misprint, correct it, run it, stop it and steer it. Each step is shown.",
    remark="About two minutes",
)


class StartCard(Tile):
    """A card with title, words, key or remark, and a drawing."""

    def __init__(
        self,
        said: CardWords,
        art: Callable[[QPainter, Tokens], None],
        tokens: Tokens,
        parent: QWidget,
    ) -> None:
        super().__init__(said.title, said.words, tokens, parent)
        self._said, self._art = said, art
        if said.key:
            self.tip(f"{said.title} ({key_words(said.key)})")

    def paint_content(self, painter: QPainter) -> None:
        """Paint the words at the left and the drawing at the right."""
        said, tokens, roomy = self._said, self.tokens, self.width() >= NARROW
        room = self.width() - 40 - (ART if roomy else 0)
        painter.setPen(tokens.tx)
        self.say(painter, QRectF(20, 16, room, 24), said.title, 16, 600)
        painter.setPen(tokens.tx2)
        self.say_wrapped(painter, QRectF(20, 45, room, 54), said.words, 13)
        if said.key:
            self.show_key(painter, 20, HIGH - 36, key_words(said.key).replace("+", " "))
        else:
            draw(painter, "clock", QRectF(20, HIGH - 33, 13, 13), tokens.tx2, tokens.surf)
            painter.setPen(tokens.tx2)
            self.say(painter, QRectF(40, HIGH - 37, room - 20, 20), said.remark, 12)
        if roomy:
            painter.translate(self.width() - ART - 4, 18)
            self._art(painter, tokens)


def new_art(painter: QPainter, tokens: Tokens) -> None:
    """A state, and one that is being added below it."""
    painter.setPen(QPen(tokens.nl, 1.2))
    painter.setBrush(tokens.surf)
    painter.drawRoundedRect(QRectF(24, 8, 54, 27), 6, 6)
    painter.setPen(QPen(tokens.line2, 1))
    for left in (30, 45, 60):
        painter.drawRoundedRect(QRectF(left, 16, 11, 11), 3, 3)
    accent = QPen(tokens.acc, 1.4)
    painter.setPen(accent)
    painter.setBrush(tokens.accs)
    painter.drawEllipse(QPointF(88, 77), 9, 9)
    painter.drawLine(QPointF(84, 77), QPointF(92, 77))
    painter.drawLine(QPointF(88, 73), QPointF(88, 81))
    accent.setDashPattern([3, 2.4])
    painter.setPen(accent)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRoundedRect(QRectF(24, 64, 54, 27), 6, 6)
    painter.drawLine(QPointF(51, 36), QPointF(51, 56))
    _head(painter, QPointF(51, 63), tokens)


def open_art(painter: QPainter, tokens: Tokens) -> None:
    """A sheet with four states."""
    painter.setPen(QPen(tokens.nl, 1.2))
    painter.setBrush(tokens.surf)
    sheet = [(36, 10), (72, 10), (90, 28), (90, 90), (36, 90)]
    painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in sheet]))
    painter.setBrush(tokens.sunk)
    painter.drawPolygon(QPolygonF([QPointF(72, 10), QPointF(90, 28), QPointF(72, 28)]))
    painter.setPen(QPen(tokens.edge, 1.2))
    painter.drawLine(QPointF(50, 42), QPointF(76, 42))
    painter.drawLine(QPointF(50, 70), QPointF(76, 70))
    painter.drawLine(QPointF(50, 42), QPointF(50, 70))
    painter.drawLine(QPointF(76, 42), QPointF(76, 70))
    painter.setPen(Qt.PenStyle.NoPen)
    for x, y in ((50, 42), (76, 42), (50, 70), (76, 70)):
        painter.setBrush(tokens.acc if (x, y) == (76, 70) else tokens.slate)
        painter.drawRoundedRect(QRectF(x - 7, y - 5, 14, 10), 3, 3)


def try_art(painter: QPainter, tokens: Tokens) -> None:
    """Three pegs, and the way of a disk from the first to the last."""
    peg = QPen(tokens.nl, 3)
    peg.setCapStyle(Qt.PenCapStyle.RoundCap)
    painter.setPen(peg)
    for x in (26, 54, 82):
        painter.drawLine(QPointF(x, 38), QPointF(x, 86))
    painter.setPen(QPen(tokens.line2, 4))
    painter.drawLine(QPointF(10, 88), QPointF(98, 88))
    painter.setPen(Qt.PenStyle.NoPen)
    for y, half, colour in ((50, 8, tokens.accl), (61, 11, tokens.edge), (72, 14, tokens.acc)):
        painter.setBrush(colour)
        painter.drawRoundedRect(QRectF(26 - half, y, 2 * half, 9), 4, 4)
    way = QPen(tokens.acc, 1.4)
    way.setDashPattern([3, 2.4])
    painter.setPen(way)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawArc(QRectF(26, 8, 56, 50), 20 * 16, 160 * 16)
    _head(painter, QPointF(82, 34), tokens)


def _head(painter: QPainter, tip: QPointF, tokens: Tokens) -> None:
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(tokens.acc)
    corners = [tip, tip + QPointF(-4.5, -8), tip + QPointF(4.5, -8)]
    painter.drawPolygon(QPolygonF(corners))
