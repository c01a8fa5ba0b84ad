"""A picture has the routes and labels of the canvas, wherever the canvas shows whole nodes."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QApplication

import smsl_studio as smsl
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.levels import Level
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.theme import LIGHT

NEAR = 12.0
"""Pixels by which a label may lie elsewhere, because a file cannot measure letters as a window
does."""


@pytest.mark.parametrize(
    ("name", "branch"),
    [("hfsm", "SB1"), ("registration", "REGISTRATION"), ("three-levels", "SURGERY"),
     ("three-roots", "TOOLPLAN"), ("registration-people", "REGISTRATION")],
)  # fmt: skip
def test_lines_and_labels_lie_as_on_the_canvas(name: str, branch: str, qapp: QApplication) -> None:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    picture, places = Picture(blueprint, branch), place_states(blueprint[branch])
    figure, sheet = Figure(picture, places), Sheet(picture, places, Ink(LIGHT), Marks())
    assert sheet.level is Level.FULL
    for edge in range(len(picture.operations)):
        drawn, shown = figure.geometry.shape(edge), sheet.geometry.shape(edge)
        assert (drawn.way, drawn.side, drawn.out) == (shown.way, shown.side, shown.out)
        if figure.scale == 1.0:
            one, other = figure.geometry.label(edge), sheet.geometry.label(edge)
            assert one is not None
            assert other is not None
            assert abs(one[0] + one[2] - other[0] - other[2]) / 2 < NEAR
            assert abs(one[1] + one[3] - other[1] - other[3]) / 2 < NEAR
