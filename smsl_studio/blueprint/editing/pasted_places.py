"""The places of pasted states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import ceil, sqrt
from typing import Any

from smsl_studio.blueprint.edge_layout import point_of
from smsl_studio.blueprint.editing.positions import point

Json = Any
Point = tuple[float, float]

STEP = (160.0, 96.0)
"""The distances (pixels at 100 %) between states without places of their own."""

ASIDE = (32.0, 32.0)
"""How far aside (pixels at 100 %) a state moves if it would cover another one."""


@dataclass(frozen=True)
class PastedPlaces:
    """The places of pasted states: moved by an offset, or with their middle at a point. Otherwise
    they keep their places, or go a little aside.
    """

    offset: Point | None = None
    at: Point | None = None

    def of(
        self, states: list[str], layout: Mapping[str, Json], taken: Iterable[Point]
    ) -> Iterator[tuple[str, list[float]]]:
        """Yield the states that get a place, and the place."""
        points = {state: place for state in states if (place := point_of(layout.get(state)))}
        if not points and self.at is not None:
            points = _rows(states)
        if points:
            dx, dy = self._shift(list(points.values()), set(taken))
            for state, (x, y) in points.items():
                yield state, point((x + dx, y + dy))

    def _shift(self, points: list[Point], taken: set[Point]) -> Point:
        if self.offset is not None:
            return self.offset
        if self.at is not None:
            x, y = ((min(axis) + max(axis)) / 2 for axis in zip(*points, strict=True))
            return self.at[0] - x, self.at[1] - y
        dx = dy = 0.0
        while any((x + dx, y + dy) in taken for x, y in points):
            dx, dy = dx + ASIDE[0], dy + ASIDE[1]
        return dx, dy


def _rows(states: list[str]) -> dict[str, Point]:
    """Return places in rows, about as many rows as columns."""
    wide = ceil(sqrt(len(states)))
    return {
        state: (index % wide * STEP[0], index // wide * STEP[1])
        for index, state in enumerate(states)
    }
