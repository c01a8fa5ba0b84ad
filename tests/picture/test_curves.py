"""Lines between states: their ends, their distances, and what they go around."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from smsl_studio.picture.curves import (
    TIP_GAP,
    Between,
    LineStyle,
    around_each,
    meets,
    shapes_of,
    strands_of,
)
from smsl_studio.picture.lanes import FIRST, STEP, Passing, in_lanes
from smsl_studio.picture.loops import CORNERS, arc, corner_of, label_boxes
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.shape import EdgeShape, NodeBox, rounded

FULL = LineStyle()
COMPACT = LineStyle(compact=True)


def box(x: float, y: float) -> NodeBox:
    return NodeBox(x, y, 54.0, 27.0)


def lines(
    pair: Between, source: NodeBox, target: NodeBox, style: LineStyle, only: int | None = None
) -> dict[int, EdgeShape]:
    """The lines between two states without another node in their way."""
    return shapes_of(strands_of(pair, source, target, style, True, only), style)


def rows(*boxes: NodeBox) -> np.ndarray:
    return np.array([[b.x, b.y, b.w, b.h] for b in boxes])


def test_one_edge_in_a_row_runs_straight_from_border_to_border() -> None:
    shapes = lines(Between(0, 1, (0,), ()), box(0, 0), box(218, 0), FULL)
    points = shapes[0].points
    assert points[0] == pytest.approx([55.0, 0.0], abs=0.2)
    assert points[-1] == pytest.approx([218.0 - 54.0 - TIP_GAP, 0.0], abs=0.2)
    assert shapes[0].heading == pytest.approx((1.0, 0.0))


def test_an_opposite_pair_is_16_apart_and_forward_is_on_top() -> None:
    shapes = lines(Between(0, 1, (0,), (1,)), box(0, 0), box(218, 0), FULL)
    assert shapes[0].points[:, 1] == pytest.approx([-8.0, -8.0])
    assert shapes[1].points[:, 1] == pytest.approx([8.0, 8.0])
    assert shapes[1].heading == pytest.approx((-1.0, 0.0))


def test_parallels_have_a_line_each_18_apart() -> None:
    shapes = lines(Between(0, 1, (0, 1), (2,)), box(0, 0), box(218, 0), FULL)
    assert [shapes[e].points[0, 1] for e in range(3)] == pytest.approx([-18.0, 0.0, 18.0])


def test_many_parallels_stay_within_the_side_of_the_node() -> None:
    shapes = lines(Between(0, 1, tuple(range(7)), ()), box(0, 0), box(218, 0), FULL)
    heights = sorted(shape.points[0, 1] for shape in shapes.values())
    assert heights[-1] <= 24.0
    assert min(np.diff(heights)) >= 6.9


@pytest.mark.parametrize("style", [FULL, COMPACT])
def test_the_way_there_is_above_the_way_back_at_every_zoom(style: LineStyle) -> None:
    shapes = lines(Between(0, 1, (0,), (1,)), box(0, 0), box(218, 0), style)
    middle = {e: shape.at(shape.length / 2)[1] for e, shape in shapes.items()}
    assert middle[0] == pytest.approx(-8.0, abs=0.5)
    assert middle[1] == pytest.approx(8.0, abs=0.5)


@example(160.0, 2.0, 3, 3, False)
@given(
    st.floats(-400, 400), st.floats(-400, 400), st.integers(1, 3), st.integers(0, 3), st.booleans()
)
def test_lines_start_and_end_at_the_borders(
    x: float, y: float, there: int, back: int, compact: bool
) -> None:
    if math.hypot(x, y) < 160.0:
        return
    a, b = box(0, 0), box(x, y)
    pair = Between(0, 1, tuple(range(there)), tuple(range(there, there + back)))
    shapes = lines(pair, a, b, COMPACT if compact else FULL)
    assert len(shapes) == there + back
    for edge, shape in shapes.items():
        source, target = (a, b) if edge < there else (b, a)
        assert source.depth(shape.points[:1])[0] == pytest.approx(1.0, abs=1.0)
        assert target.depth(shape.points[-1:])[0] == pytest.approx(TIP_GAP, abs=1.0)
        inside = np.minimum(a.depth(shape.points), b.depth(shape.points))
        assert inside.min() > -0.5, "a line never runs through its own nodes"
    ends = {tuple(np.round(shape.points[-1], 3)) for shape in shapes.values()}
    assert len(ends) == len(shapes), "no two lines end in one point"


def test_a_way_around_a_node_meets_none() -> None:
    a, b, between = box(0, 0), box(400, 200), box(200, 100)
    boxes = rows(a, b, between)
    assert meets(np.array([[0.0, 0.0], [400.0, 200.0]]), boxes, (0, 1), 6.0)
    (found,) = around_each([Between(0, 1, (0,), (1,))], [(a, b)], FULL, Obstacles(boxes))
    for shape in found.shapes.values():
        assert not meets(shape.points, boxes, (0, 1), 0.0)


def test_lanes_nest_outside_their_row() -> None:
    boxes = [box(x, 0) for x in (0, 218, 436, 654)] + [box(0, 172)]
    passing = [Passing(0, 3, 0), Passing(1, 0, 3), Passing(2, 2, 0), Passing(3, 1, 3)]
    shapes = in_lanes(passing, boxes, 1.0, Obstacles(rows(*boxes)))
    tops = {e: float(shape.points[:, 1].min()) for e, shape in shapes.items()}
    assert tops[3] == pytest.approx(-27.0 - FIRST)
    assert sorted(tops.values()) == pytest.approx([-27 - FIRST - STEP * i for i in (3, 2, 1, 0)])
    for edge, shape in shapes.items():
        start, tip = shape.points[0], shape.points[-1]
        assert start[1] == pytest.approx(-28.0), edge
        assert tip[1] == pytest.approx(-27.0 - TIP_GAP)
        assert not meets(shape.points, rows(*boxes), (), 0.5), "a lane crosses no node"
    starts = [tuple(s.points[0]) for s in shapes.values()]
    tips = [tuple(s.points[-1]) for s in shapes.values()]
    assert len({round(x) for x, _ in starts + tips}) == 8, "every end has a place of its own"


def test_lanes_of_the_lower_row_pass_below() -> None:
    boxes = [box(x, 172) for x in (0, 218, 436)] + [box(0, 0)]
    shapes = in_lanes([Passing(0, 0, 2)], boxes, 1.0, Obstacles(rows(*boxes)))
    assert shapes[0].points[:, 1].max() == pytest.approx(172 + 27 + FIRST)


def test_lanes_of_a_column_pass_beside_it() -> None:
    boxes = [box(0, y) for y in (0, 172, 344)] + [box(400, 0)]
    shapes = in_lanes([Passing(0, 0, 2)], boxes, 1.0, Obstacles(rows(*boxes)))
    assert shapes[0].points[:, 0].min() == pytest.approx(-54 - FIRST)


@pytest.mark.parametrize("name", CORNERS)
@pytest.mark.parametrize("count", [1, 2, 4])
def test_self_loops_are_concentric_and_end_at_the_border(name: str, count: int) -> None:
    node = box(0, 0)
    corner = corner_of(name, node, count, 1.0)
    shapes = [arc(corner, node, rank, 1.0) for rank in range(count)]
    for shape in shapes:
        assert abs(node.depth(shape.points[:1])[0]) < 4.0
        assert 0.0 <= node.depth(shape.points[-1:])[0] + 0.5 < 6.0
        assert node.depth(shape.points[5:-5]).min() > -0.5
    spans = [float(np.hypot(*(s.points - (corner.x, corner.y)).T).max()) for s in shapes]
    assert np.diff(spans) == pytest.approx(5.0)
    boxes = label_boxes(corner, [(80.0, 15.0)] * count, 1.0)
    for (_, top, _, bottom), (_, other_top, _, other_bottom) in pairwise(boxes):
        assert bottom <= other_top or other_bottom <= top


def test_rounded_corners_stay_on_the_way() -> None:
    points = rounded([(0, 0), (0, -50), (100, -50), (100, 0)], 8.0)
    assert points[0] == pytest.approx([0, 0])
    assert points[-1] == pytest.approx([100, 0])
    assert points[:, 1].min() == pytest.approx(-50.0)


@given(st.lists(st.tuples(st.floats(-99, 99), st.floats(-99, 99)), min_size=2, max_size=8))
def test_a_cut_is_as_long_as_it_says(points: list[tuple[float, float]]) -> None:
    shape = EdgeShape(np.array(points))
    part = EdgeShape(shape.cut(shape.length * 0.25, shape.length * 0.75))
    assert part.length == pytest.approx(shape.length / 2, abs=1e-6)
    assert shape.at(0.0) == pytest.approx(points[0])
    assert shape.at(shape.length) == pytest.approx(points[-1])
    assert shape.distance(*shape.at(shape.length * 0.4)) == pytest.approx(0.0, abs=1e-6)


def test_a_row_without_room_before_the_next_one_has_no_lanes() -> None:
    boxes = [box(0, 100), box(200, 100), box(400, 100), box(200, 44), box(200, 156)]
    assert in_lanes([Passing(0, 0, 2)], boxes, 1.0, Obstacles(rows(*boxes))) == {}
    boxes[3] = box(200, -200)
    above = in_lanes([Passing(0, 0, 2)], boxes, 1.0, Obstacles(rows(*boxes)))
    assert above[0].points[:, 1].min() < 73.0, "there is room above"
    boxes[3:] = [box(200, 44), box(200, 400)]
    below = in_lanes([Passing(0, 0, 2)], boxes, 1.0, Obstacles(rows(*boxes)))
    assert below[0].points[:, 1].max() > 127.0, "there is room below"


def test_of_very_many_lines_between_two_states_none_is_sought_among_the_others() -> None:
    class Edges(tuple[int, ...]):
        def __contains__(self, edge: object) -> bool:
            raise AssertionError("looks through all edges for one")

    pair = Between(0, 1, Edges(range(30)), Edges(range(30, 40)))
    shapes = lines(pair, box(0, 0), box(218, 0), FULL)
    assert list(shapes) == list(range(40))
    assert all((shapes[e].points[-1][0] > shapes[e].points[0][0]) == (e < 30) for e in shapes)


@pytest.mark.parametrize("style", [FULL, COMPACT])
@pytest.mark.parametrize("other", [(218, 0), (0, 300), (-218, 0), (150, -160)])
def test_one_of_many_lines_is_the_same_as_among_all_of_them(
    style: LineStyle, other: tuple[float, float]
) -> None:
    pair = Between(0, 1, (2, 5, 7), (1, 6))
    ends = box(0, 0), box(*other)
    together = lines(pair, *ends, style)
    assert sorted(together) == [1, 2, 5, 6, 7]
    for edge, shape in together.items():
        alone = lines(pair, *ends, style, only=edge)
        assert list(alone) == [edge]
        assert alone[edge].points.tolist() == shape.points.tolist()
    assert lines(pair, *ends, style, only=3) == {}
