"""The small button behind a line: a picture, and the words of what it does."""

from __future__ import annotations

from PySide6.QtWidgets import QToolButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

SIDE = 24


class SmallButton(QToolButton):
    """Says by its tooltip, and to assistive tools, what a click does."""

    def __init__(self, words: str, picture: str, tokens: Tokens, size: int = 12) -> None:
        super().__init__()
        self._picture, self._size = picture, size
        self.setProperty("role", "small")
        self.setFixedSize(SIDE, SIDE)
        self.setToolTip(tip_text(words))
        self.setAccessibleName(plain_text(words))
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self.setIcon(icon(self._picture, tokens, self._size))
