"""The cards of the map and the lines between them."""

from __future__ import annotations

from functools import partial
from pathlib import PurePath

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QEnterEvent,
    QFocusEvent,
    QFontMetricsF,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QAbstractButton, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.picture.branch_map import HEAD, ROW, SKETCH, WIDE, BranchMap, MapCard
from smsl_studio.picture.branch_map_svg import plain_words
from smsl_studio.picture.miniature import Miniature, miniature_of_branch
from smsl_studio.picture.svg import size_words
from smsl_studio.studio.base.paint.ink import NO_PEN
from smsl_studio.studio.base.paint.miniature_paint import paint_miniature
from smsl_studio.studio.base.theme import RADIUS_CARD, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

EDGE, SIDE = 24, 12
"""Free room around the map, and at the sides of a card (pixels)."""


class BranchCard(QAbstractButton):
    """One SB. Its small drawing is computed when it is painted for the first time."""

    entered = Signal()
    """It has got the keyboard focus."""

    def __init__(self, view: QWidget, blueprint: Blueprint, card: MapCard, tokens: Tokens) -> None:
        super().__init__(view)
        self.card, self.tokens, self.current = card, tokens, False
        self._blueprint = blueprint
        self._sketch: Miniature | None = None
        self._sketched = False
        self.setGeometry(QRectF(EDGE + card.left, EDGE + card.top, WIDE, card.height).toRect())
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(plain_text(card.name))
        facts = [f"{fact.name}: {fact.sub}" for fact in card.facts]
        self.setAccessibleDescription(plain_text("; ".join([self.size_words, *facts])))
        self.setToolTip(tip_text("\n".join([card.name, *([card.file] if card.file else [])])))

    @property
    def size_words(self) -> str:
        """The numbers of states and operations, and the imported file."""
        words = size_words(self.card.states, self.card.operations)
        return f"{words}, in {PurePath(self.card.file).name}" if self.card.file else words

    def enterEvent(self, event: QEnterEvent) -> None:
        """Highlight the card under the pointer."""
        self.update()

    def leaveEvent(self, event: object) -> None:
        """Remove the highlight."""
        self.update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Tell that the card has the keyboard focus, so that it is scrolled into view."""
        super().focusInEvent(event)
        self.entered.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter acts as a click does, and so does Space."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card: its title, its small drawing and its facts."""
        tokens, card = self.tokens, self.card
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        near = self.current or self.underMouse() or self.hasFocus()
        painter.setPen(QPen(tokens.acc if near else tokens.line2, 2.0 if self.hasFocus() else 1.2))
        painter.setBrush(tokens.accs if self.current else tokens.surf)
        painter.drawRoundedRect(
            QRectF(self.rect()).adjusted(1, 1, -1, -1), RADIUS_CARD, RADIUS_CARD
        )
        self._write(painter, 22.0, card.name, 13, 600, "tx")
        self._write(painter, 38.0, self.size_words, 11, 400, "tx3")
        box = QRectF(2.0, HEAD, WIDE - 4.0, SKETCH)
        painter.fillRect(box, tokens.canvas)
        paint_miniature(painter, box, self._drawing(), tokens)
        y = HEAD + SKETCH + ROW / 2 + 4.0
        for fact in card.facts:
            missing = ", which does not exist" if fact.missing else ""
            colour = "bad" if fact.missing else "tx2"
            self._write(painter, y, f"{fact.name}: {fact.sub}{missing}", 12, 400, colour)
            y += ROW
        if card.plain:
            self._write(painter, y, plain_words(card), 12, 400, "tx3")
        painter.end()

    def _write(
        self, painter: QPainter, y: float, words: str, size: int, weight: int, colour: str
    ) -> None:
        font = text_font(size, weight)
        painter.setFont(font)
        painter.setPen(getattr(self.tokens, colour))
        shown = QFontMetricsF(font).elidedText(
            plain_text(words), Qt.TextElideMode.ElideMiddle, WIDE - 2.0 * SIDE
        )
        painter.drawText(QPointF(SIDE, y), shown)

    def _drawing(self) -> Miniature | None:
        if not self._sketched:
            self._sketch, self._sketched = (
                miniature_of_branch(self._blueprint, self.card.name),
                True,
            )
        return self._sketch


class MapView(QWidget):
    """The whole map at its full size. The arrow keys go from card to card. Space or Enter shows the
    SB of a card.
    """

    chosen = Signal(str)
    """The name of an SB whose card was clicked."""
    focused = Signal(QWidget)
    """The card that has got the keyboard focus."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens = tokens
        self.setAccessibleName("Map of branches")
        self.cards: dict[str, BranchCard] = {}
        self._map: BranchMap | None = None

    def show_map(self, blueprint: Blueprint, drawn: BranchMap, current: str) -> None:
        """Show a map. The card of the SB ``current`` is marked."""
        held = next((name for name, card in self.cards.items() if card.hasFocus()), "")
        for button in self.cards.values():
            button.hide()
            button.deleteLater()
        self._map = drawn
        self.cards = {
            name: BranchCard(self, blueprint, card, self.tokens)
            for name, card in drawn.cards.items()
        }
        for name, button in self.cards.items():
            button.clicked.connect(partial(self.chosen.emit, name))
            button.entered.connect(partial(self.focused.emit, button))
            button.show()
        self.resize(self.sizeHint())
        self.show_current(current)
        if held:
            self.enter(held)

    def show_current(self, branch: str) -> None:
        """Mark the card of the SB that is drawn."""
        for name, button in self.cards.items():
            button.current = name == branch
            button.update()

    def enter(self, branch: str) -> None:
        """Give the keyboard focus to the card of an SB, if it is there."""
        if branch in self.cards:
            self.cards[branch].setFocus()

    def sizeHint(self) -> QSize:
        """The size of the map with its border."""
        drawn = self._map
        wide, high = (drawn.width, drawn.height) if drawn is not None else (0.0, 0.0)
        return QSize(int(wide) + 2 * EDGE + 1, int(high) + 2 * EDGE + 1)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        for button in self.cards.values():
            button.tokens = tokens
            button.update()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the lines below the cards."""
        if self._map is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(EDGE, EDGE)
        for link in self._map.links:
            painter.setPen(QPen(self.tokens.edge, 1.5))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawPolyline([QPointF(x, y) for x, y in link.line])
            x, y = link.line[-1]
            painter.setPen(NO_PEN)
            painter.setBrush(self.tokens.edge)
            corners = [QPointF(x, y), QPointF(x - 8, y - 4), QPointF(x - 8, y + 4)]
            painter.drawPolygon(QPolygonF(corners))
        painter.end()
