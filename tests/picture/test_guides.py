"""Guides: to which lines a dragged state snaps, and what the guides say."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.picture.guides import SAME, snapped

GRID = 8.0
length = st.integers(-20_000, 20_000).map(lambda value: value / 10)
points = st.lists(st.tuples(length, length), max_size=12)


def places(centres: list[tuple[float, float]]) -> np.ndarray:
    return np.array(centres, dtype=np.float64).reshape(-1, 2)


@given(st.tuples(length, length), points, st.integers(0, 80).map(lambda value: value / 10))
def test_it_takes_the_nearest_centre_in_reach_and_else_the_grid(
    at: tuple[float, float], centres: list[tuple[float, float]], reach: float
) -> None:
    others = places(centres)
    place, guides = snapped(at, others, reach, GRID)
    for axis in (0, 1):
        away = np.abs(others[:, axis] - at[axis])
        if len(away) and away.min() <= reach:
            assert abs(place[axis] - at[axis]) == away.min()
            assert place[axis] in others[:, axis]
        else:
            assert place[axis] % GRID == 0
            assert abs(place[axis] - at[axis]) <= GRID / 2
    for x, y, x_end, y_end in guides:
        assert x <= x_end
        assert y <= y_end
        assert (x == x_end == place[0]) or (y == y_end == place[1])


def test_a_guide_reaches_from_the_first_to_the_last_state_on_its_line() -> None:
    others = places([(0.0, 0.0), (0.0, 100.0), (-SAME / 2, 300.0), (200.0, 40.0)])
    place, guides = snapped((3.0, 203.0), others, 5.0, GRID)
    assert place == (0.0, 200.0)
    assert guides == ((0.0, 0.0, 0.0, 300.0),)
    place, guides = snapped((3.0, 423.0), others, 5.0, GRID)
    assert guides == ((0.0, 0.0, 0.0, 424.0),)
    place, guides = snapped((198.0, 97.0), others, 5.0, GRID)
    assert place == (200.0, 100.0)
    assert guides == ((200.0, 40.0, 200.0, 100.0), (0.0, 100.0, 200.0, 100.0))


def test_without_others_there_is_only_the_grid() -> None:
    assert snapped((3.0, 13.0), places([]), 5.0, GRID) == ((0.0, 16.0), ())
