"""The card of one stage: number, name, who made it, when, digest, verdict, and how it stands."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFocusEvent, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QWidget

from smsl_studio.front.design.stages import EMPTY, OUTDATED, WORDS, DesignStage
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CARD, RADIUS_CONTROL, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.design.looks import (
    FEET,
    MAKERS,
    MARKS,
    digest_words,
    foot_colours,
    mark_colour,
    paint_strip,
    when_words,
)

WIDE, HIGH, LINE = 200, 176, 23
RING = 6
"""The room around a card in which the ring of the chosen one is painted (pixels)."""


class StageCard(QAbstractButton):
    """A painted button. It stands with ``RING`` pixels around it."""

    def __init__(self, number: int, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.stage = DesignStage(number)
        self.chosen = False
        self.setFixedSize(WIDE + 2 * RING, HIGH + 2 * RING)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.show_stage(self.stage)

    def show_stage(self, stage: DesignStage) -> None:
        """Show what is known about the stage now."""
        self.stage = stage
        self.setText(plain_text(stage.name))
        maker = stage.maker.words if stage.maker is not None else ""
        told = ", ".join(filter(None, (stage.verdict.words, stage.foot, maker)))
        self.setAccessibleName(plain_text(f"Stage {stage.number}: {stage.name}"))
        self.setAccessibleDescription(plain_text(told))
        lines = [f"{stage.number} {stage.name}", maker, stage.verdict.words, stage.foot]
        self.setToolTip(tip_text("\n".join(dict.fromkeys(filter(None, lines)))))
        self.update()

    def choose(self, chosen: bool) -> None:
        """Mark the card as the one that is shown beside, or not."""
        if chosen != self.chosen:
            self.chosen = chosen
            self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter chooses, as Space does."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Paint the ring of the focus."""
        super().focusInEvent(event)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        box = QRectF(RING, RING, WIDE, HIGH)
        self._paint_ground(painter, box)
        painter.translate(box.topLeft())
        self._paint_words(painter)
        painter.end()

    def _paint_ground(self, painter: QPainter, box: QRectF) -> None:
        tokens, stage = self._tokens, self.stage
        if self.chosen or self.hasFocus():
            painter.setPen(QPen(tokens.acc, 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            ring = box.adjusted(-4, -4, 4, 4)
            painter.drawRoundedRect(ring, RADIUS_CARD + 3, RADIUS_CARD + 3)
        pen = QPen(tokens.nl if self.underMouse() else tokens.line2, 1)
        if stage.standing == EMPTY:
            pen = QPen(tokens.nl, 1)
            pen.setDashPattern([4, 3])
        elif stage.is_generated:
            pen = QPen(tokens.risk, 1.4)
            pen.setDashPattern([4, 3])
        painter.setPen(pen)
        painter.setBrush(tokens.surf)
        painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), RADIUS_CARD, RADIUS_CARD)

    def _paint_words(self, painter: QPainter) -> None:
        tokens, stage = self._tokens, self.stage
        paint_strip(painter, QRectF(9, 12, 5, 120), WORDS[stage.number].kind, tokens)
        paint_disc(painter, QPointF(33, 22), stage.number, tokens, accent=self.chosen)
        paint_text(painter, QRectF(49, 12, 142, 20), stage.name, TextInk(tokens.tx, 13, 600))
        top = 37.0
        if stage.maker is not None:
            place = QRectF(24, top + 3, 14, 14)
            draw(painter, MAKERS[stage.maker.kind], place, tokens.tx2, tokens.surf)
            paint_text(
                painter, QRectF(44, top, 148, 20), stage.maker.words, TextInk(tokens.tx2, 12)
            )
            top += LINE
        when = when_words(stage.when, datetime.now().astimezone())
        if when:
            paint_text(painter, QRectF(24, top, 168, 20), when, TextInk(tokens.tx2, 12))
            top += LINE
        if stage.digest:
            paint_text(painter, QRectF(24, top, 42, 20), "digest", TextInk(tokens.tx2, 12))
            ink = TextInk(tokens.tx, 12, mono=True)
            paint_text(painter, QRectF(66, top, 126, 20), digest_words(stage.digest), ink)
            top += LINE
        if stage.verdict.words:
            old = stage.standing == OUTDATED
            colour = tokens.tx2 if old else mark_colour(stage.verdict.mark, tokens)
            icon = QRectF(24, top + 3, 14, 14)
            draw(painter, MARKS[stage.verdict.mark], icon, colour, tokens.surf)
            paint_text(painter, QRectF(44, top, 148, 20), stage.verdict.words, TextInk(colour, 12))
        paint_foot(painter, QRectF(8, 140, WIDE - 16, 28), stage, tokens)


def paint_disc(
    painter: QPainter, middle: QPointF, number: int, tokens: Tokens, *, accent: bool
) -> None:
    """Paint the number of a stage in a disc."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(tokens.acc if accent else tokens.slate)
    painter.drawEllipse(middle, 9.5, 9.5)
    ink = TextInk(tokens.onacc if accent else tokens.onslate, 11, 600)
    box = QRectF(middle.x() - 3.5, middle.y() - 9, 16, 18)
    paint_text(painter, box, str(number), ink)


def paint_foot(painter: QPainter, box: QRectF, stage: DesignStage, tokens: Tokens) -> None:
    """Paint how a stage stands."""
    ink, ground = foot_colours(stage.standing, tokens)
    if stage.standing != EMPTY:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
    icon = QRectF(box.left() + 9, box.center().y() - 6.5, 13, 13)
    draw(painter, FEET[stage.standing], icon, ink, ground)
    words = box.adjusted(28, 0, -8, 0)
    paint_text(painter, words, stage.foot[:1].upper() + stage.foot[1:], TextInk(ink, 12))
