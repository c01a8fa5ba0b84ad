"""When two values are written alike: equal in type, content and order of keys."""

from __future__ import annotations

from typing import Any

Json = Any


def same(old: Json, new: Json) -> bool:
    """Whether two values are equal in type, content and order of keys."""
    if old is new:
        return True
    if type(old) is not type(new):
        return False
    if isinstance(old, dict):
        return (
            len(old) == len(new)
            and all(a == b for a, b in zip(old, new, strict=True))
            and all(same(value, new[key]) for key, value in old.items())
        )
    if isinstance(old, list):
        return len(old) == len(new) and all(map(same, old, new))
    return bool(old == new)
