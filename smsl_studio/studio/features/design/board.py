"""The board of the nine cards: captions, the way from card to card, and what is next."""

from __future__ import annotations

from itertools import pairwise

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QKeyEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from smsl_studio.front.design import stages
from smsl_studio.front.design.cycle import DesignCycle
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_NODE, Tokens
from smsl_studio.studio.features.design.card import HIGH, RING, WIDE, StageCard
from smsl_studio.studio.features.design.looks import COUNTED, FEET, foot_colours, paint_strip
from smsl_studio.studio.features.design.next_box import NextBox

GROUPS = (
    ("Generative", "what people and models know, different each time", (1, 2, 3, 4)),
    ("Deterministic", "follows from the blueprint, the same each time", (5, 6, 7)),
    ("Regulated", "rules look, people decide", (8, 9)),
)
LEFT, TOP, GAP, CAPTION, BETWEEN = 14, 16, 16, 30, 46
LEAST = 10
"""The least room between two cards (pixels)."""
KINDS = (
    (stages.GENERATIVE, "generative"),
    (stages.DETERMINISTIC, "deterministic"),
    (stages.SITE, "depends on the site"),
)
KEYS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}


class StageBoard(QWidget):
    """Places the cards in rows, as many beside each other as fit."""

    chosen = Signal(int)
    """int: the number of the stage that was clicked."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._counts: dict[str, int] = {}
        self._captions: list[tuple[QRectF, str, str]] = []
        self._legend = QRectF()
        self.setAccessibleName("Stages")
        self.cards = tuple(StageCard(number, tokens, self) for number in stages.WORDS)
        self.next = NextBox(tokens, self)
        for card in self.cards:
            card.clicked.connect(lambda _=False, n=card.stage.number: self.chosen.emit(n))
        self.setMinimumWidth(2 * (WIDE + LEAST) + 2 * LEFT)
        self.arrange()

    def show_cycle(self, cycle: DesignCycle) -> None:
        """Show the stages as they are now."""
        for card, stage in zip(self.cards, cycle.stages, strict=True):
            card.show_stage(stage)
        self._counts = cycle.counts()
        self.next.show_steps(cycle.next)
        self.update()

    def choose(self, number: int) -> None:
        """Mark the card that is shown beside."""
        for card in self.cards:
            card.choose(card.stage.number == number)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for card in self.cards:
            card.set_tokens(tokens)
        self.next.set_tokens(tokens)
        self.update()

    def sizeHint(self) -> QSize:
        """Room for four cards beside each other."""
        return QSize(4 * (WIDE + GAP) + GAP, self.minimumHeight())

    @property
    def columns(self) -> int:
        """How many cards stand beside each other."""
        return max(2, min(4, (self.width() - 2 * LEFT + LEAST) // (WIDE + LEAST)))

    def arrange(self) -> None:
        """Place everything for the present width."""
        columns, top = self.columns, TOP
        pitch = WIDE + min(
            GAP, max(LEAST, (self.width() - 2 * LEFT - columns * WIDE) // (columns - 1))
        )
        self._captions = []
        for title, words, numbers in GROUPS:
            room = QRectF(LEFT, top, self.width() - 2 * LEFT, CAPTION)
            self._captions.append((room, title, words))
            top += CAPTION
            for at, number in enumerate(numbers):
                across, down = at % columns, at // columns
                left, upper = LEFT + across * pitch, top + down * (HIGH + GAP)
                self.cards[number - 1].move(left - RING, upper - RING)
            across, down = len(numbers) % columns, len(numbers) // columns
            place = QRectF(LEFT + across * pitch, top + down * (HIGH + GAP), 0, 0)
            lines = -(-len(numbers) // columns)
            if title == GROUPS[1][0]:
                self._legend = QRectF(place.left() + 8, place.top() + 4, WIDE, HIGH)
                lines = max(lines, down + 1)
            elif title == GROUPS[2][0]:
                wide = (columns - across) * pitch - pitch + WIDE
                if wide < 2 * WIDE:
                    place, wide, down = (
                        QRectF(LEFT, place.top() + HIGH + GAP, 0, 0),
                        2 * WIDE,
                        down + 1,
                    )
                high = max(HIGH, self.next.height_of_all())
                self.next.setGeometry(int(place.left()), int(place.top()), wide, high)
                lines = max(lines, down + 1)
            top += lines * (HIGH + GAP) - GAP + BETWEEN
        self.setMinimumHeight(max(top - BETWEEN, self.next.geometry().bottom()) + 24)
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place everything for the new width."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.arrange()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows move the focus to the card beside."""
        step = KEYS.get(Qt.Key(event.key()))
        at = next((at for at, card in enumerate(self.cards) if card.hasFocus()), None)
        if step is None or at is None:
            super().keyPressEvent(event)
            return
        self.cards[(at + step) % len(self.cards)].setFocus(Qt.FocusReason.OtherFocusReason)

    # Painting.

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ground and what is not a card."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), self._tokens.canvas)
        self._paint_ways(painter)
        for room, title, words in self._captions:
            wide = paint_text(painter, room, title, TextInk(self._tokens.tx, 13, 600))
            beside = room.adjusted(wide + 8, 0, 0, 0)
            paint_text(painter, beside, words, TextInk(self._tokens.tx2, 12))
        self._paint_legend(painter)
        painter.end()

    def _paint_ways(self, painter: QPainter) -> None:
        tokens = self._tokens
        painter.setPen(QPen(tokens.nl, 1.4))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        boxes = [QRectF(card.geometry()).adjusted(RING, RING, -RING, -RING) for card in self.cards]
        for before, after in pairwise(boxes):
            if before.top() == after.top():
                middle = QPointF(before.right() + 2, before.center().y())
                painter.drawLine(middle, QPointF(after.left() - 6, middle.y()))
                self._head(painter, QPointF(after.left() - 2, middle.y()))
            else:
                self._paint_turn(painter, before, after)

    def _paint_turn(self, painter: QPainter, before: QRectF, after: QRectF) -> None:
        """The way from the end of a row to the begin of the next one, below the first."""
        below, left = before.bottom() + 14, 6.0
        if after.top() - before.bottom() < 2 * GAP:
            below = before.bottom() + GAP / 2
        path = QPainterPath(QPointF(before.center().x(), before.bottom() + 4))
        path.lineTo(before.center().x(), below)
        path.lineTo(left + RADIUS_NODE, below)
        path.quadTo(left, below, left, below + RADIUS_NODE)
        path.lineTo(left, after.center().y() - 4)
        path.lineTo(after.left() - 6, after.center().y() - 4)
        painter.drawPath(path)
        self._head(painter, QPointF(after.left() - 2, after.center().y() - 4))

    def _head(self, painter: QPainter, tip: QPointF) -> None:
        painter.save()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._tokens.nl)
        corners = [tip, tip + QPointF(-7, -4), tip + QPointF(-7, 4)]
        painter.drawPolygon(QPolygonF(corners))
        painter.restore()

    def _paint_legend(self, painter: QPainter) -> None:
        tokens, box = self._tokens, self._legend
        top = box.top()
        paint_text(
            painter, QRectF(box.left(), top, WIDE, 20), "How to read", TextInk(tokens.tx, 12, 600)
        )
        for kind, words in KINDS:
            top += 24
            paint_strip(painter, QRectF(box.left() + 4, top + 3, 5, 14), kind, tokens)
            paint_text(
                painter, QRectF(box.left() + 22, top, WIDE, 20), words, TextInk(tokens.tx2, 12)
            )
        for standing, words in COUNTED.items():
            ink, ground = foot_colours(standing, tokens)
            top += 20 if standing != stages.SETTLED else 26
            draw(painter, FEET[standing], QRectF(box.left(), top + 3, 13, 13), ink, ground)
            many = self._counts.get(standing, 0)
            said = f"{words}: {many}"
            paint_text(
                painter, QRectF(box.left() + 22, top, WIDE, 20), said, TextInk(tokens.tx2, 12)
            )
