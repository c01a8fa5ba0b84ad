"""Names of State Branches and operations, made of the words of a text."""

from __future__ import annotations

import re
import unicodedata

_LETTERS = {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue"}
_SMALL = frozenset((
    "the", "a", "an", "to", "of", "and", "or", "on", "in", "at", "by", "for", "with", "is", "are",
    "be", "that", "it", "der", "die", "das", "den", "dem", "des", "ein", "eine", "einen", "einem",
    "einer", "und", "oder", "zu", "mit", "in", "auf", "an", "von", "für", "ist", "sind", "sich",
))  # fmt: skip
_MOST = 5
"""A name has at most so many words; the title has all of them."""
_LONGEST = 40


class FreshNames:
    """Gives names that nobody has yet. Names that differ by case only count as equal."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def operation(self, text: str) -> str:
        """Return a name for an operation, such as ``Op_FixLeg``."""
        words = [word[:1].upper() + word[1:] for word in _words(text)]
        return self._fresh("Op_" + ("".join(words)[:_LONGEST] or "Step"))

    def branch(self, text: str) -> str:
        """Return a name for a State Branch, such as ``FIX_LEG``."""
        return self._fresh("_".join(_words(text)).upper()[:_LONGEST].strip("_") or "PROCEDURE")

    def _fresh(self, name: str) -> str:
        found, number = name, 1
        while found.casefold() in self._taken:
            number += 1
            found = f"{name}_{number}"
        self._taken.add(found.casefold())
        return found


def _words(text: str) -> list[str]:
    for letter, plain in _LETTERS.items():
        text = text.replace(letter, plain)
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    words = re.findall(r"[A-Za-z0-9]+", plain)
    kept = [word for word in words if word.lower() not in _SMALL] or words
    return kept[:_MOST]
