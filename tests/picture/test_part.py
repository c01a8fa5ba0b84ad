"""A part of a picture: the lines and labels lie where the whole picture has them."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.part import chosen_part, part_in, whole_part
from smsl_studio.picture.part_svg import draw_frame, draw_part
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.svg import as_svg, draw_blueprint
from smsl_studio.shipped import samples_dir

SVG = "{http://www.w3.org/2000/svg}"


def figure_of(name: str, branch: str) -> Figure:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    return Figure(Picture(blueprint, branch), place_states(blueprint[branch]))


def pieces(svg: str) -> set[str]:
    """The elements with a colour: lines, heads, boxes and words."""
    return set(re.findall(r"<(?:polyline|polygon|rect|text)[^>]*>(?:[^<]*</text>)?", svg))


@pytest.mark.parametrize(("name", "branch"), [("hanoi", "SB1"), ("hfsm", "SB1")])
def test_a_selection_looks_as_in_the_whole_picture(name: str, branch: str) -> None:
    figure = figure_of(name, branch)
    blueprint = figure.picture.blueprint
    whole = as_svg(draw_blueprint(blueprint, [branch])[0], "it")
    first, second = figure.picture.names[:2]
    chosen = [Address(branch, first), Address(branch, second)]
    part = chosen_part(figure.picture, chosen)
    svg = draw_part(figure, part, "it")
    ground = pieces(svg) - pieces(whole)
    assert len(ground) == 1, "only the ground has another size"
    words = [node.text for node in ET.fromstring(svg).iter(f"{SVG}text")]
    assert first in words
    assert second in words
    assert figure.picture.names[2] not in words


def test_a_frame_has_what_touches_it_and_nothing_else() -> None:
    figure = figure_of("hanoi", "SB1")
    picture = figure.picture
    aaa, baa = (picture.index[name] for name in ("State_aaa", "State_baa"))
    x, y = figure.at[aaa].tolist()
    frame = (x - 40.0, y - 5.0, x + 40.0, y + 60.0)
    part = part_in(figure, frame)
    assert part.states == (aaa,)
    names = {picture.operations[edge] for edge in part.edges}
    assert names == {"Op_1a", "Op_1b", "Op_1c"}
    svg = draw_frame(figure, part, frame, "it")
    assert f'viewBox="{frame[0]:.1f} '.replace(".0 ", " ") in svg
    assert ">State_aaa<" in svg
    assert ">State_baa<" not in svg
    left, top, right, bottom = figure.bounds()
    assert part_in(figure, (left, top, right, bottom)) == whole_part(picture)
    assert part_in(figure, (right + 1, 0.0, right + 9, 9.0)).states == ()
    assert baa not in part.states


def test_a_crowd_of_dots_is_cut_out_too() -> None:
    blueprint = hanoi(7)
    figure = Figure(Picture(blueprint, "SB1"), place_states(blueprint["SB1"]))
    assert not figure.shows_nodes
    left, top, right, bottom = figure.bounds()
    middle = (left + right) / 2
    part = part_in(figure, (left, top, middle, bottom))
    assert 0 < len(part.states) < len(figure.picture)
    svg = draw_frame(figure, part, (left, top, middle, bottom), "it")
    assert svg.count("<circle") >= len(part.states)
    ET.fromstring(svg)


def test_no_path_is_too_long_for_qt() -> None:
    blueprint = hanoi(8)
    svg = as_svg(draw_blueprint(blueprint, ["SB1"])[0], "it")
    paths = re.findall(r'<path d="([^"]*)"', svg)
    assert sum(path.count("L") for path in paths) == blueprint["SB1"].edge_count
    assert max(path.count("L") for path in paths) * 2 < 2**15
