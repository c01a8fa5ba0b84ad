"""The prefix that most operations of an SB share. A drawing leaves it out of their names."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable
from itertools import takewhile

SEPARATORS = "_-"
OTHERS = 10
"""At most one name in so many may lack the prefix."""


def left_out(names: Iterable[str]) -> str:
    """Return the prefix that labels leave out: the longest one that ends in ``_`` or ``-`` and that
    all names share. If there is none, one that nearly all share. All names remain and stay
    different without it. Empty if there is none.

    ``Op_1a`` and ``Op_2b`` share ``Op_``. ``Operation100A`` and ``Operation000`` share no such
    prefix, because the remaining text would not read as a name. A name without the prefix is
    written in full: one odd operation must not make all labels long.
    """
    found = sorted(set(names))
    if len(found) < 2:
        return ""
    few = len(found) // OTHERS
    return _shared(found, 0) or (_shared(found, few) if few else "")


def _shared(found: list[str], few: int) -> str:
    """Return the longest prefix that at most ``few`` of the sorted names lack and that may go."""
    # Sorted names with the same prefix stand together. So these two have it.
    pairs = zip(found[few], found[-1 - few], strict=False)
    prefix = "".join(a for a, _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    known = set(found)
    while prefix and not (prefix[-1] in SEPARATORS and _may_go(prefix, few, found, known)):
        prefix = prefix[:-1]
    return prefix


def _may_go(prefix: str, few: int, found: list[str], known: set[str]) -> bool:
    """Return whether few names lack a prefix, and names without it are different."""
    first = bisect_left(found, prefix)
    end = bisect_left(found, prefix[:-1] + chr(ord(prefix[-1]) + 1))
    others = [*found[:first], *found[end:]]
    if prefix in known or len(others) > few:
        return False
    return not any(prefix + other in known for other in others)
