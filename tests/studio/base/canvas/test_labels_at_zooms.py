"""At every zoom a name stands at its own line, and lines keep their order.

Names keep their size on the screen while the drawing shrinks, so they have less and less room. A
word on another arrow tells the reverse of a procedure.
"""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from smsl_studio.graph.layout import place_states
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.levels import Level
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.canvas.sheet import Position, Sheet
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.theme import LIGHT
from tests.picture.astray import astray, orders
from tests.picture.test_untouched import some_drawing
from tests.stories.at_canvas import sample

ZOOMS = 1.5, 1.0, 0.8, 0.65, 0.5, 0.4, 0.3


def at_zooms(picture: Picture, places: dict[str, Position]) -> Iterator[Geometry]:
    """The different drawings of one SB at all zooms with names, the largest first."""
    sheet = Sheet(picture, places, Ink(LIGHT), Marks())
    seen: list[Geometry] = []
    for zoom in ZOOMS:
        sheet.set_zoom(zoom)
        if sheet.level >= Level.COMPACT and sheet.geometry not in seen:
            seen.append(sheet.geometry)
            yield sheet.geometry


def look(picture: Picture, places: dict[str, Position]) -> None:
    """Look at one SB at all zooms."""
    first = None
    for geometry in at_zooms(picture, places):
        found = astray(geometry)
        assert not found.lines, "a name is at another line"
        assert not found.labels, "a name covers a name"
        assert not found.leaders, "a leader leads astray"
        order = orders(geometry)
        first = order if first is None else first
        assert all(order[pair] == first[pair] for pair in first.keys() & order.keys())


@pytest.mark.parametrize(
    "name", ["registration-drilling.json", "registration.json", "hanoi.json", "hfsm.json"]
)
def test_the_names_of_a_sample_stand_at_their_lines(name: str, qapp: object) -> None:
    blueprint = sample(name)
    for branch in blueprint.branches:
        look(Picture(blueprint, branch), dict(place_states(blueprint[branch])))


@pytest.mark.parametrize("seed", range(5))
def test_the_names_of_states_anywhere_stand_at_their_lines(seed: int, qapp: object) -> None:
    blueprint, places = some_drawing(random.Random(seed))
    look(Picture(blueprint, "SB"), places)


def test_a_mark_in_place_of_names_covers_no_name(qapp: object) -> None:
    blueprint = sample("registration-drilling.json")
    picture = Picture(blueprint, "REGISTRATION")
    for geometry in at_zooms(picture, dict(place_states(blueprint["REGISTRATION"]))):
        assert not [words for words in astray(geometry).marks if " on the name " in words]
