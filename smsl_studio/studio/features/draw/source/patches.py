"""The smallest replacements that turn one text into another."""

from __future__ import annotations

from collections.abc import Sequence

Patch = tuple[int, int, str]


def patches(old: str, new: str) -> list[Patch]:
    """The replacements that turn ``old`` into ``new``: start, end (offsets in ``old``) and the new
    part.

    The last one comes first, so that each can be made without moving the others. If only single
    lines differ (such as after renaming a state), only these are replaced.
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
    """The length of the common beginning of two texts."""
    low, high = 0, min(len(a), len(b), len(a) if most is None else most)
    while low < high:
        middle = (low + high + 1) // 2
        if a[low:middle] == b[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def common_suffix(a: str, b: str, most: int) -> int:
    """The length of the common end of two texts, at most ``most``."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if a[len(a) - middle : len(a) - low] == b[len(b) - middle : len(b) - low]:
            low = middle
        else:
            high = middle - 1
    return low


def joined(text: str, patches: Sequence[Patch]) -> Patch:
    """Several patches (the last one first) as one that spans them all."""
    parts: list[str] = []
    first, last = patches[-1][0], patches[0][1]
    at = first
    for start, end, part in reversed(patches):
        parts += [text[at:start], part]
        at = end
    return first, last, "".join(parts)
