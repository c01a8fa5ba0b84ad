"""Operations back to the start share one lane: which they are, and that it meets no state."""

from __future__ import annotations

import json
import random
from collections import deque

import numpy as np
import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.labels import meet
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.returns import AWAY, LEAST, stub_rect
from smsl_studio.picture.svg import draw_blueprint
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.picture.test_former import assert_alike, edited, geometry_of

Table = dict[str, dict[str, str]]


def table_of(dice: random.Random) -> Table:
    """A chain with some shortcuts, from most of whose states a reset leads back to the start."""
    names = [f"State_{at:02d}" for at in range(dice.randrange(4, 13))]
    table: Table = {name: {} for name in names}
    for at, name in enumerate(names[:-1]):
        table[name]["Op_Next"] = names[at + 1]
        if dice.random() < 0.4:
            table[name]["Op_Skip"] = dice.choice(names)
        if dice.random() < 0.4:
            table[names[at + 1]]["Op_Back"] = name
    for name in names[1:]:
        for reset in ("Op_Reset", "Op_Abort"):
            if dice.random() < 0.6:
                table[name][reset] = names[0]
    return table


def blueprint_of(table: Table) -> Blueprint:
    text = json.dumps({"SB": {"HEADER": {"INITIAL": next(iter(table))}, **table}})
    return read_blueprint(parse_json(text, "lane.json"))


def far_returns(table: Table) -> list[tuple[str, str]]:
    """The operations that lead to the first state from states that are far from it."""
    start = next(iter(table))
    away, queue = {start: 0}, deque([start])
    while queue:
        for other in table[(one := queue.popleft())].values():
            if other not in away:
                away[other] = away[one] + 1
                queue.append(other)
    return [
        (state, operation)
        for state, row in table.items()
        for operation, goal in row.items()
        if goal == start and away.get(state, AWAY) >= AWAY
    ]


def picture_of(table: Table) -> Picture:
    return Picture(blueprint_of(table), "SB").collapse()


@pytest.mark.parametrize("seed", range(share_of(30)))
def test_the_lane_has_every_return_from_far_away_and_no_other(seed: int) -> None:
    table = table_of(random.Random(seed))
    picture, wanted = picture_of(table), far_returns(table)
    bundles = picture.bundles
    found = [picture.address(edge) for edge in bundles.members.get(bundles.lane, ())]
    told = [(one.state, one.operation) for one in found]
    assert told == (wanted if len(wanted) >= LEAST else [])
    assert [picture.names[state] for state in picture.stubs] == list(
        dict.fromkeys(state for state, _ in told)
    )
    every = [edge for own in bundles.members.values() for edge in own]
    assert len(every) == len(set(every)), "no operation is in two bundles"
    # One that is drawn alone leaves the others in the lane.
    if told:
        alone = bundles.members[bundles.lane][0]
        rest = bundles.without([alone])
        assert len(rest.members.get(rest.lane, ())) in (len(told) - 1, 0)
        assert alone not in rest.first


def meets_a_node(figure: Figure, edge: int) -> bool:
    """Whether points of a line, two pixels apart, lie inside a node that is not its end."""
    shape, picture = figure.geometry.shape(edge), figure.picture
    points = np.array([shape.at(along) for along in np.arange(0.0, shape.length, 2.0)])
    ends = {int(picture.source[edge]), int(picture.target[edge])}
    if edge == picture.bundles.lane:
        ends |= set(picture.source[list(picture.bundles.back)].tolist())
    for state, (x, y, w, h) in enumerate(figure.boxes.tolist()):
        inside = (abs(points[:, 0] - x) < w - 1) & (abs(points[:, 1] - y) < h - 1)
        if state not in ends and inside.any():
            return True
    return False


@pytest.mark.parametrize("seed", range(12))
def test_the_lane_and_each_way_by_it_meet_no_state(seed: int) -> None:
    table = table_of(random.Random(seed))
    picture = picture_of(table)
    places = place_states(picture.branch)
    back = picture.bundles.members.get(picture.bundles.lane, ())
    for alone in ((), back[:1], back[1::2]):
        own = picture.bundled(picture.bundles.without(alone))
        figure = Figure(own, places)
        for edge in own.bundles.back:
            assert not meets_a_node(figure, edge)
        if back and own.bundles.lane >= 0:
            low, high = figure.boxes[:, 1] - figure.boxes[:, 3], figure.boxes[:, 1:4:2].sum(axis=1)
            _, top, _, bottom = figure.geometry.shape(own.bundles.lane).bounds
            assert bottom > high.max() or top < low.min(), "it lies outside all states"


@pytest.mark.parametrize("style", [LineStyle(), LineStyle(1.3, True)])
@pytest.mark.parametrize("seed", range(6))
def test_a_collapsed_picture_after_an_edit_is_the_one_that_is_routed_whole(
    seed: int, style: LineStyle
) -> None:
    dice = random.Random(seed)
    blueprint = blueprint_of(table_of(dice))
    places = dict(place_states(blueprint["SB"]))
    alone: set[int] = set()
    former = geometry_of(blueprint, "SB", places, style, None, alone).routing
    for _ in range(8):
        try:
            blueprint = edited(blueprint, "SB", dice, places)
        except StudioError:
            continue
        if dice.random() < 0.5:
            alone = {edge for edge in range(60) if dice.random() < 0.1}
        after = geometry_of(blueprint, "SB", places, style, former, alone)
        assert_alike(after, geometry_of(blueprint, "SB", places, style, None, alone))
        former = after.routing


def test_the_picture_names_the_lane_and_marks_where_it_begins() -> None:
    table = {f"State_{at}": {"Op_Next": f"State_{at + 1}"} for at in range(5)} | {"State_5": {}}
    for at in range(1, 6):
        table[f"State_{at}"]["Op_Reset"] = "State_0"
    (panel,) = draw_blueprint(blueprint_of(table), ["SB"], collapsed=True)
    assert "to start, 4" in panel.svg
    assert "State_5 -&gt; Op_Reset -&gt; State_0" in panel.svg
    number, lane = "A number on a line", "lead far back to the start"
    assert number in panel.svg
    assert lane in panel.svg
    (plain,) = draw_blueprint(blueprint_of(table), ["SB"])
    assert "to start" not in plain.svg
    assert lane not in plain.svg
    # The legend explains only what is drawn.
    del table["State_1"]["Op_Reset"]
    (panel,) = draw_blueprint(blueprint_of(table), ["SB"], collapsed=True)
    assert number not in panel.svg
    assert lane in panel.svg
    both = {"A": {"Op_Go": "B"}, "B": {"Op_Back": "A"}}
    (panel,) = draw_blueprint(blueprint_of(both), ["SB"], collapsed=True)
    assert number in panel.svg
    assert lane not in panel.svg


def test_a_line_drawn_by_hand_is_not_in_the_lane() -> None:
    table = {f"State_{at}": {"Op_Reset": "State_0"} for at in range(2, 7)}
    table = {"State_0": {"Op_Next": "State_1"}, "State_1": {"Op_Next": "State_2"}, **table}
    blueprint = blueprint_of(table)
    whole = Picture(blueprint, "SB").collapse()
    edge = whole.bundles.members[whole.bundles.lane][2]
    bent = editing.set_bends(blueprint, whole.address(edge), [(10.0, 200.0)])
    picture = Picture(bent, "SB").collapse()
    assert edge not in picture.bundles.first
    assert len(picture.bundles.members[picture.bundles.lane]) == 4


@pytest.mark.parametrize("seed", [5, 13])
def test_no_loop_lies_on_the_mark_of_a_way_back(seed: int) -> None:
    table = table_of(random.Random(seed))
    for state, row in table.items():
        row |= {"Op_Stay": state, "Op_Wait": state}
    picture = Picture(blueprint_of(table), "SB").collapse()
    figure = Figure(picture, place_states(picture.branch))
    assert picture.stubs
    for edge, (state, target) in enumerate(zip(picture.source, picture.target, strict=True)):
        if state == target and state in picture.stubs:
            mark = stub_rect(figure.geometry.box(int(state)), 1.0)
            assert not meet(figure.geometry.shape(edge).bounds, mark)
