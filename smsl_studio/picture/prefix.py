"""The prefix that all operations of an SB share. The canvas leaves it out."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import takewhile

SEPARATORS = "_-"


def shared_prefix(names: Iterable[str]) -> str:
    """Return the longest shared prefix that ends in ``_`` or ``-`` and is not a whole name.

    ``Op_1a`` and ``Op_2b`` share ``Op_``. ``Operation100A`` and ``Operation000`` share no such
    prefix, because the remaining text would not read as a name.
    """
    found = sorted(set(names))
    if len(found) < 2:
        return ""
    pairs = zip(found[0], found[-1], strict=False)
    common = "".join(a for a, _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    while common and (common[-1] not in SEPARATORS or common in found):
        common = common[:-1]
    return common
