"""The time left for a task: a shrinking bar, with a mark where another role is asked too."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.theme import Tokens

HEIGHT = 4


class TimeLeft(QWidget):
    """The bar. It neither blinks nor turns red, because the number above says the same."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._share, self._mark = tokens, 1.0, 0.0
        self.setFixedHeight(HEIGHT)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_share(self, share: float, mark: float) -> None:
        """Show the share of time left.

        ``mark`` is the share at which another role is asked too, 0 for none.
        """
        if (share, mark) != (self._share, self._mark):
            self._share, self._mark = share, mark
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the bar and the mark."""
        tokens, wide = self._tokens, float(self.width())
        painter = QPainter(self)
        painter.fillRect(QRectF(0, 0, wide, HEIGHT), tokens.line)
        painter.fillRect(QRectF(0, 0, wide * self._share, HEIGHT), tokens.acc)
        if 0.0 < self._mark < 1.0:
            ink = tokens.surf if self._mark < self._share else tokens.tx2
            painter.fillRect(QRectF(wide * self._mark - 1, 0, 2, HEIGHT), ink)
        painter.end()
