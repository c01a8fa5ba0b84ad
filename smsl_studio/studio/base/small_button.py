"""A small button with an icon, for use at the end of a line."""

from __future__ import annotations

from PySide6.QtWidgets import QToolButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

SIDE = 24


class SmallButton(QToolButton):
    """A button whose words are its tooltip and its accessible name."""

    def __init__(self, words: str, picture: str, tokens: Tokens, size: int = 12) -> None:
        super().__init__()
        self._size, self._tokens = size, tokens
        self.setProperty("role", "small")
        self.setFixedSize(SIDE, SIDE)
        self.show_as(words, picture)

    def show_as(self, words: str, picture: str) -> None:
        """Show another icon, with the words of what it does now."""
        self._picture = picture
        self.setToolTip(tip_text(words))
        self.setAccessibleName(plain_text(words))
        self.set_tokens(self._tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.setIcon(icon(self._picture, tokens, self._size))
