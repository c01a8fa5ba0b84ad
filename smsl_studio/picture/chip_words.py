"""The words on the chips of a state: what the values of its facts mean, as many as have room."""

from __future__ import annotations

from functools import cached_property

from smsl_studio.blueprint.known_values import values_of
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.picture.levels import FULL_MAX
from smsl_studio.picture.words import mono_width

LONGEST_WORD = 10
"""The largest number of characters of a meaning on a chip."""
MOST_WORDED = 64
"""No more facts than this are looked at; a node has no room for the words of so many."""
CHIP, GAP, CHIP_TEXT = 18.0, 4.0, 12.0
"""The height of a chip, which is also its least width, the space between two chips, and the size of
their text."""
ROOM = FULL_MAX - 12.0
"""The room for the chips of the widest node (pixels)."""


class ChipWords:
    """The words for the values of one SB.

    A fact has words in all states or in none, so that states can be compared. If there is no room
    for the words of all facts, the first facts have words and the others digits.
    """

    def __init__(self, branch: StateBranch) -> None:
        self._branch = branch

    def text(self, digit: int, value: str) -> str:
        """Return what the chip of a fact says."""
        return self._meaning(digit, value) if digit in self._worded else value

    @cached_property
    def _worded(self) -> frozenset[int]:
        """The facts whose words have room."""
        branch = self._branch
        digits = range(min(branch.num_facts, len(branch.alphabet), MOST_WORDED))
        short = {digit: self._widest(digit, words=False) for digit in digits}
        needed = sum(short.values()) + GAP * (len(short) - 1)
        found = set()
        for digit in digits:
            more = self._widest(digit, words=True) - short[digit]
            if needed + more <= ROOM:
                needed += more
                found.add(digit)
        return frozenset(found)

    def _widest(self, digit: int, words: bool) -> float:
        """The width of the widest chip of a fact (pixels), with words or without."""
        values = values_of(self._branch, digit)
        texts = [self._meaning(digit, value) if words else value for value in values]
        return max(map(text_room, texts), default=CHIP)

    def _meaning(self, digit: int, value: str) -> str:
        note = self._branch.fact_note(digit)
        meaning = note.values.get(value, "") if note is not None else ""
        if meaning:
            return _cut(meaning, LONGEST_WORD)
        if not self._has_words:
            return value
        # Other chips show words. A digit alone would say nothing, so the name of its fact is added.
        room = max(LONGEST_WORD - len(value) - 2, 4)
        return f"{_cut(self._branch.fact_name(digit), room)}: {value}"

    @cached_property
    def _has_words(self) -> bool:
        return has_words(self._branch)


def text_room(text: str) -> float:
    """Return the width of a chip with a text (pixels)."""
    return max(CHIP, mono_width(text, CHIP_TEXT) + 8.0)


def has_words(branch: StateBranch) -> bool:
    """Return whether any fact of an SB has a name or a value with a meaning."""
    return any(note.name or note.values for note in branch.notes.facts.values())


def _cut(text: str, most: int) -> str:
    return f"{text[: most - 1]}…" if len(text) > most else text
