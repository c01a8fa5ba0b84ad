"""The order of keys in a map after an edit, for all forms.

The members of a map in a text are a row of slots. Keys that begin with ``_``, and the ``header``
key of a map that has one, keep their slots. All other keys follow the order of the new values.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from smsl_studio.smsl.document.likeness import same

Json = Any


class Placed(NamedTuple):
    """A key in the new row. It is in an old slot, or it is new (``slot`` None) and near an old
    slot.
    """

    key: str
    slot: int | None
    near: int | None


def is_fixed(key: str, header: str = "") -> bool:
    """Return whether a key keeps its slot whatever the order of the new values is."""
    return key.startswith("_") or (key == header and key != "")


def survivors(old: Iterable[str], new: Mapping[str, Json], header: str = "") -> dict[str, str]:
    """Return the new key of each old key that is kept. Removed keys are missing.

    A removed key and a new key after the same anchor are a renaming.
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
    """Return the keys that are no anchors, by the last anchor of their kind before them."""
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
    """Return for each slot the slot whose content it takes, so that the order is that of the new
    values.

    ``keys`` are the keys of the slots under their new names, with doubled keys.
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
    """Return the slots with the new keys inserted, each after the key that it follows in the new
    values.
    """
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
    """Return the index of the first movable slot. Without one it is after the header, or at the
    end.
    """
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
    """Add new keys, each with the keys that follow it."""
    waiting = keys[::-1]
    while waiting:
        key = waiting.pop()
        result.append(Placed(key, None, near))
        waiting.extend(reversed(after.get(key, [])))


def aligned(old: Sequence[Json], new: Sequence[Json]) -> list[str]:
    """Return for each new element of a list the index of the old element that it continues, or a
    new key.
    """
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
