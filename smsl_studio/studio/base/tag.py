"""One fact chip as a widget."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt, Signal
from PySide6.QtGui import QFontMetrics, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from smsl_studio.legible import plain_text
from smsl_studio.picture.chip_kinds import VALUE
from smsl_studio.studio.base.chips import paint_chip
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text


class Tag(QWidget):
    """One chip: a digit (with a bar if it has a sub-SB) or a value. ``clicked``: it was pressed."""

    clicked = Signal()

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens, self._text, self._kind, self._sub = tokens, "", "value", False
        self._button = ""
        self.setFixedSize(20, 28)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def fit(self, text: str) -> None:
        """Make the chip as wide as its text needs, at most 76 pixels."""
        wide = QFontMetrics(mono_font(12, 500)).horizontalAdvance(text) + 10
        self.setFixedSize(max(20, min(wide, 76)), 28)
        self.setToolTip(tip_text(text))

    def press_with_keys(self, name: str) -> None:
        """Make the chip a button that takes the keyboard focus; ``name`` is its accessible name."""
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self._button = name

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter and Space click the chip."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space):
            self.clicked.emit()
            return
        super().keyPressEvent(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Emit ``clicked``."""
        self.clicked.emit()

    def show_tag(self, text: str, kind: str, sub: bool) -> None:
        """Show this text and kind of chip, with a bar if ``sub`` is true."""
        self._text, self._kind, self._sub = text, kind, sub
        words = self._button or (f"Digit {text}" if kind == VALUE else text)
        self.setAccessibleName(plain_text(words + (", with a sub-SB" if sub else "")))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the chip, with a frame while it has the keyboard focus."""
        chip = QRectF(1, 5, self.width() - 2, 18)
        metrics = QFontMetrics(mono_font(12, 500))
        wide = max(18, self.width() - 6)
        text = metrics.elidedText(plain_text(self._text), Qt.TextElideMode.ElideMiddle, wide)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_chip(painter, chip, text, self._kind, self._tokens, sub=self._sub)
        if self.hasFocus():
            painter.setPen(QPen(self._tokens.acc, 1.5))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRoundedRect(chip.adjusted(-0.2, -2, 0.2, 2), 5, 5)
