"""States with nearly equal positions each get a grid cell of their own."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from smsl_studio.graph import spread

Cell = tuple[int, int]


def test_a_crowd_is_not_searched_again_for_each_that_joins_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    searched: list[int] = []
    free = spread._Full.free

    def counted(full: spread._Full, wanted: Cell, ring: int, taken: set[Cell]) -> Cell | None:
        searched.append(ring)
        return free(full, wanted, ring, taken)

    monkeypatch.setattr(spread._Full, "free", counted)
    crowd = np.random.default_rng(1).normal(0.0, 2000.0, (6000, 2))
    cells = spread._own_cells(crowd)
    assert len(set(cells)) == len(crowd)
    assert len(searched) < 2 * len(crowd)


def test_everybody_has_the_nearest_free_cell() -> None:
    """What is known to be full never hides a cell that is free."""
    crowd = np.random.default_rng(2).normal(0.0, 600.0, (500, 2))
    taken: set[Cell] = set()
    for (x, y), cell in zip(crowd.tolist(), spread._own_cells(crowd), strict=True):
        wanted = (round(x / spread.CELL_X), round(y / spread.CELL_Y))
        nearest = (cell for ring in range(99) for cell in spread._ring(wanted, ring))
        found = next(one for one in nearest if one not in taken)
        assert cell == (found[0] * spread.CELL_X, found[1] * spread.CELL_Y)
        taken.add(found)


def test_states_that_all_want_one_place_walk_each_ring_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walked: list[int] = []
    ring = spread._ring

    def counted(wanted: Cell, radius: int) -> Iterator[Cell]:
        for cell in ring(wanted, radius):
            walked.append(radius)
            yield cell

    monkeypatch.setattr(spread, "_ring", counted)
    cells = spread._own_cells(np.zeros((3000, 2)))
    assert len(set(cells)) == 3000
    assert len(walked) == 3000
