"""A short list below a field, such as names that fit what is typed."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.paint.ink import NO_PEN, Type
from smsl_studio.studio.base.theme import Tokens, text_font

ROW = 28


class Choices(QWidget):
    """A list of names or answers, of which an arrow key or a click chooses one."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._type = Type(text_font(13))
        self._names: list[str] = []
        self._at = -1
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    @property
    def current(self) -> str:
        """The chosen name; empty while none is chosen."""
        return self._names[self._at] if 0 <= self._at < len(self._names) else ""

    @property
    def names(self) -> tuple[str, ...]:
        """The names that are offered."""
        return tuple(self._names)

    @property
    def at(self) -> int:
        """The row of the chosen name; -1 while none is chosen."""
        return self._at

    def show_names(self, names: list[str], at: int = -1) -> None:
        """Offer these names and choose one or none (-1); without names the list hides."""
        self._names, self._at = names, at
        self.setVisible(bool(names))
        self.setFixedHeight(len(names) * ROW)
        self.update()

    def move_choice(self, step: int) -> None:
        """Move the choice by so many rows; it wraps around at the ends."""
        if self._names:
            self._at = (self._at + step) % len(self._names)
            self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Emit ``chosen`` with the clicked name."""
        row = int(event.position().y() // ROW)
        if 0 <= row < len(self._names):
            self._at = row
            self.chosen.emit(self._names[row])

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the names, with a highlight on the chosen one."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for i, name in enumerate(self._names):
            rect = QRectF(0, i * ROW, self.width(), ROW - 1)
            if i == self._at:
                painter.setPen(NO_PEN)
                painter.setBrush(self._tokens.accs)
                painter.drawRoundedRect(rect, 5, 5)
            text = self._type.elided(name, self.width() - 20)
            self._type.draw_from(painter, 8, rect.center().y(), text, self._tokens.tx)
        painter.end()
