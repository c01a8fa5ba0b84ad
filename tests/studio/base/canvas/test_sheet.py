"""A sheet keeps the lines of the last zooms, and forgets them when a state moves."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication

from smsl_studio.graph.layout import place_states
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
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
