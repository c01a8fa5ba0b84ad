"""The prefix that all operations of an SB share and that the canvas leaves out."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import takewhile

SEPARATORS = "_-"


def shared_prefix(names: Iterable[str]) -> str:
    """The longest shared start that ends in ``_`` or ``-`` and leaves something of every name.

    ``Op_1a`` and ``Op_2b`` share ``Op_``; ``Operation100A`` and ``Operation000`` share nothing
    that may be left out, since what remains would not read as a name.
    """
    found = sorted(set(names))
    if len(found) < 2:
        return ""
    pairs = zip(found[0], found[-1], strict=False)
    common = "".join(a for a, _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    while common and (common[-1] not in SEPARATORS or common in found):
        common = common[:-1]
    return common
