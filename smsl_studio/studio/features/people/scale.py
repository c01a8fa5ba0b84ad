"""The rows of the continuum: a scale from human to automatic with a band, a knob, and words."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QLinearGradient, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.people.continuum_view import ScaleView

ROW, LEFT, NAME, GAP, MARGIN = 29, 12, 86, 16, 12
WORDS, LEAST = 128, 90
"""Width of the words at the right, and smallest length of the scale (pixels)."""
TICKS = 4
BOTH = 145
"""The length from which the scale has room for words at both ends (pixels)."""


class Scale(QWidget):
    """The base of all rows: where the scale begins and ends."""

    def __init__(self, tokens: Tokens, height: int) -> None:
        super().__init__()
        self.tokens = tokens
        self.setFixedHeight(height)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        self.update()

    def sizeHint(self) -> QSize:
        """Room for the name, twice the smallest scale, and the words."""
        return QSize(LEFT + NAME + 2 * LEAST + GAP + WORDS + MARGIN, self.height())

    def minimumSizeHint(self) -> QSize:
        """Room for the name, the smallest scale, and the words."""
        return QSize(LEFT + NAME + LEAST + GAP + WORDS, self.height())

    @property
    def start(self) -> float:
        """The left end of the scale (pixels)."""
        return float(LEFT + NAME)

    @property
    def length(self) -> float:
        """The length of the scale (pixels)."""
        return max(float(self.width() - LEFT - NAME - GAP - WORDS - MARGIN), float(LEAST))

    def at(self, place: float) -> float:
        """The x of a place from 0 to 1 (pixels)."""
        return self.start + self.length * place

    def words_room(self) -> QRectF:
        """The rectangle for the words, at the right of the scale."""
        left = self.start + self.length + GAP
        return QRectF(left, 0, max(self.width() - left - 4, 10), self.height())


class Ends(Scale):
    """The head of the scales: a person at the left end, a robot arm at the right end."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__(tokens, 20)
        self.setToolTip("From a person alone to the automation alone")

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint both icons, with words if there is room."""
        tokens = self.tokens
        painter = QPainter(self)
        right = self.start + self.length
        draw(painter, "person", QRectF(self.start - 6, 3, 13, 13), tokens.tx2, tokens.surf)
        draw(painter, "robot", QRectF(right - 7, 3, 13, 13), tokens.tx2, tokens.surf)
        if self.length < BOTH:
            painter.end()
            return
        paint_text(painter, QRectF(self.start + 11, 0, 80, 20), "human", TextInk(tokens.tx2, 12))
        room = QRectF(right - 92, 0, 80, 20)
        paint_text(painter, room, "automatic", TextInk(tokens.tx2, 12), right=True)
        painter.end()


class ScaleRow(Scale):
    """One row: its name, the range of levels as a band, the mean as a knob, and words."""

    def __init__(self, view: ScaleView, tokens: Tokens) -> None:
        super().__init__(tokens, ROW)
        self.show_view(view)

    def show_view(self, view: ScaleView) -> None:
        """Show these values, also to assistive tools."""
        self.view = view
        self.setAccessibleName(plain_text(f"{view.name}: {view.words}"))
        self.setToolTip(tip_text(f"{view.name}: {view.words}"))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint name, scale, band, knob and words."""
        view, tokens, middle = self.view, self.tokens, self.height() / 2
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        room = QRectF(LEFT, 0, NAME - 10, self.height())
        paint_text(painter, room, view.name, TextInk(tokens.tx))
        painter.setPen(QPen(tokens.line2, 2))
        painter.drawLine(QPointF(self.at(0), middle), QPointF(self.at(1), middle))
        painter.setPen(QPen(tokens.nl, 1.4))
        for tick in range(TICKS + 1):
            x = self.at(tick / TICKS)
            painter.drawLine(QPointF(x, middle - 4), QPointF(x, middle + 4))
        if view.high > view.low:
            low = self.at(view.low)
            band = QRectF(low, middle - 3, self.at(view.high) - low, 6)
            painter.fillRect(band, tokens.accl)
        painter.setPen(QPen(tokens.acc, 2.6))
        painter.setBrush(tokens.surf)
        painter.drawEllipse(QPointF(self.at(view.position), middle), 6.2, 6.2)
        paint_text(painter, self.words_room(), view.words, TextInk(tokens.tx2, 12))
        painter.end()


class WholeRow(Scale):
    """The spectrum of the whole procedure, as in the paper."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__(tokens, 38)
        self._position, self._words = 0.5, ""

    def show_whole(self, position: float, words: str) -> None:
        """Show the place of the whole procedure, from 0 (human) to 1 (automatic)."""
        self._position, self._words = position, words
        self.setAccessibleName(plain_text(f"Whole procedure: {words}"))
        self.setToolTip(
            tip_text(
                f"Whole procedure: {words}. "
                "Inspection, operations, facts and supervision count alike."
            )
        )
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the spectrum, its knob and the words."""
        tokens = self.tokens
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(text_font(13))
        paint_text(painter, QRectF(LEFT, 8, NAME - 10, 22), "Whole", TextInk(tokens.tx, 13, 600))
        bar = QRectF(self.start, 13, self.length, 12)
        shades = QLinearGradient(bar.topLeft(), bar.topRight())
        shades.setColorAt(0.0, tokens.ok)
        shades.setColorAt(1.0, tokens.acc)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(shades)
        painter.drawRoundedRect(bar, 4, 4)
        self._strokes(painter, bar)
        x = self.at(self._position)
        painter.setPen(QPen(tokens.surf, 1.4))
        painter.setBrush(tokens.tx)
        painter.drawPolygon(QPolygonF([QPointF(x, 14), QPointF(x - 7, 3), QPointF(x + 7, 3)]))
        painter.setPen(QPen(tokens.tx, 2))
        painter.drawLine(QPointF(x, 12), QPointF(x, 26))
        paint_text(painter, self.words_room(), self._words, TextInk(tokens.tx, 12, 600))
        painter.end()

    def _strokes(self, painter: QPainter, bar: QRectF) -> None:
        """Paint upright strokes, close at the human end and far apart at the other.

        They say the same as the colours.
        """
        painter.setPen(QPen(self.tokens.surf, 1.0))
        x, gap = bar.left() + 4.0, 3.0
        while x < bar.right() - 3.0:
            painter.drawLine(QPointF(x, bar.top() + 3), QPointF(x, bar.bottom() - 3))
            gap = 3.0 + 22.0 * ((x - bar.left()) / max(bar.width(), 1.0))
            x += gap
