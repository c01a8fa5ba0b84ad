"""Compares values: whether they are equal, which fields differ, and their words."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any, TypeVar

Json = Any
T = TypeVar("T")
_LONGEST, _DEEPEST, _MOST = 60, 3, 30


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
    """Return a value for a sentence, in words and not as JSON, and cut if it is long."""
    text = _in_words(value, _DEEPEST)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def _in_words(value: Json, depth: int) -> str:
    """Return a value as words. Of long lists the first items are enough, as the text is cut."""
    if isinstance(value, str):
        return value
    if value is None:
        return "nothing"
    if isinstance(value, Mapping | list | tuple) and not value:
        return "nothing"
    if depth and isinstance(value, Mapping):
        pairs = islice(value.items(), _MOST)
        return ", ".join(f"{key}: {_in_words(one, depth - 1)}" for key, one in pairs)
    if depth and isinstance(value, list | tuple):
        return ", ".join(_in_words(one, depth - 1) for one in value[:_MOST])
    if isinstance(value, Mapping | list | tuple):
        return f"{len(value)} entries"
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return json.dumps(value, ensure_ascii=False)
