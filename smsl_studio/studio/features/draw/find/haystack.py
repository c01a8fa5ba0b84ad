"""Finds lines for a typed text: names first, then prefixes, words, parts and scattered letters.

All lines are joined to one text, which ``str.find`` and ``re`` search in C: with 59,049 states this
takes a few milliseconds a keystroke.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import NamedTuple

EXACT, PREFIX, FIELD, WORD, PIECE, LETTERS = range(6)
"""How well a line matches; lower is better."""
SEPARATORS = "_- ./"
MOST_HITS = 6_000
"""At most this many occurrences are looked at; a text with more of them is too common to rank."""
LONGEST = 100
FIELDS = "\t"


class Hit(NamedTuple):
    """A line that matches.

    Hits sort by tier, then by the length of the name, then by line number.
    """

    tier: int
    length: int
    line: int


class Haystack:
    """Lines of tab-separated fields, the name first. Upper and lower case are equal."""

    def __init__(self, lines: Sequence[str]) -> None:
        cleaned = [line.replace("\n", " ") for line in lines]
        written = "\n" + "\n".join(cleaned) + "\n"
        text = written.lower()
        if len(text) != len(written):  # a few letters get longer in lower case
            text = "\n" + "\n".join(_lowered(line) for line in cleaned) + "\n"
        self._written, self._text = written, text
        self._starts = list(accumulate((len(line) + 1 for line in cleaned), initial=1))

    def __len__(self) -> int:
        return len(self._starts) - 1

    def find(self, typed: str, most: int) -> list[Hit]:
        """The best ``most`` lines, in order.

        A line must hold all typed words, or all letters in order.
        """
        words = _lowered(typed[:LONGEST].replace("\n", " ").replace(FIELDS, " ")).split()
        if not words:
            return []
        found: dict[int, int] = {}
        phrase = " ".join(words)
        self._add(found, self._phrase(phrase))
        if len(words) > 1:
            self._add(found, self._all(words))
        if len(found) < most:
            self._add(found, self._letters("".join(words), most))
        return sorted(self._hit(line, tier) for line, tier in found.items())[:most]

    def holding(self, typed: str) -> Iterator[tuple[int, int, int]]:
        """Every line that holds the typed text, in the order of the lines.

        With its number, and the place of the text in it (from, to).
        """
        phrase = " ".join(_lowered(typed[:LONGEST]).split())
        starts, at = self._starts, self._text.find(phrase) if phrase else -1
        while at >= 0:
            line = bisect_right(starts, at) - 1
            yield line, at - starts[line], at - starts[line] + len(phrase)
            at = self._text.find(phrase, starts[line + 1])

    def line(self, number: int) -> str:
        """A line as it was given."""
        return self._written[self._starts[number] : self._starts[number + 1] - 1]

    def _add(self, found: dict[int, int], pairs: Iterator[tuple[int, int]]) -> None:
        for line, tier in pairs:
            found[line] = min(tier, found.get(line, tier))

    def _hit(self, line: int, tier: int) -> Hit:
        start = self._starts[line]
        end = self._starts[line + 1] - 1
        name = self._text.find(FIELDS, start, end)
        return Hit(tier, (end if name < 0 else name) - start, line)

    def _phrase(self, phrase: str) -> Iterator[tuple[int, int]]:
        for mark, tier in (("\n", PREFIX), (FIELDS, FIELD), *((s, WORD) for s in SEPARATORS)):
            for at in self._places(mark + phrase):
                end = self._text[at + 1 + len(phrase)]
                yield self._line(at + 1), EXACT if tier == PREFIX and end in "\n\t" else tier
        for at in self._places(phrase):
            yield self._line(at), WORD if self._begins_word(at) else PIECE

    def _all(self, words: list[str]) -> Iterator[tuple[int, int]]:
        """The lines that hold every word; the rarest word is searched first."""
        rarest = min(words, key=lambda word: (self._text.count(word), -len(word)))
        others = [word for word in words if word != rarest]
        seen = set()
        for at in self._places(rarest):
            line = self._line(at)
            if line in seen:
                continue
            seen.add(line)
            start, end = self._starts[line], self._starts[line + 1]
            places = [self._text.find(word, start, end) for word in others]
            if min(places, default=0) >= 0:
                words_begin = all(self._begins_word(place) for place in (at, *places))
                yield line, WORD if words_begin else PIECE

    def _letters(self, letters: str, most: int) -> Iterator[tuple[int, int]]:
        """The lines whose name holds all letters in this order."""
        parts = (f"[^{re.escape(one)}\n\t]*+{re.escape(one)}" for one in letters)
        for count, match in enumerate(re.finditer("\n" + "".join(parts), self._text)):
            if count >= most:
                return
            yield self._line(match.start() + 1), LETTERS

    def _places(self, piece: str) -> Iterator[int]:
        at, find = self._text.find(piece), self._text.find
        for _ in range(MOST_HITS):
            if at < 0:
                return
            yield at
            at = find(piece, at + 1)

    def _line(self, at: int) -> int:
        return bisect_right(self._starts, at) - 1

    def _begins_word(self, at: int) -> bool:
        """Whether a word begins here: after a sign, between letter and digit, or at a capital
        letter."""
        before, here = self._written[at - 1], self._written[at]
        if not before.isalnum() or before.isdigit() != here.isdigit():
            return True
        return before.islower() and here.isupper()


def _lowered(text: str) -> str:
    """The text in lower case with its length unchanged, so that positions stay valid."""
    lowered = text.lower()
    if len(lowered) == len(text):
        return lowered
    return "".join(one if len(one.lower()) > 1 else one.lower() for one in text)
