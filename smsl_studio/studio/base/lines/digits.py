"""A line for digits of an SB, separated by commas."""

from __future__ import annotations

from typing import Any

from smsl_studio.studio.base.lines.text import ListLine


class DigitsLine(ListLine):
    """Facts by their place in the fact string, counted from 0; each once, in order."""

    def text_of(self, value: Any) -> str:
        """The digits, separated by commas."""
        return ", ".join(map(str, value))

    def value_of(self, text: str) -> Any:
        """The digits in order, None for none; raises ``ValueError`` if a word is no digit."""
        texts = super().value_of(text) or []
        for word in texts:
            if not (word.isascii() and word.isdecimal() and len(word) < 7):
                raise ValueError(f"“{word[:40]}” is no digit. Write whole numbers, counted from 0.")
        return sorted({int(word) for word in texts}) or None
