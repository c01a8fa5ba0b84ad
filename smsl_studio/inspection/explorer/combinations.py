"""Combinations of configurations of independent parts, the nearest first."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from heapq import heappop, heappush

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.explorer.part import Path, SpacePart
from smsl_studio.stop import heed

Choice = tuple[int, ...]
"""A configuration of each part, by its number there."""


def nearest(parts: Sequence[SpacePart], lists: Sequence[Sequence[int]]) -> Iterator[Choice]:
    """Yield all combinations that take one configuration of each list, the nearest first.

    Each list has configurations of the part at the same place, the nearest first. What was yielded
    is not kept, so the first few of very many cost little.
    """
    if not all(lists):
        return
    start = (0,) * len(parts)
    waiting = [(_steps(parts, lists, start), start)]
    known = {start}
    while waiting:
        heed()
        _, at = heappop(waiting)
        yield tuple(found[index] for found, index in zip(lists, at, strict=True))
        for place, found in enumerate(lists):
            after = (*at[:place], at[place] + 1, *at[place + 1 :])
            if after[place] < len(found) and after not in known:
                known.add(after)
                heappush(waiting, (_steps(parts, lists, after), after))


def joined(paths: Sequence[Path]) -> Path:
    """Return the ways of independent parts as one way: of all orders the one with the least
    addresses, compared step by step."""
    waiting = [(str(path[0]), at, 0) for at, path in enumerate(paths) if path]
    waiting.sort()
    found: list[Address] = []
    while waiting:
        _, at, step = heappop(waiting)
        found.append(paths[at][step])
        if step + 1 < len(paths[at]):
            heappush(waiting, (str(paths[at][step + 1]), at, step + 1))
    return tuple(found)


def _steps(parts: Sequence[SpacePart], lists: Sequence[Sequence[int]], at: Choice) -> int:
    places = zip(parts, lists, at, strict=True)
    return sum(part.depths[found[index]] for part, found, index in places)
