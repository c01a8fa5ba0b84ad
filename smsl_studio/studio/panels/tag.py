"""A single fact chip as a widget."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.chips import paint_chip
from smsl_studio.studio.theme import Tokens


class Tag(QWidget):
    """One chip: a digit's number, with the bar of a sub-SB."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens, self._text, self._kind, self._sub = tokens, "", "value", False
        self.setFixedSize(20, 28)

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.update()

    def show_tag(self, text: str, kind: str, sub: bool) -> None:
        self._text, self._kind, self._sub = text, kind, sub
        self.setAccessibleName(f"Fact {text}" + (", with a sub-SB" if sub else ""))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        chip = QRectF(1, 5, 18, 18)
        paint_chip(QPainter(self), chip, self._text, self._kind, self._tokens, sub=self._sub)
