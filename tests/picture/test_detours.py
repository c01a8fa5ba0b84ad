"""Lines of whole pictures: never through a node, and clear of it where there is a way."""

from __future__ import annotations

import random

import numpy as np
import pytest

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.curves import LineStyle, meets
from smsl_studio.picture.detours import GAP, MOST_PASSED, shortest_way
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats
from smsl_studio.smsl.json_form import parse_json, write_json


def picture_of(states: int, operations: int, dice: random.Random) -> Picture:
    """An SB with operations between states chosen by dice, some of them parallel or opposite."""
    names = [f"State_{number:03}" for number in range(states)]
    table: dict[str, dict[str, object]] = {"HEADER": {}, **{name: {} for name in names}}
    for number in range(operations):
        source, target = dice.sample(names, 2)
        table[source][f"Op_{number}"] = target
        if dice.random() < 0.3:
            table[target][f"Back_{number}"] = source
    values = {"SB1": table}
    return Picture(read_blueprint(parse_json(write_json(values), "dice.json")), "SB1")


def boxes_of(states: int, dice: random.Random, apart: float, room: float) -> Floats:
    """Nodes at places chosen by dice, ``apart`` or more from each other."""
    found: list[tuple[float, float, float, float]] = []
    while len(found) < states:
        x, y = dice.uniform(0.0, room * 1.6), dice.uniform(0.0, room)
        w, h = dice.choice([(54.0, 27.0), (30.0, 27.0), (70.0, 12.0)])
        if all(abs(x - a) > w + c + apart or abs(y - b) > h + d + apart for a, b, c, d in found):
            found.append((x, y, w, h))
    return np.array(found)


def nearest(shape: EdgeShape, boxes: Floats, ends: tuple[int, int]) -> float:
    """The least distance of a line from all nodes but its own."""
    along = np.arange(0.0, shape.length, 1.0)
    at = np.column_stack([np.interp(along, shape.lengths, shape.points[:, i]) for i in (0, 1)])
    others = np.delete(boxes, list(ends), axis=0)
    off = np.maximum(np.abs(at[:, None] - others[None, :, :2]) - others[None, :, 2:], 0.0)
    return float(np.hypot(off[:, :, 0], off[:, :, 1]).min())


def drawn(picture: Picture, boxes: Floats, style: LineStyle) -> Geometry:
    return Geometry(picture, boxes, style, lambda edge: (0.0, 0.0), {})


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("style", [LineStyle(), LineStyle(1.0, True)])
def test_no_line_runs_through_a_node_wherever_nodes_stand(seed: int, style: LineStyle) -> None:
    dice = random.Random(seed)
    count = dice.randrange(4, 26)
    picture = picture_of(count, count * 2, dice)
    boxes = boxes_of(count, dice, dice.choice([2.0, 20.0, 60.0]), 130.0 * count**0.5)
    geometry = drawn(picture, boxes, style)
    for edge in range(len(picture.operations)):
        ends = int(picture.source[edge]), int(picture.target[edge])
        assert nearest(geometry.shape(edge), boxes, ends) > 0.0, picture.operations[edge]


@pytest.mark.parametrize("seed", range(12))
def test_lines_keep_8_from_nodes_where_nodes_leave_room(seed: int) -> None:
    dice = random.Random(100 + seed)
    count = dice.randrange(4, 20)
    picture = picture_of(count, count * 2, dice)
    boxes = boxes_of(count, dice, 70.0, 190.0 * count**0.5)
    geometry = drawn(picture, boxes, LineStyle())
    for edge in range(len(picture.operations)):
        ends = int(picture.source[edge]), int(picture.target[edge])
        assert nearest(geometry.shape(edge), boxes, ends) > GAP - 0.1, picture.operations[edge]


def test_lines_of_a_large_picture_lead_around_nodes_too() -> None:
    dice = random.Random(7)
    picture = picture_of(90, 250, dice)
    assert not picture.small
    boxes = boxes_of(90, dice, 40.0, 1400.0)
    geometry = drawn(picture, boxes, LineStyle())
    for edge in range(len(picture.operations)):
        ends = int(picture.source[edge]), int(picture.target[edge])
        assert nearest(geometry.shape(edge), boxes, ends) > 0.0, picture.operations[edge]


@pytest.mark.parametrize("seed", range(6))
def test_a_moved_node_changes_only_the_lines_that_it_touches(seed: int) -> None:
    dice = random.Random(200 + seed)
    picture, boxes = picture_of(40, 60, dice), boxes_of(40, dice, 50.0, 1100.0)
    former = drawn(picture, boxes, LineStyle())
    after = boxes.copy()
    after[3, :2] += (dice.choice([-70.0, 40.0]), dice.choice([-60.0, 90.0]))
    now = Geometry(picture, after, LineStyle(), lambda edge: (0.0, 0.0), {}, former.routing)
    whole, edges = drawn(picture, after, LineStyle()), range(len(picture.operations))
    for edge in edges:
        assert now.shape(edge).is_like(whole.shape(edge)), picture.operations[edge]
    kept = sum(now.shape(edge) is former.shape(edge) for edge in edges)
    assert kept > len(edges) / 2


def test_parallel_lines_stay_apart_on_a_detour() -> None:
    values = {"SB1": {"HEADER": {}, "a": {"x": "c", "y": "c"}, "b": {}, "c": {"z": "a"}}}
    picture = Picture(read_blueprint(parse_json(write_json(values), "way.json")), "SB1")
    wall = (300.0, 20.0, 60.0, 400.0)
    geometry = drawn(picture, np.array([(0.0, 0, 54, 27), wall, (600, 40, 54, 27)]), LineStyle())
    shapes = [geometry.shape(edge) for edge in range(3)]
    assert {shape.way for shape in shapes} == {"detour"}
    middles = sorted(shape.at(shape.length / 2)[1] for shape in shapes)
    assert min(np.diff(middles)) > 9.0


def test_the_shortest_way_leads_past_the_nearer_corner() -> None:
    obstacles = Obstacles(np.array([(100.0, 10.0, 20.0, 50.0)]))
    way = shortest_way((0.0, 0.0), (200.0, 0.0), obstacles, 8.0)
    assert way == [(0.0, 0.0), (72.0, -48.0), (128.0, -48.0), (200.0, 0.0)]


def test_there_is_no_way_out_of_a_closed_place() -> None:
    walls = [(0.0, 60.0, 80.0, 20.0), (0.0, -60.0, 80.0, 20.0)]
    walls += [(60.0, 0.0, 20.0, 80.0), (-60.0, 0.0, 20.0, 80.0)]
    assert shortest_way((0.0, 0.0), (300.0, 0.0), Obstacles(np.array(walls)), 8.0) is None


def test_a_line_with_very_many_nodes_in_its_way_gets_no_detour() -> None:
    wall = np.array([(100.0 + 30.0 * x, 0.0, 10.0, 10.0 + x) for x in range(MOST_PASSED + 1)])
    assert shortest_way((0.0, 0.0), (9000.0, 0.0), Obstacles(wall), 8.0) == []


def test_lines_with_a_node_in_their_way_are_found_together_and_one_by_one() -> None:
    dice = random.Random(3)
    boxes = boxes_of(300, dice, 5.0, 4000.0)
    obstacles = Obstacles(boxes)
    ends = np.array([dice.sample(range(len(boxes)), 2) for _ in range(900)])
    gaps = np.array([dice.uniform(0.0, 60.0) for _ in ends])
    lines = [boxes[pair, :2] for pair in ends]
    each = [
        meets(line, boxes, pair, gap)
        for line, pair, gap in zip(lines, ends.tolist(), gaps.tolist(), strict=True)
    ]
    assert obstacles.stop_each(ends, gaps).tolist() == each
    assert any(each)
    assert not all(each)
