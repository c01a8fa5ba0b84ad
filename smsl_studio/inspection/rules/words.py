"""Words that the rules share: similar names, lists, numbers."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Container, Iterable
from functools import cached_property
from itertools import islice, takewhile

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import nearest

_MANY = 400
"""The largest number of names that are all compared. Of more names only those that begin alike
are compared, to stay quick."""


class NearNames:
    """Known names, to find the one that a misspelled name probably means."""

    def __init__(self, known: Iterable[str]) -> None:
        self._known = list(known)

    @cached_property
    def _sorted(self) -> list[str]:
        return sorted(self._known)

    def near(self, name: str, without: Container[str] = ()) -> str:
        """Return the known name that is most similar to ``name`` and not in ``without``. The text
        is empty if no name is similar."""
        names: Iterable[str] = self._known
        if len(self._known) > _MANY:
            half = name[: max(1, len(name) // 2)]
            first = bisect_left(self._sorted, half)
            names = takewhile(
                lambda other: other.startswith(half), self._sorted[first : first + _MANY]
            )
        others = (other for other in names if other != name and other not in without)
        many = _MANY if len(self._known) <= _MANY else _MANY // 4
        return nearest(name, islice(others, many))


def listed(words: Iterable[str], last: str = "and") -> str:
    """Join words: ``a``, ``a and b``, ``a, b and c``."""
    items = list(words)
    if len(items) < 2:
        return "".join(items)
    return f"{', '.join(items[:-1])} {last} {items[-1]}"


def some(words: Iterable[str], most: int = 3, last: str = "and") -> str:
    """Join the first ``most`` words and count the rest: ``a, b, c and 4 more``."""
    items = list(words)
    if len(items) <= most + 1:
        return listed(items, last)
    return listed([*items[:most], f"{len(items) - most} more"], last)


def counted(number: int, word: str) -> str:
    """Return a number with its noun: ``1 state``, ``2 states``."""
    return f"{number} {word}" if number == 1 else f"{number} {word}s"


def fact_words(branch: StateBranch, digit: int) -> str:
    """Return the name of a fact, or ``fact 1`` if it has none. ``digit`` counts from 0, the words
    count from 1."""
    note = branch.fact_note(digit)
    return note.name if note and note.name else f"fact {digit + 1}"
