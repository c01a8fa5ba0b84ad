"""Pieces of a text that give way to others."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Piece(NamedTuple):
    """What stands between two offsets of a text gives way to another text."""

    start: int
    end: int
    text: str

    @property
    def growth(self) -> int:
        """By how many characters the text gets longer."""
        return len(self.text) - (self.end - self.start)


def spliced(text: str, pieces: Iterable[Piece], start: int = 0, end: int | None = None) -> str:
    """The text between two offsets with all that gives way in it, in order."""
    found: list[str] = []
    for piece in pieces:
        found += (text[start : piece.start], piece.text)
        start = piece.end
    return "".join([*found, text[start : len(text) if end is None else end]])
