"""The mark of the initial state stands where no line and no label is."""

from __future__ import annotations

import numpy as np
import pytest

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.curves import LineStyle, meets
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.initial_mark import rect_of
from smsl_studio.picture.labels import meet
from smsl_studio.picture.picture import Picture
from smsl_studio.smsl.json_form import parse_json, write_json


def geometry_of(back: bool, style: LineStyle, left: float = -300.0) -> Geometry:
    """An initial state with a state at its left, to which an operation leads, and one ``back``."""
    states: dict[str, dict[str, object]] = {"HEADER": {"INITIAL": "a"}, "a": {"x": "b"}, "b": {}}
    if back:
        states["b"] = {"y": "a"}
    text = write_json({"SB1": states})
    picture = Picture(read_blueprint(parse_json(text, "left.json")), "SB1")
    half = (23.0, 12.0) if style.compact else (54.0, 27.0)
    boxes = np.array([(0.0, 0.0, *half), (left, 0.0, *half)])
    return Geometry(picture, boxes, style, lambda edge: (200.0, 15.0), {})


@pytest.mark.parametrize("style", [LineStyle(), LineStyle(1.0, True)])
@pytest.mark.parametrize("back", [False, True])
def test_the_mark_keeps_off_lines_and_labels(style: LineStyle, back: bool) -> None:
    geometry = geometry_of(back, style)
    rect = rect_of(geometry.box(0), geometry.mark_shift, 1.0)
    box = np.array([[rect[0] + rect[2], rect[1] + rect[3], rect[2] - rect[0], rect[3] - rect[1]]])
    for edge in range(len(geometry.picture.operations)):
        assert not meets(geometry.shape(edge).points, box / 2, (), 0.0)
        label = geometry.label(edge)
        assert label is None or not meet(label, rect)


def test_the_mark_stands_in_the_middle_where_nothing_is() -> None:
    assert geometry_of(False, LineStyle(), left=300.0).mark_shift == 0.0
    assert geometry_of(False, LineStyle()).mark_shift != 0.0
