"""A text widget without line wrapping that knows the positions of its rows."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtWidgets import QPlainTextEdit, QWidget

from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.draw.source.folds import Folds
from smsl_studio.studio.features.draw.source.sheet import TextSheet


class TextRows(QPlainTextEdit):
    """The visible rows of a text. Lines are those shown, counted from 0."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.sheet = TextSheet()
        self.folds = Folds(self)

    def rows(self) -> Iterator[tuple[int, float, float]]:
        """The lines in view: (line, top, height), in pixels of the viewport."""
        block = self.firstVisibleBlock()
        top = self.blockBoundingGeometry(block).translated(self.contentOffset()).top()
        while block.isValid() and top <= self.viewport().height():
            height = self.blockBoundingRect(block).height()
            if block.isVisible():
                yield block.blockNumber(), top, height
                top += height
            block = block.next()

    def row_at(self, y: float) -> int | None:
        """The line at a height in pixels, or None."""
        return next((line for line, top, high in self.rows() if top <= y < top + high), None)
