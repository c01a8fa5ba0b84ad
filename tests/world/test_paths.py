"""Paths and timetables."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.world.paths import Array, minimum_jerk, rounded, timetable, waypoints

number = st.floats(-1.0, 1.0)
corners = st.lists(st.tuples(number, number, number).map(np.array), min_size=2, max_size=5)


@given(corners, st.floats(0.005, 0.2))
def test_points_are_close_and_end_where_the_corners_do(path: list[Array], gap: float) -> None:
    points, ways = waypoints(path, gap)
    assert np.allclose(points[0], path[0])
    assert np.allclose(points[-1], path[-1])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert steps.max() <= gap + 1e-9
    assert np.allclose(np.diff(ways), steps)


@given(corners, st.floats(0.0, 0.1))
def test_a_rounded_path_keeps_its_ends_and_stays_near(path: list[Array], radius: float) -> None:
    cut = rounded(path, radius)
    assert np.array_equal(cut[0], path[0])
    assert np.array_equal(cut[-1], path[-1])
    for corner in path[1:-1]:
        assert min(np.linalg.norm(point - corner) for point in cut) <= radius + 1e-9


@given(corners, st.floats(0.1, 1.0))
def test_the_timetable_never_exceeds_its_speed(path: list[Array], speed: float) -> None:
    _, ways = waypoints(path)
    tick = 1 / 240
    places = [
        ways[segment] + share * (ways[segment + 1] - ways[segment])
        for segment, share in timetable(ways, speed, tick)
    ]
    assert np.isclose(places[-1], ways[-1])
    steps = np.diff([0.0, *places])
    assert steps.min() >= -1e-9
    assert steps.max() <= speed * tick * 1.001 + 1e-9


def test_minimum_jerk_starts_and_ends_at_rest() -> None:
    assert [minimum_jerk(share) for share in (0.0, 0.5, 1.0)] == [0.0, 0.5, 1.0]
    assert minimum_jerk(0.01) < 1e-4
    assert minimum_jerk(0.99) > 1 - 1e-4
