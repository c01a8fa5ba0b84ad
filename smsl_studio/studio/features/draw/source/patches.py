"""What must be replaced to turn one text into another, and no more."""

from __future__ import annotations

from collections.abc import Sequence

Patch = tuple[int, int, str]


def patches(old: str, new: str) -> list[Patch]:
    """What to replace to turn ``old`` into ``new``: start, end (in ``old``) and the new part.

    The last one comes first, so that each can be applied without moving the others. Where only
    single lines differ (a state renamed wherever it is a target), only these are replaced.
    """
    start = common_prefix(old, new)
    tail = common_suffix(old, new, min(len(old), len(new)) - start)
    before, after = old[start : len(old) - tail], new[start : len(new) - tail]
    if not before and not after:
        return []
    lines, fresh = before.split("\n"), after.split("\n")
    if len(lines) != len(fresh) or len(lines) < 3:
        return [(start, len(old) - tail, after)]
    found: list[Patch] = []
    at = start
    for line, other in zip(lines, fresh, strict=True):
        if line != other:
            found.append((at, at + len(line), other))
        at += len(line) + 1
    return found[::-1]


def common_prefix(a: str, b: str, most: int | None = None) -> int:
    """How many characters both begin with alike."""
    low, high = 0, min(len(a), len(b), len(a) if most is None else most)
    while low < high:
        middle = (low + high + 1) // 2
        if a[low:middle] == b[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def common_suffix(a: str, b: str, most: int) -> int:
    """How many characters both end with alike, ``most`` at the most."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if a[len(a) - middle : len(a) - low] == b[len(b) - middle : len(b) - low]:
            low = middle
        else:
            high = middle - 1
    return low


def joined(text: str, patches: Sequence[Patch]) -> Patch:
    """Several patches, the last one first, as one that spans them all."""
    parts: list[str] = []
    first, last = patches[-1][0], patches[0][1]
    at = first
    for start, end, part in reversed(patches):
        parts += [text[at:start], part]
        at = end
    return first, last, "".join(parts)
