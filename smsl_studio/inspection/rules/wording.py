"""Words the rules share: near names, lists, numbers."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import nearest

_MANY = 400
"""Above so many known names only some that begin alike are compared, to stay quick."""


def near(name: str, known: Collection[str]) -> str:
    """The known name most like ``name``, or the empty text."""
    names = [other for other in known if other != name]
    if len(names) > _MANY:
        half = name[: max(1, len(name) // 2)]
        names = [other for other in names if other.startswith(half)][: _MANY // 4]
    return nearest(name, names)


def listed(words: Iterable[str], last: str = "and") -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    items = list(words)
    if len(items) < 2:
        return "".join(items)
    return f"{', '.join(items[:-1])} {last} {items[-1]}"


def some(words: Iterable[str], most: int = 3) -> str:
    """The first few of many: ``a, b, c and 4 more``."""
    items = list(words)
    if len(items) <= most + 1:
        return listed(items)
    return listed([*items[:most], f"{len(items) - most} more"])


def counted(number: int, word: str) -> str:
    """``1 state``, ``2 states``."""
    return f"{number} {word}" if number == 1 else f"{number} {word}s"


def fact_words(branch: StateBranch, digit: int) -> str:
    """The fact's plain name, or ``fact 1`` (counted from 1) where none is given."""
    note = branch.fact_note(digit)
    return note.name if note and note.name else f"fact {digit + 1}"
