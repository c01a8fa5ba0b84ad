"""After an edit, only the touched lines are routed anew, with the same result as routing all."""

from __future__ import annotations

import random

import numpy as np
import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.detours import FEW, MOST_PASSED_OF_MANY
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.held_routes import Routing
from smsl_studio.picture.picture import Picture
from smsl_studio.smsl.json_form import parse_json, write_json
from tests.stories.at_canvas import sample

Places = dict[str, tuple[float, float]]


def geometry_of(
    blueprint: Blueprint,
    branch: str,
    places: Places,
    style: LineStyle,
    former: Routing | None,
    alone: set[int] | None = None,
) -> Geometry:
    """The geometry of an SB; its nodes are as wide as their names, its labels as well.

    With ``alone`` it is collapsed, except these operations.
    """
    picture = Picture(blueprint, branch)
    if alone is not None:
        collapsed = picture.collapse()
        picture = collapsed.bundled(collapsed.bundles.without(alone))
    at = np.array([places[name] for name in picture.names]).reshape(-1, 2)
    size = (46.0, 24.0) if style.compact else (108.0, 54.0)
    wide = [max(size[0], 7.0 * len(name)) for name in picture.names]
    half = np.column_stack([wide, np.full(len(wide), size[1])]) / 2 * style.unit

    def label_size(edge: int) -> tuple[float, float]:
        if picture.bundles.count(edge):
            wide, high = picture.chip_size(edge)
            return wide * style.unit, high * style.unit
        return (len(picture.label(edge)) * 6.0 + 8.0) * style.unit, 15.0 * style.unit

    boxes, drawn = np.hstack([at, half.reshape(-1, 2)]), picture.edge_layouts()
    return Geometry(picture, boxes, style, label_size, drawn, former)


def assert_alike(one: Geometry, whole: Geometry) -> None:
    for edge in range(len(whole.picture.operations)):
        mine, other = one.shape(edge), whole.shape(edge)
        name = whole.picture.operations[edge]
        assert mine.is_like(other), f"the line of {name} lies elsewhere"
        assert one.label(edge) == whole.label(edge), f"the label of {name} lies elsewhere"


def edited(blueprint: Blueprint, branch: str, dice: random.Random, places: Places) -> Blueprint:
    """The blueprint after one edit, chosen by dice; ``places`` follow it."""
    table = blueprint[branch].table
    state, other = dice.choice(list(table)), dice.choice(list(table))
    operation = dice.choice(list(table[state]) or [""])
    at = Address(branch, state, operation)
    what = dice.choice(
        [
            "name",
            "operation",
            "add",
            "connect",
            "loop",
            "lead",
            "cut",
            "gone",
            "move",
            "bend",
            "bend",
            "straight",
            "label",
        ]
    )
    spot = (dice.randrange(-9, 30) * 40.0, dice.randrange(-9, 20) * 30.0)
    if what == "name":
        new = state + "x" * dice.randrange(1, 14)
        places[new] = places[state]
        return editing.rename(blueprint, Address(branch, state), new)
    if what == "operation" and operation:
        return editing.rename(blueprint, at, operation + "y" * dice.randrange(1, 9))
    if what == "add":
        name = f"New{len(table)}{dice.randrange(1000)}"
        places[name] = spot
        return editing.add_state(blueprint, branch, name, spot)
    if what in ("connect", "loop"):
        goal = state if what == "loop" else other
        name = f"Op_{dice.randrange(10_000)}"
        return editing.add_operation(blueprint, branch, state, name, goal)
    if what == "lead" and operation:
        return editing.retarget(blueprint, at, other)
    if what == "cut" and operation:
        return editing.delete(blueprint, [at])
    if what == "gone" and len(table) > 2:
        return editing.delete(blueprint, [Address(branch, state)])
    if what == "bend" and operation:
        ways = ((spot[0] + 60.0 * at, spot[1] - 40.0 * at) for at in range(dice.randrange(1, 4)))
        return editing.set_bends(blueprint, at, [*ways])
    if what == "straight" and operation:
        return editing.set_bends(blueprint, at, ())
    if what == "label" and operation:
        aside = (dice.random(), dice.randrange(-60, 60), dice.randrange(-60, 60))
        return editing.place_label(blueprint, at, dice.choice([aside, aside, None]))
    places[state] = spot
    return editing.set_layout(blueprint, branch, {state: spot})


SAMPLES = [("hanoi-corrected.json", 8), ("hfsm.json", 8), ("registration.json", 8)]


@pytest.mark.parametrize(("name", "seeds"), SAMPLES)
@pytest.mark.parametrize("style", [LineStyle(), LineStyle(1.3, True)])
def test_a_picture_after_an_edit_is_the_one_that_is_routed_whole(
    name: str, seeds: int, style: LineStyle
) -> None:
    for seed in range(seeds):
        dice, blueprint = random.Random(seed), sample(name)
        branch = dice.choice(list(blueprint.branches))
        places = dict(place_states(blueprint[branch]))
        former = geometry_of(blueprint, branch, places, style, None).routing
        for _ in range(8):
            try:
                blueprint = edited(blueprint, branch, dice, places)
            except StudioError:
                continue
            after = geometry_of(blueprint, branch, places, style, former)
            assert_alike(after, geometry_of(blueprint, branch, places, style, None))
            former = after.routing


def test_an_edit_takes_over_the_lines_that_it_does_not_touch() -> None:
    blueprint = hanoi(4)
    places = dict(place_states(blueprint["SB1"]))
    before = geometry_of(blueprint, "SB1", places, LineStyle(), None)
    names = list(blueprint["SB1"].table)
    places["State_new"] = places[names[0]]
    after = editing.rename(blueprint, Address("SB1", names[0]), "State_new")
    now = geometry_of(after, "SB1", places, LineStyle(), before.routing)
    edges = range(len(now.picture.operations))
    anew = [edge for edge in edges if now.shape(edge) is not before.shape(edge)]
    assert 0 < len(anew) < 12, "only the lines at the renamed state are made"


@pytest.mark.parametrize("first", [FEW, FEW + 1])
def test_the_state_that_makes_a_picture_large_changes_its_long_detours(first: int) -> None:
    """A detour may pass fewer nodes in a large picture, wherever the new state stands."""
    names = [f"State_{at}" for at in range(FEW + 1)]
    places = {name: (-300.0 * (7 + at // 10), 200.0 * (at % 10)) for at, name in enumerate(names)}
    for at in range(MOST_PASSED_OF_MANY + 3):
        places[names[at]] = 200.0 + 200.0 * at, 100.0 + 100.0 * at
    ends = names[20], names[21]
    places |= {ends[0]: (0.0, 0.0), ends[1]: (400.0 + 200.0 * at, 200.0 + 100.0 * at)}
    table: dict[str, dict[str, str]] = {name: {} for name in names}
    table[ends[0]]["go"] = ends[1]
    of = {count: {name: table[name] for name in names[:count]} for count in (FEW, FEW + 1)}
    blueprints = {
        count: read_blueprint(parse_json(write_json({"SB": own}), "large.json"))
        for count, own in of.items()
    }
    second = 2 * FEW + 1 - first
    former = geometry_of(blueprints[first], "SB", places, LineStyle(), None)
    after = geometry_of(blueprints[second], "SB", places, LineStyle(), former.routing)
    whole = geometry_of(blueprints[second], "SB", places, LineStyle(), None)
    assert not whole.shape(0).is_like(former.shape(0)), "the limit matters to this line"
    assert_alike(after, whole)
