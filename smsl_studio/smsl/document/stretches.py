"""Finds where two rows of keys differ. Only these stretches must be arranged again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import compress, count
from operator import is_not, ne
from typing import Any, NamedTuple

from smsl_studio.smsl.document.arrangement import is_fixed

Json = Any


class Stretch(NamedTuple):
    """The keys from ``begin`` to ``end`` of the old row are replaced by those from ``first`` to
    ``last`` of the new row (ends are exclusive).
    """

    begin: int
    end: int
    first: int
    last: int


def whole(old: Sequence[str], new: Sequence[str]) -> Stretch:
    """Return the stretch with all of both rows."""
    return Stretch(0, len(old), 0, len(new))


def stretches(old: Sequence[str], new: Sequence[str], header: str = "") -> list[Stretch]:
    """Return where the keys of two rows differ. Each stretch includes the neighbours that decide
    where new keys go.

    Outside of the stretches both rows have the same keys in the same order. Arranging each stretch
    alone (see ``arrangement``) gives the same result as arranging the whole rows.
    """
    if old == new:
        return []
    found = differing_stretch(old, new)
    gone, come = old[found.begin : found.end], new[found.first : found.last]
    if header and (header in gone or header in come):
        return [whole(old, new)]
    merged: list[Stretch] = []
    for one in _parts(found, gone, come):
        begin, end = _neighbours(old, one.begin, one.end, header)
        wide = Stretch(begin, end, one.first - one.begin + begin, one.last - one.end + end)
        if merged and wide.begin < merged[-1].end:
            before = merged.pop()
            wide = Stretch(before.begin, max(end, before.end), before.first,
                           max(wide.last, before.last))  # fmt: skip
        merged.append(wide)
    return merged


def differing(old: Iterable[Json], new: Iterable[Json]) -> Iterator[int]:
    """Yield the indices at which two rows of values do not have the same object."""
    return compress(count(), map(is_not, old, new))


def differing_stretch(old: Sequence[str], new: Sequence[str]) -> Stretch:
    """Return the smallest stretch outside of which both rows have the same keys."""
    shorter = min(len(old), len(new))
    head = next(compress(count(), map(ne, old, new)), shorter)
    tail = next(compress(count(), map(ne, reversed(old), reversed(new))), shorter)
    tail = min(tail, shorter - head)
    return Stretch(head, len(old) - tail, head, len(new) - tail)


def _parts(found: Stretch, gone: Sequence[str], come: Sequence[str]) -> list[Stretch]:
    """Return a stretch in parts, if keys were replaced in their places and none has moved."""
    if len(gone) != len(come):
        return [found]
    runs: list[list[int]] = []
    for index in compress(count(), map(ne, gone, come)):
        if runs and runs[-1][-1] == index - 1:
            runs[-1].append(index)
        else:
            runs.append([index])
    if len(runs) > 1:
        places = [index for run in runs for index in run]
        if any(map(is_fixed, (row[index] for row in (gone, come) for index in places))):
            return [found]
        if not set(gone).isdisjoint(come[index] for index in places):
            return [found]
    begin = found.begin
    return [
        Stretch(begin + run[0], begin + run[-1] + 1, begin + run[0], begin + run[-1] + 1)
        for run in runs
    ]


def _neighbours(keys: Sequence[str], begin: int, end: int, header: str) -> tuple[int, int]:
    """Return a stretch with the nearest movable key before it, or else with the nearest one after
    it.
    """
    while begin:
        begin -= 1
        if not is_fixed(keys[begin], header):
            return begin, end
    while end < len(keys):
        end += 1
        if not is_fixed(keys[end - 1], header):
            break
    return begin, end
