"""Strict equality of values: in type, content and order of keys."""

from __future__ import annotations

from collections.abc import Collection
from itertools import compress
from operator import is_not
from typing import Any

Json = Any


def same(old: Json, new: Json) -> bool:
    """Return whether two values are equal in type, content and order of keys."""
    if old is new:
        return True
    if type(old) is not type(new):
        return False
    if isinstance(old, dict):
        return list(old) == list(new) and _all_same(old.values(), new.values())
    if isinstance(old, list):
        return len(old) == len(new) and _all_same(old, new)
    return bool(old == new)


def _all_same(old: Collection[Json], new: Collection[Json]) -> bool:
    """Return the same for all values of two rows of equal length. Nearly all are the same
    objects.
    """
    others = compress(zip(old, new, strict=True), map(is_not, old, new))
    return all(same(one, other) for one, other in others)
