"""Labels in whole drawings: never over a node, never over another label."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.curves import LineStyle, meets
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.labels import AsideRect
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.prefix import left_out
from tests.stories.at_canvas import sample

PICTURES = ["hfsm.json", "registration.json", "hanoi.json"]


def geometry_of(
    blueprint: Blueprint, branch: str, size: tuple[float, float], style: LineStyle
) -> Geometry:
    """The geometry of an SB with labels of about six pixels a letter."""
    picture = Picture(blueprint, branch)
    places = place_states(picture.branch)
    at = np.array([places[name] for name in picture.names])
    boxes = np.hstack([at, np.full_like(at, size) / 2 * style.unit])

    def label_size(edge: int) -> tuple[float, float]:
        return (len(picture.label(edge)) * 6.0 + 8.0) * style.unit, 15.0 * style.unit

    return Geometry(picture, boxes, style, label_size, {})


def shown(geometry: Geometry) -> dict[int, tuple[float, float, float, float]]:
    edges = range(len(geometry.picture.operations))
    return {e: rect for e in edges if (rect := geometry.label(e)) is not None}


@pytest.mark.parametrize("name", PICTURES)
@pytest.mark.parametrize("style", [LineStyle(), LineStyle(1.0, True), LineStyle(1.9, True)])
def test_no_label_lies_over_another_or_over_a_node(name: str, style: LineStyle) -> None:
    blueprint = sample(name)
    size = (46.0, 24.0) if style.compact else (108.0, 54.0)
    for branch in blueprint.branches:
        geometry = geometry_of(blueprint, branch, size, style)
        rects = shown(geometry)
        for (a, b, c, d), (e, f, g, h) in combinations(rects.values(), 2):
            assert c <= e or g <= a or d <= f or h <= b
        for left, top, right, bottom in rects.values():
            for x, y, w, h in geometry.boxes:
                assert right <= x - w or left >= x + w or bottom <= y - h or top >= y + h


def test_every_label_of_the_samples_finds_a_place() -> None:
    for name in ("hfsm.json", "registration.json"):
        blueprint = sample(name)
        for branch in blueprint.branches:
            geometry = geometry_of(blueprint, branch, (108.0, 54.0), LineStyle())
            hidden = set(range(len(geometry.picture.operations))) - shown(geometry).keys()
            assert not hidden, [str(geometry.picture.address(e)) for e in hidden]


@pytest.mark.parametrize("unit", [1.0, 1.3, 1.6, 1.9, 2.2])
def test_the_only_name_of_two_lines_stands_at_its_own(unit: float) -> None:
    """Else a reader takes it for the name of the other one."""
    geometry = geometry_of(hanoi(3), "SB1", (46.0, 24.0), LineStyle(unit, True))
    picture, rects = geometry.picture, shown(geometry)
    lines: dict[frozenset[int], list[int]] = {}
    for edge in range(len(picture.operations)):
        ends = frozenset((int(picture.source[edge]), int(picture.target[edge])))
        lines.setdefault(ends, []).append(edge)
    for pair in lines.values():
        named = [edge for edge in pair if edge in rects]
        if len(pair) == 2 and len(named) == 1:
            other = next(edge for edge in pair if edge not in named)
            own, beside = geometry.shape(named[0]), geometry.shape(other)
            rect = rects[named[0]]
            x, y = (rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2
            assert own.distance(x, y) < beside.distance(x, y), picture.address(named[0])


def test_no_line_of_the_samples_runs_through_a_node() -> None:
    for name in ("hfsm.json", "registration.json"):
        blueprint = sample(name)
        for branch in blueprint.branches:
            geometry = geometry_of(blueprint, branch, (108.0, 54.0), LineStyle())
            picture = geometry.picture
            for edge in range(len(picture.operations)):
                ends = int(picture.source[edge]), int(picture.target[edge])
                assert not meets(geometry.shape(edge).points, geometry.boxes, ends, -0.5)


def test_a_large_picture_is_routed_edge_by_edge() -> None:
    geometry = geometry_of(hanoi(6), "SB1", (64.0, 24.0), LineStyle(1.0, True))
    assert not geometry.small
    first = geometry.shape(0)
    assert geometry.shape(0) is first
    near = geometry.picture.edges_of(0)
    assert sorted(geometry.forget([0])) == sorted(near)
    assert geometry.shape(0) is not first


def test_the_same_picture_is_always_drawn_the_same_way() -> None:
    blueprint = sample("registration.json")
    one = geometry_of(blueprint, "REGISTRATION", (108.0, 54.0), LineStyle())
    two = geometry_of(blueprint, "REGISTRATION", (108.0, 54.0), LineStyle())
    assert shown(one) == shown(two)


def test_the_shared_prefix_is_left_out_only_where_names_remain() -> None:
    assert left_out(["Op_1a", "Op_2b"]) == "Op_"
    assert left_out(["move-a", "move-b", "move-to-c"]) == "move-"
    assert left_out(["Operation000", "Operation100A"]) == ""
    assert left_out(["Op_", "Op_a"]) == ""
    assert left_out(["Op_a"]) == ""
    assert left_out(["Op_set_a", "Op_set_b"]) == "Op_set_"


def test_marks_of_the_sub_sb_are_classed() -> None:
    picture = Picture(sample("hfsm.json"), "SB1")
    kinds = {picture.operations[e]: picture.kind(e) for e in range(len(picture.operations))}
    assert kinds == {
        "Operation000": "",
        "Operation100A": "rise",
        "Operation100B": "mixed",
        "Operation110A": "fall",
        "Operation110B": "",
    }


def test_in_a_drag_no_name_is_led_to_its_line() -> None:
    """The search for such places takes most of the time of a step; the drop places all again."""
    style = LineStyle(1.9, True)
    geometry = geometry_of(sample("registration.json"), "REGISTRATION", (46.0, 24.0), style)
    before = [rect for rect in shown(geometry).values() if isinstance(rect, AsideRect)]
    assert before, "a drawing in which some names are led"
    edges = geometry.forget(range(len(geometry.picture)))
    geometry.prepare(edges)
    after = shown(geometry).values()
    assert after
    assert not [rect for rect in after if isinstance(rect, AsideRect)]
