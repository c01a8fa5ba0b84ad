"""Alignment: what each way to arrange boxes keeps, and what it makes equal."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.picture.alignment import (
    ACROSS,
    ARRANGEMENTS,
    DOWN,
    SIDES,
    Box,
    align,
    distribute,
    space,
)
from smsl_studio.picture.levels import ROOM
from smsl_studio.picture.shape import Point

length = st.integers(-40_000, 40_000).map(lambda value: value / 10)
size = st.integers(280, 3200).map(lambda value: value / 10)
boxes_of = st.dictionaries(st.text(min_size=1, max_size=4), st.tuples(length, length, size, size))
Boxes = dict[str, Box]


def moved(boxes: Boxes, places: Mapping[str, Point]) -> Boxes:
    return {name: (*places[name], *box[2:]) for name, box in boxes.items()}


def line_of(box: Box, side: str) -> float:
    axis, part = SIDES[side]
    return box[axis] + part * box[2 + axis] / 2


def gaps(boxes: Boxes, axis: int) -> list[float]:
    ends = sorted((b[axis] - b[2 + axis] / 2, b[axis] + b[2 + axis] / 2) for b in boxes.values())
    return [after[0] - before[1] for before, after in pairwise(ends)]


@given(boxes_of, st.sampled_from(list(ARRANGEMENTS)))
def test_every_box_keeps_its_name_and_once_more_changes_nothing(boxes: Boxes, name: str) -> None:
    places = ARRANGEMENTS[name](boxes)
    assert list(places) == list(boxes)
    again = ARRANGEMENTS[name](moved(boxes, places))
    for box, at in places.items():
        assert again[box] == pytest.approx(at, abs=1e-6)


@given(boxes_of, st.sampled_from(list(SIDES)))
def test_align_puts_one_side_on_one_line_and_moves_along_it_only_what_would_cover_another(
    boxes: Boxes, side: str
) -> None:
    axis = SIDES[side][0]
    placed = moved(boxes, align(boxes, side))
    lines = [line_of(box, side) for box in placed.values()]
    assert lines == pytest.approx(lines[:1] * len(lines), abs=1e-6)
    if all(gap >= 0 for gap in gaps(boxes, 1 - axis)):
        assert all(placed[name][1 - axis] == box[1 - axis] for name, box in boxes.items())
    else:
        assert all(gap > -1e-6 for gap in gaps(placed, 1 - axis)), "none covers another"
    reach = [line_of(box, name) for name in SIDES if SIDES[name][0] == axis
             for box in boxes.values()]  # fmt: skip
    assert all(min(reach) - 1e-6 <= line <= max(reach) + 1e-6 for line in lines)


@given(boxes_of, st.sampled_from((ACROSS, DOWN)))
def test_distribute_makes_equal_distances_between_the_outermost_centres(
    boxes: Boxes, axis: int
) -> None:
    before = sorted(box[axis] for box in boxes.values())
    after = sorted(place[axis] for place in distribute(boxes, axis).values())
    assert after[:1] + after[-1:] == pytest.approx(before[:1] + before[-1:])
    steps = [b - a for a, b in pairwise(after)]
    assert steps == pytest.approx(steps[:1] * len(steps), abs=1e-6)


@given(boxes_of, st.sampled_from((ACROSS, DOWN)))
def test_space_makes_equal_gaps_of_at_least_the_least_one(boxes: Boxes, axis: int) -> None:
    placed = moved(boxes, space(boxes, axis))
    found = gaps(placed, axis)
    assert found == pytest.approx(found[:1] * len(found), abs=1e-6)
    assert all(gap >= ROOM[axis] - 1e-6 for gap in found)
    assert all(placed[name][1 - axis] == box[1 - axis] for name, box in boxes.items())


def test_the_line_is_that_of_the_outermost_box() -> None:
    boxes = {"a": (0.0, 0.0, 100.0, 54.0), "b": (300.0, 90.0, 200.0, 54.0)}
    assert align(boxes, "left") == {"a": (0.0, 0.0), "b": (50.0, 90.0)}
    assert align(boxes, "right") == {"a": (350.0, 0.0), "b": (300.0, 90.0)}
    assert align(boxes, "centre") == {"a": (175.0, 0.0), "b": (175.0, 90.0)}
    assert align(boxes, "top") == {"a": (0.0, 0.0), "b": (300.0, 0.0)}


def test_a_row_on_one_vertical_line_becomes_a_column_in_its_order() -> None:
    row = {name: (100.0 * at, 0.0, 108.0, 54.0) for at, name in enumerate("abc")}
    assert align(row, "left") == {"a": (0.0, 0.0), "b": (0.0, 78.0), "c": (0.0, 156.0)}
