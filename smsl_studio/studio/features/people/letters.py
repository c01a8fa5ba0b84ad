"""A letter for every answer, so that it can be chosen with one key."""

from __future__ import annotations

from collections.abc import Sequence
from string import ascii_uppercase

from smsl_studio.dispatch.supervision.table import COMMANDS

TAKEN = frozenset(row.key for row in COMMANDS.values() if len(row.key) == 1)
"""Keys of commands (veto, prune, take over): they mean something else beside the card."""


def letters(words: Sequence[str]) -> tuple[str, ...]:
    """One letter each: the first of a word where it is free, else any other in it, else any."""
    given: list[str] = []
    for text in words:
        upper = text.upper()
        first = [word[0] for word in upper.split()]
        free = (
            one
            for one in (*first, *upper, *ascii_uppercase)
            if one in ascii_uppercase and one not in TAKEN and one not in given
        )
        given.append(next(free, ""))
    return tuple(given)
