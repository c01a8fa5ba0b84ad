"""A sheet keeps the lines of the last zooms, and forgets them when a state moves."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import rename
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.levels import Level, readable_zoom
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.canvas.frames import bounds_of, frame_of
from smsl_studio.studio.base.canvas.sheet import KEPT_UNITS, Sheet
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.theme import LIGHT
from tests.stories.at_canvas import sample

ZOOMS = [0.5 * 1.1**step for step in range(KEPT_UNITS)]


def sheet() -> Sheet:
    blueprint = sample("hanoi.json")
    picture = Picture(blueprint, "SB1")
    return Sheet(picture, place_states(picture.branch), Ink(LIGHT), Marks())


def test_a_zoom_to_and_fro_finds_the_same_lines(qapp: QApplication) -> None:
    shown = sheet()
    found = []
    for zoom in (*ZOOMS, *ZOOMS):
        shown.set_zoom(zoom)
        assert shown.compact
        found.append(shown.geometry)
    assert len({id(one) for one in found}) == KEPT_UNITS
    assert found[:KEPT_UNITS] == found[KEPT_UNITS:]


def test_a_state_that_moves_leaves_no_old_lines_at_another_zoom(qapp: QApplication) -> None:
    shown = sheet()
    for zoom in ZOOMS:
        shown.set_zoom(zoom)
        before = shown.geometry.shape(0).bounds
    shown.set_zoom(ZOOMS[0])
    first = shown.geometry
    shown.set_zoom(ZOOMS[-1])
    source = int(shown.picture.source[0])
    shown.move({source: (900.0, 900.0)})
    assert shown.geometry.shape(0).bounds != before
    shown.set_zoom(ZOOMS[0])
    assert shown.geometry is not first
    assert tuple(shown.geometry.boxes[source, :2]) == (900.0, 900.0)


@pytest.mark.parametrize("zoom", [0.05, 0.2, 0.5, 1.0, 2.0])
def test_the_size_of_one_node_is_that_among_all(qapp: QApplication, zoom: float) -> None:
    shown = sheet()
    shown.set_zoom(zoom)
    every = shown.halves()
    assert every.shape == (27, 2)
    for state in range(27):
        assert shown.halves(state).tolist() == every[state].tolist()


@pytest.mark.parametrize("zoom", [0.05, 0.1, 0.2, 0.23, 0.3])
def test_lines_of_a_far_picture_are_straight_also_if_they_are_lit(
    qapp: QApplication, zoom: float
) -> None:
    """They led around compact nodes, which are not painted there, far below the drawing."""
    shown = sheet()
    shown.set_zoom(zoom)
    for edge in range(len(shown.picture.operations)):
        ends = shown.at[[shown.picture.source[edge], shown.picture.target[edge]]]
        low, high = ends.min(axis=0) - 30 * shown.unit, ends.max(axis=0) + 30 * shown.unit
        points = shown.geometry.shape(edge).points
        assert (points >= low).all()
        assert (points <= high).all()


def test_near_and_far_pictures_of_about_one_zoom_have_lines_of_their_own(
    qapp: QApplication,
) -> None:
    shown = sheet()
    near = readable_zoom(shown.spacing)
    shown.set_zoom(near * 0.999)
    far = shown.geometry
    shown.set_zoom(near * 1.001)
    assert shown.geometry is not far
    assert far.style.far
    assert not shown.geometry.style.far


@pytest.mark.parametrize("room", [(342.0, 182.0), (540.0, 300.0), (964.0, 193.0), (964.0, 400.0)])
@pytest.mark.parametrize("name", ["hanoi.json", "registration-drilling.json"])
def test_a_far_picture_fills_its_frame(
    qapp: QApplication, name: str, room: tuple[float, float]
) -> None:
    """Labels that a far picture does not show left most of the frame empty."""
    blueprint = sample(name)
    picture = Picture(blueprint, next(iter(blueprint.branches)))
    shown = Sheet(picture, place_states(picture.branch), Ink(LIGHT), Marks())
    middle, zoom = frame_of(shown, room)
    shown.set_zoom(zoom)
    if shown.level >= Level.COMPACT:
        return
    whole = bounds_of(shown)
    shares = whole.width() * zoom / room[0], whole.height() * zoom / room[1]
    assert max(shares) <= 1.0
    assert max(shares) > 0.6 or zoom > 0.3
    assert whole.contains(middle)


@pytest.mark.parametrize("changed", ["nothing", "a name", "a place", "a drag before"])
def test_the_spacing_after_an_edit_is_that_of_a_sheet_made_anew(
    qapp: QApplication, changed: str
) -> None:
    former, blueprint = sheet(), sample("hanoi.json")
    places = place_states(blueprint["SB1"])
    name = former.picture.names[4]
    if changed == "a name":
        longer = f"{name}_longer_than_all_others"
        blueprint = rename(blueprint, Address("SB1", name), longer)
        places[longer] = places.pop(name)
    elif changed == "a place":
        places[name] = (places[name][0] + 300.0, places[name][1])
    elif changed == "a drag before":
        places = {one: (0.2 * x, 0.2 * y) for one, (x, y) in places.items()}
        former.move({state: places[one] for one, state in former.picture.index.items()})
    given = Picture(blueprint, "SB1"), places, Ink(LIGHT), Marks()
    assert Sheet(*given, former).spacing == Sheet(*given).spacing


def test_the_spacing_is_computed_once_for_the_same_nodes(
    qapp: QApplication, monkeypatch: pytest.MonkeyPatch
) -> None:
    former, blueprint = sheet(), sample("hanoi.json")
    state, operations = next(iter(blueprint["SB1"].table.items()))
    after = rename(blueprint, Address("SB1", state, next(iter(operations))), "Op_9z")
    given = Picture(after, "SB1"), place_states(after["SB1"]), Ink(LIGHT), Marks()
    monkeypatch.delattr("smsl_studio.studio.base.canvas.sheet.spacing_of")
    assert Sheet(*given, former).spacing == former.spacing
