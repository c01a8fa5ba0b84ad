"""Compares values: whether they are equal, which fields differ, and their words."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

Json = Any
T = TypeVar("T")
_LONGEST = 60


def alike(one: Json, other: Json) -> bool:
    """Return whether two values are equal except for the spelling of numbers. True is not 1."""
    if one is other:
        return True
    if isinstance(one, bool) or isinstance(other, bool):
        return False
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(alike(v, other[k]) for k, v in one.items())
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        return len(one) == len(other) and all(map(alike, one, other))
    return bool(one == other)


def fields_that_differ(
    one: Mapping[str, Json], other: Mapping[str, Json]
) -> Iterator[tuple[str, bool, bool]]:
    """Yield every key whose values differ, and on which sides it is."""
    for key in merged(list(one), list(other)):
        here, there = key in one, key in other
        if not (here and there and alike(one[key], other[key])):
            yield key, here, there


def merged(before: list[T], after: list[T]) -> list[T]:
    """Return both lists as one, in the order of ``after``. Items that are only in ``before`` keep
    their places.
    """
    kept = set(after)
    follow: dict[T | None, list[T]] = {}
    last: T | None = None
    for item in before:
        if item in kept:
            last = item
        else:
            follow.setdefault(last, []).append(item)
    found = list(follow.get(None, ()))
    for item in after:
        found.append(item)
        found.extend(follow.get(item, ()))
    return found


def said(value: Json) -> str:
    """Return a value for a sentence, cut if it is long."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
