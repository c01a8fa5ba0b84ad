"""States that want to lie in one crowd each find a cell."""

from __future__ import annotations

import numpy as np
import pytest

from smsl_studio.graph import spread

Cell = tuple[int, int]


def test_a_crowd_is_not_searched_again_for_each_that_joins_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    searched: list[int] = []
    free = spread._free

    def counted(wanted: Cell, ring: int, taken: set[Cell]) -> Cell | None:
        searched.append(ring)
        return free(wanted, ring, taken)

    monkeypatch.setattr(spread, "_free", counted)
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
        nearest = (spread._free(wanted, ring, taken) for ring in range(99))
        found = next(one for one in nearest if one is not None)
        assert cell == (found[0] * spread.CELL_X, found[1] * spread.CELL_Y)
        taken.add(found)
