"""The strip of a counterexample: one card for each operation, one row of facts for each SB."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QScrollArea, QSizePolicy, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.chips import paint_chip
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.inspection.run_cards import CardChip, RunCards

CARD, GAP, HEAD, ROW, CHIP, NAMES, MARGIN = 127, 6, 26, 25, 17, 104, 12
MOST_CARDS = 100_000
MIDDLE = Qt.TextElideMode.ElideMiddle


class RunStrip(QWidget):
    """Shows the steps of one run. A click, Left and Right choose one."""

    step_wanted = Signal(int)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._cards: RunCards | None = None
        self._at = 0
        self._bad = True
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Steps of the run")
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)

    @property
    def cards(self) -> RunCards | None:
        """What is shown."""
        return self._cards

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_run(self, cards: RunCards | None, bad: bool = True) -> None:
        """Show another run. ``bad`` marks its last step as the one that must not be."""
        self._cards, self._bad = cards, bad
        rows = len(cards.branches) if cards is not None else 0
        steps = min(len(cards.steps), MOST_CARDS) if cards is not None else 0
        self.setFixedSize(steps * (CARD + GAP) + MARGIN, HEAD + rows * ROW + 10)
        self.update()

    def show_step(self, at: int) -> None:
        """Mark a step, and scroll to it."""
        self._at = at
        self.update()
        if self._cards is not None:
            self.setAccessibleDescription(plain_text(self._cards.words(at)))
            around = self.parentWidget()
            area = around.parentWidget() if around is not None else None
            if isinstance(area, QScrollArea):
                left = int(self.card(at).left())
                area.ensureVisible(left + CARD, 0, 12, 0)
                area.ensureVisible(left, 0, 12, 0)

    def card(self, at: int) -> QRectF:
        """The place of a card (pixels)."""
        return QRectF(at * (CARD + GAP), 1, CARD, self.height() - 6)

    def sizeHint(self) -> QSize:
        """The size of all cards."""
        return self.size()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose the card under the pointer."""
        if self._cards is None:
            return
        at = int(event.position().x() // (CARD + GAP))
        if 0 <= at < len(self._cards.steps):
            self.step_wanted.emit(at)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Left and Right go to the step beside, Home and End to the first and the last."""
        last = len(self._cards.steps) - 1 if self._cards is not None else 0
        ways = {
            Qt.Key.Key_Left: max(self._at - 1, 0),
            Qt.Key.Key_Right: min(self._at + 1, last),
            Qt.Key.Key_Home: 0,
            Qt.Key.Key_End: last,
        }
        at = ways.get(Qt.Key(event.key()))
        if at is None:
            super().keyPressEvent(event)
        else:
            self.step_wanted.emit(at)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the cards that are visible."""
        cards = self._cards
        if cards is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        first = max(0, event.rect().left() // (CARD + GAP))
        for at in range(first, len(cards.steps)):
            box = self.card(at)
            if box.left() > event.rect().right():
                break
            self._card(painter, box, cards, at)

    def _card(self, painter: QPainter, box: QRectF, cards: RunCards, at: int) -> None:
        tokens, step = self._tokens, cards.steps[at]
        last = self._bad and at == len(cards.steps) - 1
        here = at == self._at
        edge = tokens.bad if last else tokens.acc if here else tokens.line2
        ground = tokens.bads if last else tokens.accs if here else tokens.surf
        inset = 1.0 if here or last else 0.5
        painter.setPen(QPen(edge, 2 if here else 1.5 if last else 1))
        painter.setBrush(ground)
        painter.drawRoundedRect(box.adjusted(inset, inset, -inset, -inset), 6, 6)
        disc = QRectF(box.left() + 8, box.top() + 5, 16, 16)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(tokens.bad if last else tokens.acc if at else tokens.tx2)
        if at:
            painter.drawEllipse(disc)
            painter.setPen(tokens.onacc)
            painter.setFont(_font(10 if at < 100 else 8))
            painter.drawText(disc, Qt.AlignmentFlag.AlignCenter, str(at))
        else:
            painter.drawEllipse(disc.adjusted(4, 4, -4, -4))
        name = step.operation.operation if step.operation is not None else "Start"
        ink = TextInk(tokens.bad if last and at else tokens.tx, 11, 600)
        title = box.adjusted(28, 0, -3, 0)
        title.setHeight(HEAD)
        paint_text(painter, title, name, ink, elide=MIDDLE)
        for number, branch in enumerate(cards.branches):
            chips = cards.chips(at, branch)
            top = box.top() + HEAD + number * ROW
            room = box.width() - 14
            most = max(CHIP, room / max(len(chips), 1) - 3)
            left = box.left() + 7
            for chip in chips:
                wide = _wide(chip, most)
                self._chip(painter, QRectF(left, top + 2, wide, CHIP), chip)
                left += wide + 3

    def _chip(self, painter: QPainter, box: QRectF, chip: CardChip) -> None:
        tokens = self._tokens
        if chip.bad:
            cut = 5.0
            corners = QPolygonF([
                box.topLeft(), QPointF(box.right() - cut, box.top()),
                QPointF(box.right(), box.top() + cut), box.bottomRight(), box.bottomLeft(),
            ])  # fmt: skip
            painter.setPen(QPen(tokens.bad, 1.5))
            painter.setBrush(tokens.surf)
            painter.drawPolygon(corners)
            ink = TextInk(tokens.bad, 11, 600, mono=True)
            paint_text(painter, box.adjusted(4, 0, -2, 0), chip.value, ink)
            return
        paint_chip(painter, box, chip.value, chip.kind, tokens, sub=chip.sub)
        if chip.changed:
            ring = QColor(tokens.acc)
            painter.setPen(QPen(ring, 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(box.adjusted(-1, -1, 1, 1), 5, 5)


class BranchNames(QWidget):
    """The names of the SBs, at the left of the cards."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._names: tuple[str, ...] = ()
        self._scrolled = 0
        self.setFixedWidth(NAMES + MARGIN)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_names(self, names: tuple[str, ...], scrolled: int = 0) -> None:
        """Show names; ``scrolled`` is how far the cards are scrolled down (pixels)."""
        self._names, self._scrolled = names, scrolled
        self.setToolTip(tip_text("\n".join(names)))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the names."""
        painter = QPainter(self)
        for number, name in enumerate(self._names):
            box = QRectF(MARGIN, HEAD + number * ROW - self._scrolled, NAMES - 8, ROW)
            paint_text(painter, box, name, TextInk(self._tokens.tx2, 12), elide=MIDDLE)


def _wide(chip: CardChip, most: float) -> float:
    """The width of a chip: that of its value, within limits (pixels)."""
    return max(CHIP, min(most, 9.0 * len(chip.value) + 8))


def _font(size: int) -> QFont:
    return text_font(size, 600)
