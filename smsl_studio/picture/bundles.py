"""Bundles: operations between the same two states that are drawn as one line with a count."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

CHIP = 18.0
"""The height of the chip with the count, and the width of a chip with up to two digits (pixels of a
mark)."""
LANE_WIDTH = 5.0
"""The width of the lane back to the start (pixels of a mark)."""
DIGIT = 7.0
"""How much wider each further digit makes a chip (pixels of a mark)."""


@dataclass(frozen=True)
class Bundles:
    """The bundles of a picture: the numbers of their operations by the first of them.

    A bundle has two operations or more, in either direction, and lies where its first one would.
    """

    members: Mapping[int, tuple[int, ...]] = field(default_factory=lambda: MappingProxyType({}))
    back: tuple[int, ...] = ()
    """The operations that lead far back to the initial state. They share a lane, which is one of
    the bundles; those that are drawn alone follow it."""

    @cached_property
    def lane(self) -> int:
        """The first operation of the lane back to the start, -1 without a lane."""
        back = set(self.back)
        return next((first for first in self.members if first in back), -1)

    @cached_property
    def first(self) -> dict[int, int]:
        """The first operation of the bundle of each operation that is in one."""
        return {edge: first for first, own in self.members.items() for edge in own}

    @cached_property
    def hidden(self) -> frozenset[int]:
        """The operations without a line of their own."""
        return frozenset(self.first.keys() - self.members.keys())

    def width(self, edge: int) -> float:
        """Return the width of the line of an edge's bundle (pixels of a mark)."""
        first = self.first[edge]
        return LANE_WIDTH if first == self.lane else line_width(len(self.members[first]))

    def count(self, edge: int) -> int:
        """Return how many operations share the line of this one in a bundle; 0 for no bundle."""
        return len(self.members[self.first[edge]]) if edge in self.first else 0

    def without(self, edges: Collection[int]) -> Bundles:
        """Return the bundles when these operations are drawn by themselves."""
        touched = {self.first[edge] for edge in edges if edge in self.first}
        if not touched:
            return self
        found = {first: own for first, own in self.members.items() if first not in touched}
        for first in sorted(touched):
            rest = tuple(edge for edge in self.members[first] if edge not in edges)
            if len(rest) > 1:
                found[rest[0]] = rest
        return Bundles(found, self.back)


NO_BUNDLES = Bundles()


def bundles_of(source: NDArray[np.int32], target: NDArray[np.int32]) -> Bundles:
    """Return the bundles of operations between these states, by number. An operation that stays in
    its state, or whose target is missing, is in none.
    """
    low, high = np.minimum(source, target), np.maximum(source, target)
    edges = np.nonzero((low >= 0) & (low != high))[0]
    keys = low[edges].astype(np.int64) * (int(high.max(initial=0)) + 1) + high[edges]
    order = np.argsort(keys, kind="stable")
    starts = np.nonzero(np.diff(keys[order], prepend=-1))[0]
    groups: Iterable[NDArray[np.intp]] = np.split(edges[order], starts[1:]) if len(edges) else ()
    several = (tuple(group.tolist()) for group in groups if len(group) > 1)
    return Bundles({group[0]: group for group in sorted(several)})


def with_lane(bundles: Bundles, back: tuple[int, ...]) -> Bundles:
    """Return bundles in which some operations share a lane back to the start. They are in no other
    bundle then.
    """
    if not back:
        return bundles
    return Bundles({back[0]: back} | dict(bundles.without(back).members), back)


def chip_size(count: int) -> tuple[float, float]:
    """Return the width and height of the chip with a count (pixels of a mark)."""
    return CHIP + DIGIT * max(len(str(count)) - 2, 0), CHIP


def line_width(count: int) -> float:
    """Return the width of the line of so many operations (pixels of a mark)."""
    return 3.0 if count < 3 else 4.0
