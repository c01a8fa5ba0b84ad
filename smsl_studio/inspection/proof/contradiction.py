"""Conditions that contradict themselves: no state of an SB has all that they name of it."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.properties.meaning import Meaning, States
from smsl_studio.stop import heed


def contradicted(meaning: Meaning) -> tuple[str, ...]:
    """Return the SBs of which no state fits a condition; none if the condition may be met.

    Each SB is looked at by itself. A condition that only the ties between SBs forbid is not found.
    """
    if isinstance(meaning, States):
        return () if meaning.states else (meaning.branch,)
    if not meaning.every:
        parts = [contradicted(part) for part in meaning.parts]
        found = (name for part in parts for name in part)
        return tuple(dict.fromkeys(found)) if all(parts) else ()
    left: dict[str, frozenset[str]] = {}
    inner: list[str] = []
    for part in _joined(meaning):
        heed()
        if isinstance(part, States):
            left[part.branch] = left.get(part.branch, part.states) & part.states
        else:
            inner += contradicted(part)
    return tuple(dict.fromkeys((*(name for name, states in left.items() if not states), *inner)))


def _joined(meaning: Meaning) -> Iterator[Meaning]:
    """Yield the parts that must all be true, also those of inner ``and``."""
    if isinstance(meaning, States) or not meaning.every:
        yield meaning
    else:
        for part in meaning.parts:
            yield from _joined(part)
