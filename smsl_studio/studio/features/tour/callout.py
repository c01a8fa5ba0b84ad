"""The callout of the tour, and the ring around the control that it points at."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPainterPath, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.theme import RADIUS_NODE, Tokens, text_font
from smsl_studio.studio.features.tour.placement import GAP, BesideControl
from smsl_studio.studio.features.tour.steps import COUNT, TourStep

WIDTH, RIM = 320, 10
"""The width of the callout, and the rim at all sides in which its tip lies (pixels)."""
AROUND = 4
"""Pixels between a control and the ring around it."""


class Callout(QWidget):
    """What to do next, with a tip that points at the control. It never takes the keys."""

    left = Signal()
    """The person wants to leave the tour."""
    more_wanted = Signal()
    """The person wants to read on."""

    def __init__(self, tokens: Tokens, window: QWidget) -> None:
        super().__init__(window)
        self._tokens, self._side, self._tip = tokens, "", QPointF()
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self._number = label("", "small")
        self._title = label("", "heading")
        self._title.setFont(text_font(14, 600))
        self._words = label("", "second")
        self._words.setWordWrap(True)
        self.leave = QPushButton("Leave (Esc)")
        self.leave.setProperty("role", "link")
        self.leave.setToolTip("Leave the tour; the copy stays open")
        self.more = QPushButton("Read on")
        self.more.setProperty("role", "row")
        self.leave.clicked.connect(self.left)
        self.more.clicked.connect(self.more_wanted)
        inner = QVBoxLayout(self)
        inner.setContentsMargins(RIM + 14, RIM + 10, RIM + 14, RIM + 8)
        inner.setSpacing(4)
        inner.addLayout(row(self._number, None, self.leave))
        inner.addWidget(self._title)
        inner.addWidget(self._words)
        inner.addLayout(row(self.more, None))
        self.setFixedWidth(WIDTH)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_step(self, step: TourStep) -> None:
        """Show the words of a step; the height follows them."""
        self._number.setText(f"Step {step.number} of {COUNT}" if step.number else "First steps")
        self._title.setText(step.title)
        self._words.setText(step.words)
        self.leave.setText("Leave (Esc)" if step.number else "Close (Esc)")
        self.more.setVisible(not step.number)
        self.setAccessibleName(plain_text(f"{self._number.text()}: {step.title}. {step.words}"))
        layout = self.layout()
        assert layout is not None
        layout.invalidate()
        layout.activate()
        self.setFixedHeight(layout.totalHeightForWidth(WIDTH))

    @property
    def body(self) -> QSize:
        """The size without the rim."""
        return self.size() - QSize(2 * RIM, 2 * RIM)

    @property
    def words(self) -> tuple[str, str]:
        """The title and the words that are shown; empty while it is hidden."""
        return ("", "") if self.isHidden() else (self._title.text(), self._words.text())

    def stand(self, place: BesideControl, target: QRect) -> None:
        """Stand at a place, with the tip towards the middle of the control."""
        rim = place.box.adjusted(-RIM, -RIM, RIM, RIM)
        self.move(rim.topLeft())
        self._side = place.side
        body, middle = QRectF(self.rect()).adjusted(RIM, RIM, -RIM, -RIM), target.center()
        x = max(body.left() + 18, min(middle.x() - rim.left(), body.right() - 18))
        y = max(body.top() + 18, min(middle.y() - rim.top(), body.bottom() - 18))
        self._tip = {
            "below": QPointF(x, body.top() - GAP + 3),
            "above": QPointF(x, body.bottom() + GAP - 3),
            "right": QPointF(body.left() - GAP + 3, y),
            "left": QPointF(body.right() + GAP - 3, y),
        }.get(place.side, QPointF())
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a card with a tip at the side of the control."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        body = QRectF(self.rect()).adjusted(RIM, RIM, -RIM, -RIM)
        shape = QPainterPath()
        shape.addRoundedRect(body, RADIUS_NODE, RADIUS_NODE)
        if self._side:
            tip, across = self._tip, self._side in ("below", "above")
            foot = QPointF(8, 0) if across else QPointF(0, 8)
            inner = (
                QPointF(0, 10 if self._side == "below" else -10)
                if across
                else QPointF(10 if self._side == "right" else -10, 0)
            )
            wedge = QPainterPath()
            wedge.addPolygon(QPolygonF([tip, tip + inner + foot, tip + inner - foot, tip]))
            shape = shape.united(wedge)
        painter.setPen(QPen(self._tokens.acc, 1.5))
        painter.setBrush(self._tokens.surf)
        painter.drawPath(shape)
        painter.end()


class Ring(QWidget):
    """A ring around a control. Clicks and keys go through it."""

    def __init__(self, tokens: Tokens, window: QWidget) -> None:
        super().__init__(window)
        self._tokens = tokens
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setAccessibleName("What the tour points at")
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def surround(self, target: QRect) -> None:
        """Stand around a box of the window."""
        self.setGeometry(target.adjusted(-AROUND, -AROUND, AROUND, AROUND))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ring."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self._tokens.acc, 2.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1.5, 1.5, -1.5, -1.5), 8, 8)
        painter.end()
