"""Which keys of a map live on, and where: what every form's splicing has in common.

A map in a text is a row of slots, one for each member. Keys that begin with ``_``, and the
``header`` key where a map has one, keep their slot; all others follow the order of the new values.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from smsl_studio.smsl.document.likeness import same

Json = Any


class Placed(NamedTuple):
    """A key in the new row: in an old slot, or (no slot) new, near an old one if there is any."""

    key: str
    slot: int | None
    near: int | None


def is_fixed(key: str, header: str = "") -> bool:
    """Whether a key keeps its slot whatever the order of the new values."""
    return key.startswith("_") or (key == header and key != "")


def survivors(old: Iterable[str], new: Mapping[str, Json], header: str = "") -> dict[str, str]:
    """Which old key lives on under which new key; removed ones are absent.

    A key that goes and one that comes behind the same anchor are a rename.
    """
    before = list(old)
    known = set(before)
    kept = {key: key for key in before if key in new}
    gone = _by_anchor(before, kept, header)
    come = _by_anchor(new, known, header)
    for anchor, removed in gone.items():
        kept.update(zip(removed, come.get(anchor, ()), strict=False))
    return kept


def _by_anchor(
    keys: Iterable[str], anchors: Iterable[str], header: str
) -> dict[tuple[str | None, bool], list[str]]:
    """The keys that are no anchors, by the anchor of their own kind before them."""
    found: dict[tuple[str | None, bool], list[str]] = {}
    latest: dict[bool, str | None] = {True: None, False: None}
    known = set(anchors)
    for key in keys:
        fixed = is_fixed(key, header)
        if key in known:
            latest[fixed] = key
        else:
            found.setdefault((latest[fixed], fixed), []).append(key)
    return found


def permuted(keys: Sequence[str], new: Mapping[str, Json], header: str = "") -> list[int]:
    """For each slot the slot whose content it takes, so that the order is that of the new values.

    ``keys`` are those of the slots, under their new names, doubles included.
    """
    places = [index for index, key in enumerate(keys) if not is_fixed(key, header)]
    result = list(range(len(keys)))
    present = dict.fromkeys(keys[index] for index in places)
    if all(a == b for a, b in zip(present, (k for k in new if k in present), strict=True)):
        return result
    order = {key: index for index, key in enumerate(new)}
    moved = sorted(places, key=lambda index: order[keys[index]])
    for place, content in zip(places, moved, strict=True):
        result[place] = content
    return result


def arranged(keys: Sequence[str], new: Mapping[str, Json], header: str = "") -> list[Placed]:
    """The slots with the new keys put in, each behind the key it follows in the new values."""
    present = set(keys)
    after: dict[str, list[str]] = {}
    first: list[str] = []
    first_movable: list[str] = []
    movable: str | None = None
    previous: str | None = None
    for key in new:
        fixed = is_fixed(key, header)
        if key not in present:
            if fixed and key == header:
                first_movable.insert(0, key)
            elif fixed:
                (first if previous is None else after.setdefault(previous, [])).append(key)
            else:
                (first_movable if movable is None else after.setdefault(movable, [])).append(key)
        previous = key
        movable = movable if fixed else key
    result: list[Placed] = []
    seen: set[str] = set()
    begin = _begin_of_movable(keys, header)
    _put(result, first, after, None)
    for index, key in enumerate(keys):
        if index == begin:
            _put(result, first_movable, after, index)
        result.append(Placed(key, index, index))
        if key not in seen:
            seen.add(key)
            _put(result, after.get(key, []), after, index)
    if begin == len(keys):
        _put(result, first_movable, after, None)
    return result


def _begin_of_movable(keys: Sequence[str], header: str) -> int:
    """The index of the first movable slot; behind the header or at the end where there is none."""
    for index, key in enumerate(keys):
        if not is_fixed(key, header):
            return index
    for index, key in enumerate(keys):
        if key == header:
            return index + 1
    return len(keys)


def _put(
    result: list[Placed], keys: list[str], after: Mapping[str, list[str]], near: int | None
) -> None:
    """Add new keys, and behind each those that follow it."""
    waiting = keys[::-1]
    while waiting:
        key = waiting.pop()
        result.append(Placed(key, None, near))
        waiting.extend(reversed(after.get(key, [])))


def aligned(old: Sequence[Json], new: Sequence[Json]) -> list[str]:
    """For each new element of a list the place of the old one it continues, or a key of its own."""
    shorter = min(len(old), len(new))
    head = 0
    while head < shorter and same(old[head], new[head]):
        head += 1
    tail = 0
    while tail < shorter - head and same(old[-1 - tail], new[-1 - tail]):
        tail += 1
    middle = range(head, len(new) - tail)
    return [
        *map(str, range(head)),
        *(str(index) if index < len(old) - tail else f"new {index}" for index in middle),
        *map(str, range(len(old) - tail, len(old))),
    ]
