"""An edit leaves the lines and labels alone that it does not touch, with no memory of what was."""

from __future__ import annotations

import random
from itertools import pairwise

import numpy as np
import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.geometry import Geometry
from smsl_studio.smsl.json_form import parse_json, write_json
from tests.picture.astray import Array
from tests.picture.test_former import Places, geometry_of
from tests.stories.at_canvas import sample

Point = tuple[float, float]
STYLES = [LineStyle(), LineStyle(1.3, True)]
ASIDE = (150.0, 90.0)
"""Half a node, the gap of a line, and half the size of a label."""


def some_drawing(dice: random.Random) -> tuple[Blueprint, Places]:
    """A drawing of states anywhere, not in rows, with operations between any of them."""
    names = [f"State_{i}" for i in range(dice.randrange(8, 30))]
    table: dict[str, dict[str, str]] = {"HEADER": {}, **{name: {} for name in names}}
    for number in range(2 * len(names)):
        table[dice.choice(names)][f"Op{number}"] = dice.choice(names)
    wide, high = 260.0 * len(names) ** 0.5, 180.0 * len(names) ** 0.5
    places = {name: (dice.uniform(0, wide), dice.uniform(0, high)) for name in names}
    return read_blueprint(parse_json(write_json({"SB": table}), "some.json")), places


def whole(blueprint: Blueprint, branch: str, places: Places, style: LineStyle) -> Geometry:
    """The picture of a file that is opened now: nothing is taken over from a former one."""
    return geometry_of(blueprint, branch, places, style, None)


def changed(before: Geometry, after: Geometry, but: str = "") -> dict[int, tuple[bool, bool]]:
    """Whether the line and the label of each edge lie elsewhere, without the edges of one state.

    A loop evades the lines of its own state. It is left out if one of these lies elsewhere.
    """
    picture, found = before.picture, {}
    moved: set[int] = set()
    for edge, operation in enumerate(picture.operations):
        ends = int(picture.source[edge]), int(picture.target[edge])
        now = after.picture.numbered(picture.names[ends[0]], operation)
        line = not before.shape(edge).is_like(after.shape(now))
        if line and ends[0] != ends[1]:
            moved.update(ends)
        if but not in (picture.names[end] for end in ends):
            found[edge] = line, before.label(edge) != after.label(now)
    for edge in list(found):
        if picture.source[edge] == picture.target[edge] and int(picture.source[edge]) in moved:
            del found[edge]
    return found


def is_near(geometry: Geometry, edge: int, at: Point) -> bool:
    """Whether a node at a point could be in the way of a line, of a nearer way, or of its label."""
    picture, routing = geometry.picture, geometry.routing
    assert routing is not None
    ends = sorted((int(picture.source[edge]), int(picture.target[edge])))
    way = routing.bent.get((ends[0], ends[1]), geometry.shape(edge).bounds)
    left, top, right, bottom = way
    wide, high = (length * geometry.style.unit for length in ASIDE)
    return left - wide < at[0] < right + wide and top - high < at[1] < bottom + high


def assert_labels_stay(before: Geometry, after: Geometry, moved: list[int], far: list[int]) -> None:
    """Only a label goes elsewhere whose place a line took or left, and few that give way to it."""
    picture, edges = before.picture, range(len(before.picture.operations))
    lines: list[Array] = []
    for edge in edges:
        now = after.picture.numbered(picture.names[picture.source[edge]], picture.operations[edge])
        if not before.shape(edge).is_like(after.shape(now)):
            lines += [before.shape(edge).points, after.shape(now).points]
    rooms = []
    for edge in moved:
        left, top, right, bottom = before.shape(edge).bounds
        wide, high = (length * before.style.unit for length in ASIDE)
        rooms.append((left - wide, top - high, right + wide, bottom + high))
    alone = [room for room in rooms if not any(_passes(line, room) for line in lines)]
    assert len(alone) <= len(far) // 10
    assert 2 * len(moved) <= len(far), "most names far from an edit stay"


def _passes(line: Array, room: tuple[float, float, float, float]) -> bool:
    """Whether a line runs through a rectangle."""
    ends = pairwise(line)
    points = np.vstack([a + (b - a) * np.linspace(0.0, 1.0, 60)[:, None] for a, b in ends])
    return bool(((points >= room[:2]) & (points <= room[2:])).all(axis=1).any())


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(15))
def test_a_moved_state_changes_no_line_that_it_is_far_from(seed: int, style: LineStyle) -> None:
    dice = random.Random(seed)
    blueprint, places = some_drawing(dice)
    name = dice.choice(list(places))
    (x, y), before = places[name], whole(blueprint, "SB", places, style)
    places[name] = spot = x + dice.uniform(-300, 300), y + dice.uniform(-200, 200)
    found = changed(before, whole(blueprint, "SB", places, style), name)
    far = [e for e in found if not is_near(before, e, (x, y)) and not is_near(before, e, spot)]
    assert far
    assert [before.picture.operations[edge] for edge in far if found[edge][0]] == []
    after = whole(blueprint, "SB", places, style)
    assert_labels_stay(before, after, [edge for edge in far if found[edge][1]], far)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(15))
def test_a_new_state_changes_no_line_that_it_is_far_from(seed: int, style: LineStyle) -> None:
    dice = random.Random(100 + seed)
    blueprint, places = some_drawing(dice)
    before = whole(blueprint, "SB", places, style)
    edge_of_all = max(x for x, _ in places.values()), max(y for _, y in places.values())
    for spot in (
        (edge_of_all[0] * dice.random(), edge_of_all[1] * dice.random()),
        (edge_of_all[0] + 400.0, edge_of_all[1] + 300.0),
        (-500.0, -300.0),
    ):
        after = editing.add_state(blueprint, "SB", "State_new", spot)
        now = whole(after, "SB", {**places, "State_new": spot}, style)
        found = changed(before, now)
        far = [edge for edge in found if not is_near(before, edge, spot)]
        assert [before.picture.operations[edge] for edge in far if found[edge][0]] == []
        assert_labels_stay(before, now, [edge for edge in far if found[edge][1]], far)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("name", ["registration.json", "hfsm.json", "hanoi-corrected.json"])
@pytest.mark.parametrize("spot", [(5000.0, 3000.0), (-3000.0, 20.0), (40.0, -2500.0)])
def test_a_state_outside_the_drawing_changes_nothing_in_it(
    name: str, spot: Point, style: LineStyle
) -> None:
    blueprint = sample(name)
    for branch in blueprint.branches:
        places = dict(place_states(blueprint[branch]))
        before = whole(blueprint, branch, places, style)
        after = editing.add_state(blueprint, branch, "State_new", spot)
        now = whole(after, branch, {**places, "State_new": spot}, style)
        assert not any(map(any, changed(before, now).values()))
