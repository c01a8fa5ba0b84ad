"""Lines between the same two states: each name stands at its own line and covers no other."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.picture.strands import LineStyle
from smsl_studio.smsl.json_form import parse_json

PLACES = {"A": (0.0, 0.0)}


def pictured(there: list[str], back: list[str]) -> Picture:
    table = {
        "HEADER": {},
        "A": dict.fromkeys(there, "B"),
        "B": dict.fromkeys(back, "A"),
    }
    return Picture(read_blueprint(parse_json(json.dumps({"S": table}), "test.json")), "S")


def way(shape: EdgeShape) -> np.ndarray:
    """Many points along a line."""
    return np.array([shape.at(shape.length * share) for share in np.linspace(0.0, 1.0, 400)])


def check_apart(geometry: Geometry) -> None:
    lines = {edge: way(geometry.shape(edge)) for edge in range(len(geometry.picture.operations))}
    for edge, own in lines.items():
        label = geometry.label(edge)
        assert label is not None
        left, top, right, bottom = label
        middle = (left + right) / 2, (top + bottom) / 2
        away = np.hypot(*(own - middle).T).min()
        for other, points in lines.items():
            if other != edge:
                inside = (points > (left, top)).all(axis=1) & (points < (right, bottom)).all(axis=1)
                assert not inside.any(), (edge, other)
                assert np.hypot(*(points - middle).T).min() > away


@given(
    st.floats(0.0, 360.0), st.floats(330.0, 700.0), st.integers(1, 12), st.integers(1, 12),
    st.booleans(),
)  # fmt: skip
def test_the_names_of_two_lines_are_told_apart(
    turn: float, far: float, first: int, second: int, opposite: bool
) -> None:
    names = ["a" * first, "b" * second]
    picture = pictured(names[:1], names[1:]) if opposite else pictured(names, [])
    to = far * math.cos(math.radians(turn)), far * math.sin(math.radians(turn))
    check_apart(Figure(picture, {**PLACES, "B": to}).geometry)
    if abs(to[0]) <= 0.36 * abs(to[1]):
        return  # between compact nodes one above the other names have less room
    boxes = np.array([(0.0, 0.0, 30.0, 12.0), (*to, 30.0, 12.0)])
    sizes = [8.0 + 6.5 * first, 8.0 + 6.5 * second]
    style = LineStyle(compact=True)
    check_apart(Geometry(picture, boxes, style, lambda edge: (sizes[edge], 15.0), {}))


@pytest.mark.parametrize("turn", [0, 90, 180, 270])
def test_the_names_of_three_lines_in_a_row_or_column_are_told_apart(turn: int) -> None:
    picture = pictured(["Travel", "Stop"], ["Turn"])
    to = 420.0 * math.cos(math.radians(turn)), 420.0 * math.sin(math.radians(turn))
    check_apart(Figure(picture, {**PLACES, "B": to}).geometry)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_loop_is_large_enough_to_be_grasped(count: int) -> None:
    table = {"HEADER": {}, "A": {f"turn{at}": "A" for at in range(count)}}
    picture = Picture(read_blueprint(parse_json(json.dumps({"S": table}), "test.json")), "S")
    shapes = [Figure(picture, PLACES).geometry.shape(edge) for edge in range(count)]
    spans = [shape.bounds for shape in shapes]
    assert min(right - left for left, _, right, _ in spans) >= 19.0
    assert max(right - left for left, _, right, _ in spans) >= 27.0
    assert min(shape.length for shape in shapes) >= 38.0
