"""WorkCard: tells that work is under way, and calls it off."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QProgressBar, QPushButton, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.card import PassingCard, tint
from smsl_studio.studio.base.theme import Tokens, text_font

BAR = 90
"""The width of the bar that shows that work goes on (pixels)."""


class WorkCard(PassingCard):
    """A sentence, a moving bar, and Cancel, which Escape presses too."""

    cancelled = Signal()

    def __init__(self, parent: QWidget, tokens: Tokens, sentence: str) -> None:
        super().__init__(parent, tokens, 8.0)
        self.words = Label(sentence, self)
        self.words.setFont(text_font(12))
        tint(self.words, tokens.tx)
        bar = QProgressBar(self)
        bar.setRange(0, 0)
        bar.setTextVisible(False)
        bar.setFixedSize(BAR, 8)
        self.cancel = QPushButton("Cancel", self)
        self.cancel.clicked.connect(self._give_up)
        self.setAccessibleName(plain_text(sentence))
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 6, 6, 6)
        row.setSpacing(10)
        for part in (self.words, bar, self.cancel):
            row.addWidget(part)
        self.adjustSize()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape calls the work off. No other key reaches the drawing below."""
        if event.key() == Qt.Key.Key_Escape:
            self._give_up()
        event.accept()

    def _give_up(self) -> None:
        self.cancelled.emit()
        self.close_field()
