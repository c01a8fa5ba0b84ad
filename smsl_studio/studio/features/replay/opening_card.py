"""The progress of reading a long recording, with a button to cancel."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer
from PySide6.QtGui import QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.replay.loader import RecordingLoader

WIDTH, LOW, LINE = 460, 46, 4.0
"""Width of the card, distance from the bottom, and thickness of the progress bar (pixels)."""
SOON, OFTEN = 300, 100
"""Milliseconds until the card appears, and between two updates."""


class OpeningCard(QWidget):
    """A card at the bottom of ``over`` while ``opening`` reads."""

    def __init__(self, opening: RecordingLoader, tokens: Tokens, over: QWidget) -> None:
        super().__init__(over)
        self._opening, self._tokens, self._over = opening, tokens, over
        self.words = label("", "heading")
        self.cancel = QPushButton("Cancel")
        self.cancel.setToolTip("Read no further (Esc)")
        self.cancel.setShortcut(Qt.Key.Key_Escape)
        self.cancel.clicked.connect(opening.give_up)
        across = QHBoxLayout(self)
        across.setContentsMargins(16, 10, 12, 16)
        across.addWidget(self.words, 1)
        across.addWidget(self.cancel)
        self._clock = QTimer(self)
        self._clock.timeout.connect(self._look)
        opening.began.connect(lambda: self._clock.start(SOON))
        opening.ended.connect(self._end)
        over.installEventFilter(self)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Stay in place when the widget below changes its size."""
        if watched is self._over and event.type() == QEvent.Type.Resize and not self.isHidden():
            self._place()
        return super().eventFilter(watched, event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background and progress bar."""
        t, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(t.line2, 1))
        painter.setBrush(t.surf)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 8, 8)
        line = QRectF(16, self.height() - 12, self.width() - 32, LINE)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(t.line2)
        painter.drawRoundedRect(line, LINE / 2, LINE / 2)
        line.setWidth(line.width() * self._share)
        painter.setBrush(t.acc)
        painter.drawRoundedRect(line, LINE / 2, LINE / 2)
        painter.end()

    @property
    def _share(self) -> float:
        reading = self._opening.reading
        return reading.share if reading is not None else 1.0

    def _look(self) -> None:
        reading = self._opening.reading
        if reading is None:
            return
        self._clock.setInterval(OFTEN)
        self.words.setText(f"Reading {reading.path.name}, {reading.share:.0%}")
        if self.isHidden():
            self.show()
            self._place()
            self.raise_()
        self.update()

    def _end(self) -> None:
        self._clock.stop()
        self.hide()

    def _place(self) -> None:
        wide = min(WIDTH, self._over.width() - 2 * LOW)
        high = self.sizeHint().height()
        left = (self._over.width() - wide) // 2
        self.setGeometry(left, self._over.height() - high - LOW, wide, high)
