"""The measures of a picture count what one sees in drawings small enough to count by hand."""

from __future__ import annotations

import numpy as np
import pytest

from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.picture import Picture
from tests.picture.measured import NO_LABEL, Array, Drawing, Measures, Rect, drawing_of, measure

FAR = (900.0, 900.0, 901.0, 901.0)


def drawn(
    *lines: list[tuple[float, float]],
    nodes: tuple[Rect, ...] = (FAR, FAR),
    labels: tuple[Rect | None, ...] = (),
    ends: tuple[tuple[int, int], ...] = (),
) -> Measures:
    shapes: list[Array] = [np.array(line) for line in lines]
    return measure(
        Drawing(
            nodes,
            ends or [(0, 1)] * len(lines),
            shapes,
            labels or [NO_LABEL] * len(lines),
        )
    )


def arc(count: int) -> list[tuple[float, float]]:
    turn = np.linspace(0.0, np.pi / 2, count)
    return [(100 * float(np.cos(t)), 100 * float(np.sin(t))) for t in turn]


def test_lines_cross_once_at_a_corner_and_not_where_they_only_share_a_part() -> None:
    assert drawn([(0, 0), (10, 10)], [(0, 10), (10, 0)]).crossings == 1
    assert drawn([(0, 0), (5, 5), (10, 0)], [(5, 0), (5, 9)]).crossings == 1
    assert drawn([(0, 0), (9, 0)], [(0, 5), (9, 5)]).crossings == 0
    assert drawn([(0, 0), (9, 0)], [(3, 0), (6, 0)]).crossings == 0
    assert drawn([(0, 0), (9, 0)], [(0, 1), (3, -1), (6, 1)]).crossings == 2
    assert drawn([(0, 0), (9, 9), (9, 0), (0, 9)]).crossings == 0, "a line does not cross itself"


def test_many_lines_are_all_compared() -> None:
    down = [[(float(x), -1.0), (float(x), 40.0)] for x in range(30)]
    across = [[(-1.0, y + 0.5), (40.0, y + 0.5)] for y in range(30)]
    assert drawn(*down, *across).crossings == 900


@pytest.mark.parametrize("count", [5, 50])
def test_bends_are_quarter_turns_however_finely_a_curve_is_written(count: int) -> None:
    assert drawn([(0, 0), (5, 0), (5, 5), (9, 5)]).bends == 2.0
    assert drawn([(0, 0), (5, 0), (9, 0)]).bends == 0.0
    assert drawn(arc(count)).bends == pytest.approx(1.0, abs=0.3)


def test_length_and_area_are_those_of_everything() -> None:
    found = drawn([(0, 0), (3, 4)], nodes=((0, 0, 5, 5), (10, 10, 20, 30)))
    assert found.length == 5.0
    assert found.area == 20.0 * 30.0


def test_labels_that_overlap_or_are_hidden_are_counted() -> None:
    line = [(500.0, 500.0), (600.0, 500.0)]
    nodes = ((0.0, 0.0, 10.0, 10.0), (100.0, 0.0, 110.0, 10.0))
    labels = (5.0, 5.0, 30.0, 20.0), (20.0, 10.0, 40.0, 30.0), (40.0, 10.0, 60.0, 30.0), None
    found = drawn(line, line, line, line, nodes=nodes, labels=labels)
    assert (found.label_on_node, found.label_on_label, found.hidden) == (1, 1, 1)
    assert found.overlaps == 3


def test_a_line_through_a_node_is_counted_once_and_its_own_ends_are_not() -> None:
    nodes = ((0.0, 0.0, 10.0, 10.0), (40.0, 0.0, 50.0, 10.0), (20.0, 0.0, 30.0, 10.0))
    assert drawn([(10, 5), (40, 5)], nodes=nodes).edge_through_node == 1
    assert drawn([(10, 5), (25, 6), (40, 5)], nodes=nodes).edge_through_node == 1
    assert drawn([(10, 5), (30, 5)], nodes=nodes, ends=((0, 2),)).edge_through_node == 0
    assert drawn([(10, 10), (40, 10)], nodes=nodes).edge_through_node == 0, "it only touches"


def test_what_a_file_shows_of_hanoi_is_measured() -> None:
    blueprint = hanoi(3)
    found = measure(drawing_of(Figure(Picture(blueprint, "SB1"), place_states(blueprint["SB1"]))))
    assert found.crossings == found.label_on_node == found.edge_through_node == 0
    assert found.length > 78 * 20
    assert "edge through node 0" in found.told()
