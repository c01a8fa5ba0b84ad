"""The large layout of Supervise: where the run stands and what comes next, to be read from two
metres."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import RADIUS_CARD, RADIUS_NODE, Tokens, mono_font, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.supervise.large_words import (
    BAD,
    BUSY,
    GOOD,
    UNKNOWN,
    LargeFact,
    LargeWords,
)

PLAIN, WORDS, NAME, STATE = 26, 30, 40, 52
"""The sizes of letters (pixels). The smallest is twice as large as the usual text."""
MARGIN, GAP, ROW = 24.0, 14.0, 48.0
LINE = 1.3
"""The height of a line, as a multiple of its letters."""


class LargeView(QWidget):
    """Paints ``words``. What has no room is left out from the middle: first facts that agree."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.words = LargeWords("", "quiet")
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setMinimumSize(360, 300)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_words(self, words: LargeWords) -> None:
        """Show where the run stands."""
        if words != self.words:
            self.words = words
            self.setAccessibleName(plain_text(words.said))
            self.setToolTip(tip_text(words.said))
            self.update()

    def sizeHint(self) -> QSize:
        """Room for a state with four facts, and for the operation ahead."""
        return QSize(640, 560)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint phase and question above, the operation ahead below, and the facts between."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        told, t = self.words, self._tokens
        y = MARGIN + self._badge(painter, MARGIN)
        if told.question:
            y += GAP + self._text(painter, y + GAP, told.question, text_font(WORDS, 600), t.tx, 3)
        if told.state:
            y += GAP + self._text(painter, y + GAP, told.state, text_font(STATE, 600), t.tx, 1)
        if told.title:
            y += self._text(painter, y, told.title, text_font(PLAIN), t.tx2, 1)
        end = self.height() - MARGIN
        if told.ahead:
            end -= self._ahead_height()
            self._ahead(painter, end)
        self._facts(painter, y + GAP, end - GAP)
        painter.end()

    def shown_facts(self, room: float) -> tuple[LargeFact, ...]:
        """The facts that fit into a height (pixels). Those that do not agree come first."""
        count = max(int(room // ROW), 0)
        facts = self.words.facts
        if len(facts) <= count:
            return facts
        ordered = sorted(facts, key=lambda one: one.kind == GOOD)
        kept = ordered[: max(count - 1, 0)]
        return tuple(one for one in facts if one in kept)

    def _ink(self, kind: str) -> tuple[QColor, QColor]:
        t = self._tokens
        return {
            GOOD: (t.ok, t.oks), BAD: (t.bad, t.bads), UNKNOWN: (t.unk, t.unks),
            BUSY: (t.acc, t.accs),
        }.get(kind, (t.tx2, t.sunk))  # fmt: skip

    def _badge(self, painter: QPainter, top: float) -> float:
        ink, ground = self._ink(self.words.kind)
        font = text_font(WORDS, 600)
        words = plain_text(self.words.phase)
        wide = min(QFontMetricsF(font).horizontalAdvance(words) + 32, self.width() - 2 * MARGIN)
        box = QRectF(MARGIN, top, wide, 52.0)
        painter.setPen(ink)
        painter.setBrush(ground)
        painter.drawRoundedRect(box, RADIUS_CARD, RADIUS_CARD)
        painter.setFont(font)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)
        return box.height()

    def _text(
        self, painter: QPainter, top: float, words: str, font: QFont, ink: QColor, lines: int
    ) -> float:
        """Paint words, at most so many lines; returns their height (pixels)."""
        metrics = QFontMetricsF(font)
        room = QRectF(MARGIN, top, self.width() - 2 * MARGIN, metrics.lineSpacing() * lines)
        painter.setFont(font)
        painter.setPen(ink)
        shown = plain_text(words)
        if lines == 1:
            shown = metrics.elidedText(shown, Qt.TextElideMode.ElideMiddle, room.width())
        flags = Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignTop
        seen = metrics.boundingRect(room, flags, shown)
        painter.drawText(room, flags, shown)
        return min(seen.height(), room.height())

    def _facts(self, painter: QPainter, top: float, end: float) -> None:
        shown = self.shown_facts(end - top)
        t, wide = self._tokens, self.width() - 2 * MARGIN
        plain, value = text_font(PLAIN), mono_font(PLAIN, 600)
        for at, one in enumerate(shown):
            row = QRectF(MARGIN, top + at * ROW, wide, ROW)
            ink, ground = self._ink(one.kind)
            chip = QRectF(row.left() + wide * 0.55, row.top() + 4, 64.0, ROW - 10)
            self._line(painter, QRectF(row.left(), row.top(), wide * 0.53, ROW), one.name, plain,
                       t.tx)  # fmt: skip
            painter.setPen(ink)
            painter.setBrush(ground)
            painter.drawRoundedRect(chip, RADIUS_NODE, RADIUS_NODE)
            painter.setFont(value)
            words = QFontMetricsF(value).elidedText(
                plain_text(one.value), Qt.TextElideMode.ElideRight, chip.width() - 8
            )
            painter.drawText(chip, Qt.AlignmentFlag.AlignCenter, words)
            rest = QRectF(chip.right() + 12, row.top(), row.right() - chip.right() - 12, ROW)
            self._line(painter, rest, one.words, plain, ink)
        more = len(self.words.facts) - len(shown)
        if more and end - top >= (len(shown) + 1) * ROW:
            row = QRectF(MARGIN, top + len(shown) * ROW, wide, ROW)
            self._line(painter, row, f"and {more} more", plain, t.tx2)

    @staticmethod
    def _line(painter: QPainter, room: QRectF, words: str, font: QFont, ink: QColor) -> None:
        painter.setFont(font)
        painter.setPen(ink)
        shown = QFontMetricsF(font).elidedText(
            plain_text(words), Qt.TextElideMode.ElideMiddle, room.width()
        )
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, shown)

    def _ahead_height(self) -> float:
        lines = 2 + bool(self.words.forecast[0])
        return NAME * LINE + lines * PLAIN * LINE + 2 * GAP

    def _ahead(self, painter: QPainter, top: float) -> None:
        t, told = self._tokens, self.words
        box = QRectF(MARGIN / 2, top, self.width() - MARGIN, self._ahead_height())
        painter.setPen(t.accl)
        painter.setBrush(t.accs)
        painter.drawRoundedRect(box, RADIUS_CARD, RADIUS_CARD)
        y, wide = top + GAP, self.width() - 2 * MARGIN
        lines = (
            (told.ahead, text_font(NAME, 600), t.tx, NAME),
            (told.target, text_font(PLAIN), t.tx2, PLAIN),
            (told.about, text_font(PLAIN), t.tx2, PLAIN),
            (told.forecast[0], text_font(PLAIN, 600), self._ink(told.forecast[1])[0], PLAIN),
        )
        for words, font, ink, high in lines:
            if words:
                self._line(painter, QRectF(MARGIN, y, wide, high * LINE), words, font, ink)
                y += high * LINE
