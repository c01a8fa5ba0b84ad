"""The zoom control: zoom out, the zoom in percent (a click sets 100 %), zoom in, fit.

If states are outside the view it shows how many; a click there fits all.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSize, Signal
from PySide6.QtGui import QEnterEvent, QFontMetrics, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout

from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.overlays.card import Card, IconButton
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted

OUTSIDE = 92
"""The usual width of the number of states that are outside (pixels)."""
BESIDE = 24
"""The room beside its words (pixels)."""


class ZoomControl(Card):
    """The card with the zoom buttons, usually at the bottom right of the canvas.

    While the pointer is on it, it keeps its place and its size: the next click hits the same
    button.
    """

    left = Signal()
    """The pointer has left it."""

    def __init__(self, canvas: BranchView, tokens: Tokens) -> None:
        super().__init__(canvas, tokens)
        self.held = False
        """Whether the pointer is on it."""
        self.less = IconButton(self, tokens, "minus", "Zoom out")
        self.value = IconButton(self, tokens, "", "Zoom to 100 % (Shift+0)")
        self.more = IconButton(self, tokens, "plus", "Zoom in")
        self.fit = IconButton(self, tokens, "fit", "Fit (F)")
        self.value.setFixedWidth(52)
        self.outside = IconButton(self, tokens, "", "Fit (F)")
        self.outside.accent = True
        self.outside.setFixedWidth(OUTSIDE)
        self.outside.hide()
        layout = QHBoxLayout(self)
        layout.setContentsMargins(3, 1, 3, 1)
        layout.setSpacing(0)
        for button in (self.less, self.value, self.more):
            layout.addWidget(button)
        layout.addSpacing(8)
        layout.addWidget(self.fit)
        layout.addWidget(self.outside)
        self.less.clicked.connect(canvas.zoom_out)
        self.more.clicked.connect(canvas.zoom_in)
        self.value.clicked.connect(lambda: canvas.zoom_to(1.0))
        for all_ in (self.fit, self.outside):
            all_.clicked.connect(lambda: canvas.fit())
        self.show_zoom(1.0)

    def enterEvent(self, event: QEnterEvent) -> None:
        """Stay from now on."""
        super().enterEvent(event)
        self.held = True

    def leaveEvent(self, event: QEvent) -> None:
        """Go where there is room now."""
        super().leaveEvent(event)
        self.held = False
        self.left.emit()

    def sizeHint(self) -> QSize:
        """The size of the buttons; wider while it shows how many states are outside."""
        return QSize(156 + (0 if self.outside.isHidden() else self.outside.width()), 32)

    def show_outside(self, states: int) -> None:
        """Show how many states are outside the view; 0 hides the number.

        While the pointer is on another button, nothing changes.
        """
        if self.held and not self.outside.underMouse():
            return
        words = f"{states:,} outside" if states else ""
        if words != self.outside.text():
            self.outside.setText(words)
            wide = QFontMetrics(text_font(13)).horizontalAdvance(words) + BESIDE
            self.outside.setFixedWidth(max(OUTSIDE, wide))
            name = f"{counted(states, 'state')} outside the view. Fit (F)"
            self.outside.setAccessibleName(name)
            self.outside.setToolTip(tip_text(name))
            self.outside.setVisible(bool(states))

    def show_zoom(self, zoom: float) -> None:
        """Show the zoom in percent; 1.0 is 100 %."""
        percent = zoom * 100.0
        self.value.setText(f"{percent:.0f} %" if percent >= 10 else f"{percent:.1f} %")

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card, and a line before the button Fit."""
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setPen(QPen(self.tokens.line, 1.0))
        x = self.fit.x() - 4
        painter.drawLine(x, 8, x, self.height() - 9)
        painter.end()
