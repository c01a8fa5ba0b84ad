"""Lines through bends: where they lead, how far they keep from nodes, and in which pictures."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.bends import GAP, RADIUS, bent, clear_of, rank_of
from smsl_studio.picture.curves import LineStyle, meets
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.labels import AsideRect
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, NodeBox
from smsl_studio.picture.svg import as_svg, draw_blueprint
from tests.picture.test_former import geometry_of
from tests.stories.at_canvas import sample

LEFT, RIGHT = NodeBox(0.0, 0.0, 54.0, 27.0), NodeBox(400.0, 0.0, 54.0, 27.0)
OP = Address("SB1", "State100", "Operation100A")


def line(*bends: tuple[float, float], others: Any = None) -> EdgeShape:
    found = bent(LEFT, RIGHT, bends, 1.0, others)
    assert found is not None
    return found


def test_a_line_leads_through_its_bends_in_their_order() -> None:
    shape = line((100.0, -100.0), (300.0, -100.0))
    assert shape.way == "bent"
    near = [shape.distance(100.0, -100.0), shape.distance(300.0, -100.0)]
    assert max(near) < RADIUS / 2
    assert shape.along(100.0, -100.0) < shape.along(300.0, -100.0)
    back = line((300.0, -100.0), (100.0, -100.0))
    assert back.along(300.0, -100.0) < back.along(100.0, -100.0)


def test_it_begins_and_ends_at_the_borders_and_straight_beside_the_middle() -> None:
    shape = line((10.0, -100.0), (390.0, -100.0))
    (x, y), (end_x, end_y) = shape.points[0].tolist(), shape.points[-1].tolist()
    assert (x, end_x) == (10.0, 390.0)
    assert y == pytest.approx(-28.0, abs=0.01)
    assert end_y == pytest.approx(-29.0, abs=0.01)
    assert shape.heading == pytest.approx((0.0, 1.0))


@pytest.mark.parametrize("at", [(0.0, 0.0), (54.0, 10.0), (380.0, 10.0)])
def test_a_bend_at_its_own_node_is_left_out(at: tuple[float, float]) -> None:
    assert bent(LEFT, RIGHT, [at], 1.0) is None
    if at[0] < 200.0:
        assert line(at, (200.0, 90.0)).is_like(line((200.0, 90.0)))
    else:
        assert line((200.0, 90.0), at).is_like(line((200.0, 90.0)))


def test_a_loop_with_one_bend_does_not_run_back_on_itself() -> None:
    loop = bent(LEFT, LEFT, [(0.0, -120.0)], 1.0)
    assert loop is not None
    assert abs(loop.points[0, 0] - loop.points[-1, 0]) > 10.0
    for box in (LEFT, NodeBox(0.0, 0.0, 23.0, 12.0, 6.0)):
        small = bent(box, box, [(90.0, 60.0), (90.0, 60.0)], 1.0)
        assert small is not None
        assert np.isfinite(small.points).all()


def test_a_piece_leads_around_a_node_if_it_can() -> None:
    other = np.array([[200.0, -100.0, 54.0, 27.0]])
    bends = (100.0, -104.0), (300.0, -104.0)
    assert meets(line(*bends).points, other, (), 0.0)
    around = line(*bends, others=other)
    assert not meets(around.points, other, (), GAP - 2.0)
    wall = np.array([[200.0, -100.0, 54.0, 900.0]])
    assert line(*bends, others=wall).is_like(line(*bends)), "there is no way around"


def test_a_point_is_led_out_of_a_node_by_the_nearest_side() -> None:
    boxes = np.array([[0.0, 0.0, 54.0, 27.0]])
    assert clear_of((10.0, 20.0), boxes, 8.0) == (10.0, 35.0)
    assert clear_of((-50.0, 3.0), boxes, 8.0) == (-62.0, 3.0)
    assert clear_of((0.0, -35.0), boxes, 8.0) == (0.0, -35.0)
    assert clear_of((5.0, 5.0), np.zeros((0, 4)), 8.0) == (5.0, 5.0)


def test_a_new_bend_gets_its_place_among_the_others() -> None:
    bends = [(100.0, -100.0), (300.0, -100.0)]
    shape = line(*bends)
    near = (70.0, -70.0), (200.0, -99.0), (370.0, -60.0)
    assert [rank_of(shape, bends, at) for at in near] == [0, 1, 2]


@pytest.mark.parametrize("seed", range(20))
def test_any_bends_give_a_line(seed: int) -> None:
    dice = random.Random(seed)
    for _ in range(30):
        count = dice.randrange(1, 8)
        pool = [0.0, 54.0, 200.0, 400.0, -1e6, 9.9e6]
        bends = [(dice.choice(pool), dice.choice(pool)) for _ in range(count)]
        target = dice.choice([LEFT, RIGHT])
        others = np.array([[200.0, 0.0, 54.0, 27.0], [54.0, 54.0, 23.0, 12.0]])
        shape = bent(LEFT, target, bends, dice.choice([1.0, 2.5]), dice.choice([None, others]))
        if shape is not None:
            assert np.isfinite(shape.points).all()
            assert shape.length > 0.0
            assert all(map(np.isfinite, (*shape.heading, *shape.at(shape.length / 2))))


def test_other_lines_between_the_states_stay_where_they_are() -> None:
    blueprint = sample("hanoi-corrected.json")
    name = next(iter(blueprint.branches))
    picture = Picture(blueprint, name)
    pair = next(e for e in range(len(picture.operations))
                if picture.between(int(picture.target[e]), int(picture.source[e]))[0])  # fmt: skip
    places = dict(place_states(blueprint[name]))
    before = geometry_of(blueprint, name, places, LineStyle(), None)
    after = editing.set_bends(blueprint, picture.address(pair), [(-500.0, -500.0)])
    now = geometry_of(after, name, places, LineStyle(), None)
    changed = [
        e for e in range(len(picture.operations)) if not now.shape(e).is_like(before.shape(e))
    ]
    assert changed == [pair]


def test_a_moved_label_stands_where_it_was_put_and_is_never_hidden() -> None:
    blueprint = editing.place_label(sample("hfsm.json"), OP, (0.5, 30.0, -40.0))
    places = dict(place_states(blueprint["SB1"]))
    geometry = geometry_of(blueprint, "SB1", places, LineStyle(), None)
    edge = geometry.picture.edge(OP)
    rect, shape = geometry.label(edge), geometry.shape(edge)
    assert rect is not None
    x, y = shape.at(shape.length / 2)
    assert ((rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2) == pytest.approx((x + 30.0, y - 40.0))


@pytest.mark.parametrize(("down", "led"), [(-60.0, True), (-14.0, False)])
def test_a_label_that_was_moved_away_from_its_line_has_a_leader(down: float, led: bool) -> None:
    blueprint = editing.place_label(sample("hfsm.json"), OP, (0.5, 0.0, down))
    places = dict(place_states(blueprint["SB1"]))
    geometry = geometry_of(blueprint, "SB1", places, LineStyle(), None)
    assert isinstance(geometry.label(geometry.picture.edge(OP)), AsideRect) is led


def test_a_rendered_picture_has_the_bends_as_large_as_it_is_drawn() -> None:
    blueprint = sample("hfsm.json")
    places = place_states(blueprint["SB1"])
    at = (places["State100"][0] + 40.0, places["State100"][1] - 300.0)
    after = editing.set_bends(blueprint, OP, [at])
    figure = Figure(Picture(after, "SB1"), places)
    edge, scale = figure.picture.edge(OP), figure.scale
    assert figure.geometry.shape(edge).distance(at[0] * scale, at[1] * scale) < RADIUS
    assert figure.bounds()[1] <= at[1] * scale + RADIUS
    svg = as_svg(draw_blueprint(after, ["SB1"])[0], "f")
    assert svg != as_svg(draw_blueprint(blueprint, ["SB1"])[0], "f")


def test_a_picture_of_dots_has_them_too() -> None:
    from smsl_studio.generate.rules import hanoi

    blueprint = hanoi(8)
    name = next(iter(blueprint.branches))
    edge = next(blueprint[name].edges())
    after = editing.set_bends(blueprint, Address(name, edge.source, edge.name), [(9.0, -99999.0)])
    figure = Figure(Picture(after, name), place_states(after[name]))
    assert not figure.shows_nodes
    top = -99999.0 * figure.scale
    assert figure.bounds()[1] <= top
    assert f"{top:.1f}".removesuffix(".0") in draw_blueprint(after, [name])[0].svg


def test_a_layout_is_told_from_none() -> None:
    assert not EdgeLayout()
    assert EdgeLayout(((1.0, 2.0),))
    assert EdgeLayout(label=(0.0, 0.0, 0.0))
    assert EdgeLayout(((1.0, 2.0),), (0.5, 3.0, 4.0)).scaled(2.0) == EdgeLayout(
        ((2.0, 4.0),), (0.5, 6.0, 8.0)
    )
