"""Replacements of pieces of a text."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Piece(NamedTuple):
    """The text between two offsets is replaced by another text."""

    start: int
    end: int
    text: str

    @property
    def growth(self) -> int:
        """The number of characters that the text gets longer by."""
        return len(self.text) - (self.end - self.start)


def spliced(text: str, pieces: Iterable[Piece], start: int = 0, end: int | None = None) -> str:
    """Return the text between two offsets with the pieces replaced. The pieces are in order."""
    found: list[str] = []
    for piece in pieces:
        found += (text[start : piece.start], piece.text)
        start = piece.end
    return "".join([*found, text[start : len(text) if end is None else end]])
