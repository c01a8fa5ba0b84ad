"""Values side by side: whether they are alike, which fields differ, how they read."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

Json = Any
T = TypeVar("T")
_LONGEST = 60


def alike(one: Json, other: Json) -> bool:
    """Whether two values are written alike up to the spelling of numbers; true is not 1."""
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
    """Every key whose values differ: the key, and on which sides it stands."""
    for key in merged(list(one), list(other)):
        here, there = key in one, key in other
        if not (here and there and alike(one[key], other[key])):
            yield key, here, there


def merged(before: list[T], after: list[T]) -> list[T]:
    """Both lists as one: the order of ``after``, what is only in ``before`` where it stood."""
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
    """A value in a sentence, cut where it is long."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"
