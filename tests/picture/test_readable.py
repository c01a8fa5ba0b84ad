"""No name vanishes without a trace, and no label covers the words of a note or of a group."""

from __future__ import annotations

import random

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.picture.colours import LIGHT
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.hidden_names import hidden_names
from smsl_studio.picture.labels import FOOT, AsideRect, leader, meet
from smsl_studio.picture.lines import draw_labels
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.strokes import number
from tests.picture.test_former import Places, geometry_of
from tests.picture.test_untouched import STYLES, some_drawing

Rect = tuple[float, float, float, float]


def readable(geometry: Geometry) -> list[Rect]:
    assert geometry.routing is not None
    return geometry.routing.readable


def labels_of(geometry: Geometry) -> list[Rect]:
    found = map(geometry.label, range(len(geometry.picture.operations)))
    return [rect for rect in found if rect is not None]


def crowded(seed: int) -> tuple[Geometry, Places]:
    """Many operations with long names, in little room."""
    blueprint, places = some_drawing(random.Random(seed))
    for at, (state, name) in enumerate(
        [(state, name) for state, row in blueprint["SB"].table.items() for name in row]
    ):
        new = f"Op{at}_with_a_long_name"
        blueprint = editing.rename(blueprint, Address("SB", state, name), new)
    near = {name: (x * 0.45, y * 0.45) for name, (x, y) in places.items()}
    return geometry_of(blueprint, "SB", near, LineStyle(), None), near


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(6))
def test_no_label_covers_a_title_of_a_group_or_a_note(seed: int, style: LineStyle) -> None:
    dice = random.Random(seed)
    blueprint, places = some_drawing(dice)
    names = sorted(places, key=lambda name: places[name])
    plain = geometry_of(blueprint, "SB", places, style, None)
    groups = {"1": {"title": "One fact is missing", "states": names[:3]},
              "2": {"title": "The others", "states": names[-3:]}}  # fmt: skip
    blueprint = editing.put_groups(blueprint, "SB", groups)
    at = [[dice.uniform(0, 900), dice.uniform(0, 700)] for _ in range(3)]
    notes = {str(n): {"text": "Ask the clinic", "at": spot} for n, spot in enumerate(at)}
    blueprint = editing.put_notes(blueprint, "SB", notes)
    whole = geometry_of(blueprint, "SB", places, style, None)
    words = readable(whole)
    assert len(words) == 5
    assert not [one for one in words if any(meet(one, label) for label in labels_of(whole))]
    after = geometry_of(blueprint, "SB", places, style, plain.routing)
    edges = range(len(whole.picture.operations))
    assert [after.label(edge) for edge in edges] == [whole.label(edge) for edge in edges]


@pytest.mark.parametrize("seed", range(4))
def test_a_name_without_room_on_its_line_stands_beside_it_or_is_counted(seed: int) -> None:
    geometry, _ = crowded(seed)
    edges = range(len(geometry.picture.operations))
    aside = [edge for edge in edges if isinstance(geometry.label(edge), AsideRect)]
    hidden = {edge for edge in edges if geometry.label(edge) is None}
    assert aside or hidden, "some names have no room on their line"
    for edge in aside:
        rect = geometry.label(edge)
        assert rect is not None
        foot, end = leader(geometry.shape(edge), rect)
        assert geometry.shape(edge).distance(*foot) < 0.01
        assert rect[0] <= end[0] <= rect[2]
        assert rect[1] <= end[1] <= rect[3]
    counted = [edge for names in hidden_names(geometry, edges) for edge in names.edges]
    assert sorted(counted) == sorted(hidden), "each hidden name is counted once"
    for names in hidden_names(geometry, edges):
        assert names.words == f"+{len(names.edges)}"
        assert min(geometry.shape(edge).distance(*names.at) for edge in names.edges) < 0.01


def test_a_leader_begins_with_a_dot_on_its_line() -> None:
    geometry, places = crowded(1)
    figure = Figure(geometry.picture, places)
    # A figure gives crowded states more room; what is asked is how a crowd is drawn.
    figure.geometry = geometry
    edges = range(len(figure.picture.operations))
    aside = [edge for edge in edges if isinstance(figure.geometry.label(edge), AsideRect)]
    drawn = "".join(draw_labels(figure, edges, LIGHT))
    assert aside
    assert drawn.count(f'r="{number(FOOT)}"') == len(aside)


def test_a_file_counts_the_names_that_it_does_not_show() -> None:
    _, places = crowded(1)
    blueprint, _ = some_drawing(random.Random(1))
    figure = Figure(Picture(blueprint, "SB"), places)
    shown = sum(figure.geometry.label(e) is not None for e in range(len(figure.picture.operations)))
    marks = hidden_names(figure.geometry, range(len(figure.picture.operations)))
    assert shown + sum(len(names.edges) for names in marks) == len(figure.picture.operations)
