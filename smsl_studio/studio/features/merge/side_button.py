"""The three buttons of a conflict: take mine, theirs or base."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QEnterEvent,
    QFocusEvent,
    QFontMetricsF,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
)
from PySide6.QtWidgets import QAbstractButton, QSizePolicy

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint.change_signs import BASE, MINE, THEIRS, draw_side
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text

LETTERS = {"ours": MINE, "theirs": THEIRS, "base": BASE}
SIZE = QSize(120, 46)


class SideButton(QAbstractButton):
    """Says the value of one version. Hover and focus preview it, a click takes it."""

    looked_at = Signal(bool)
    """bool: the pointer or the focus is on the button, or has left it."""

    def __init__(self, side: str, words: str, tokens: Tokens) -> None:
        super().__init__()
        self._side, self._value, self._tokens = side, "", tokens
        self.setText(words)
        self.setCheckable(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """120 by 46 pixels."""
        return SIZE

    def show_value(self, value: str, chosen: bool, known: bool) -> None:
        """Show the value of this version, and whether it is the chosen one."""
        self._value = value
        self.setChecked(chosen)
        self.setEnabled(known)
        told = ", chosen" if chosen else ""
        self.setAccessibleName(plain_text(f"Take {self.text().lower()}, {value}{told}"))
        self._tell_cut()
        self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def _tell_cut(self) -> None:
        """Put the value into the tooltip if it is cut; a tooltip would cover the preview."""
        cut = QFontMetricsF(mono_font(11)).horizontalAdvance(self._value) > self.width() - 18
        self.setToolTip(tip_text(f"{self.text()}: {self._value}" if cut else ""))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Look again whether the value is cut."""
        super().resizeEvent(event)
        self._tell_cut()

    def nextCheckState(self) -> None:
        """A click does not check the button; the choice does, after it was made."""

    def enterEvent(self, event: QEnterEvent) -> None:
        """Preview this version."""
        super().enterEvent(event)
        self.looked_at.emit(self.isEnabled())
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """End the preview."""
        super().leaveEvent(event)
        self.looked_at.emit(False)
        self.update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Preview this version."""
        super().focusInEvent(event)
        self.looked_at.emit(True)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """End the preview."""
        super().focusOutEvent(event)
        self.looked_at.emit(False)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the sign and the word of the version above its value."""
        tokens, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        looked = self.isEnabled() and (self.underMouse() or self.hasFocus())
        chosen = self.isChecked()
        edge = QPen(tokens.acc if chosen or looked else tokens.line2, 2 if chosen else 1.2)
        if looked and not chosen:
            edge.setDashPattern([3, 2])
        painter.setPen(edge)
        painter.setBrush(tokens.accs if chosen else tokens.surf)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 6, 6)
        draw_side(painter, 16, 14, 6.0, LETTERS[self._side], tokens)
        wide = self.width()
        name = tokens.acc if chosen else tokens.tx if self.isEnabled() else tokens.tx3
        paint_text(painter, QRectF(29, 4, wide - 48, 20), self.text(), TextInk(name, 12, 500))
        if chosen:
            draw(painter, "check", QRectF(wide - 21, 8, 12, 12), tokens.acc, tokens.accs)
        value = tokens.tx if self.isEnabled() else tokens.tx3
        mono = self._value not in ("removed", "not there", "not known")
        ink = TextInk(value, 11, 400, mono)
        paint_text(painter, QRectF(10, 24, wide - 18, 18), self._value, ink)
        painter.end()
