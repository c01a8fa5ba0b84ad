"""SVG pictures are well formed and hold every name; nothing overlaps, is cut or is unescaped."""

from __future__ import annotations

import json
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import smsl_studio as smsl
from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.colours import DARK, LIGHT
from smsl_studio.picture.compared import draw_difference
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.labels import meet
from smsl_studio.picture.paper import as_pdf, as_png
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.svg import as_svg, draw_blueprint, one_below_another
from smsl_studio.picture.words import elided, width
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of

SVG = "{http://www.w3.org/2000/svg}"
SAMPLES = sorted(path.name for path in samples_dir().glob("*.json"))


def of(values: Any) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), "test.json"))


def svg_of(blueprint: Blueprint) -> str:
    panels = draw_blueprint(blueprint, list(blueprint.branches))
    return as_svg(one_below_another(panels), "a picture")


def words_of(svg: str) -> list[str]:
    return [node.text or "" for node in ET.fromstring(svg).iter(f"{SVG}text")]


def titles_of(svg: str) -> list[str]:
    return [node.text or "" for node in ET.fromstring(svg).iter(f"{SVG}title")]


@pytest.mark.parametrize("name", SAMPLES)
def test_every_sample_shows_every_name_and_nothing_overlaps(name: str) -> None:
    blueprint = smsl.read(samples_dir() / name)
    svg = svg_of(blueprint)
    shown = words_of(svg)
    for branch in blueprint:
        assert branch.name in shown
        assert set(branch.table) <= set(shown)
        figure = Figure(Picture(blueprint, branch.name), place_states(branch))
        edges = range(branch.edge_count)
        assert all(figure.label(edge) in shown for edge in edges)
        labels = [figure.geometry.label(edge) for edge in edges]
        assert None not in labels, "every label has a place"
        left, top, right, bottom = figure.bounds()
        boxes = [
            (x - w / 2, y - 27.0, x + w / 2, y + 27.0)
            for (x, y), w in zip(figure.at.tolist(), figure.widths.tolist(), strict=True)
        ]
        rects = [*filter(None, labels), *boxes]
        for i, one in enumerate(rects):
            assert left <= one[0]
            assert top <= one[1]
            assert one[2] <= right
            assert one[3] <= bottom
            assert not any(meet(one, other) for other in rects[:i])


def test_what_all_operations_share_is_said_once_and_left_out() -> None:
    shown = words_of(svg_of(hanoi(2)))
    assert "1a" in shown
    assert "Op_1a" not in shown
    assert "The name of every operation here begins with Op_" in shown


def test_marks_are_explained_where_they_occur() -> None:
    shown = words_of(svg_of(smsl.read(samples_dir() / "hfsm.json")))
    assert "turns “Fact 2” on" in shown
    assert any(words.startswith("expanded by a sub-SB: Fact 2 by SB2") for words in shown)
    assert "turns it off" not in words_of(svg_of(hanoi(2)))


def test_a_large_sb_is_dots_and_straight_lines_with_start_and_goal_named() -> None:
    svg = svg_of(hanoi(7))
    assert len(svg) < 400_000
    shown = words_of(svg)
    assert "State_aaaaaaa" in shown
    assert "State_ccccccc" in shown
    assert len(shown) < 10
    assert sum(1 for _ in ET.fromstring(svg).iter(f"{SVG}circle")) >= 3**7


def test_a_layout_in_the_file_is_followed() -> None:
    placed = {"A": [0, 0], "B": [0, 400]}
    blueprint = of({"S": {"A": {"go": "B"}, "B": {}, "_layout": placed}})
    figure = Figure(Picture(blueprint, "S"), place_states(blueprint["S"]))
    assert figure.at.tolist() == [[0.0, 0.0], [0.0, 400.0]]


ODD = st.text(
    st.characters(exclude_categories=["Cs"]) | st.sampled_from("<&\"'>]\u202e\u0000é中שم "),
    min_size=1,
    max_size=40,
).filter(lambda name: not name.startswith("_") and name != "HEADER")


@settings(max_examples=share_of(30))
@given(ODD, ODD, ODD)
def test_any_name_gives_a_picture_that_can_be_read(branch: str, state: str, name: str) -> None:
    svg = svg_of(of({branch: {state: {name: state, f"{name}2": "nowhere"}}}))
    assert len(titles_of(svg)) >= 4, "of the picture, the state and its two operations"
    assert not set("\u202e\u0000\ufffe") & set(svg)


def test_a_name_of_ten_thousand_characters_is_cut_in_its_middle() -> None:
    svg = svg_of(of({"S": {"a" + "x" * 9998 + "b": {"go": "nowhere"}}}))
    shown = [words for words in words_of(svg) if "…" in words]
    assert shown[0].startswith("a")
    assert shown[0].endswith("b")
    assert len(shown[0]) < 80


@given(st.text(max_size=60), st.floats(1.0, 400.0))
def test_what_is_cut_fits(text: str, room: float) -> None:
    cut = elided(text, 12.0, room)
    assert cut == text or len(cut) <= 3 or width(cut, 12.0) <= room


def test_png_and_pdf_are_made_without_a_display() -> None:
    blueprint = smsl.read(samples_dir() / "hfsm.json")
    panels = draw_blueprint(blueprint, list(blueprint.branches), DARK)
    png = as_png(as_svg(one_below_another(panels, DARK), "both", DARK), "both")
    assert png.startswith(b"\x89PNG")
    pdf = as_pdf([as_svg(panel, "one", DARK) for panel in panels], "é <&>")
    assert pdf.startswith(b"%PDF")
    assert pdf.count(b"/Type /Page\n") == 2 or pdf.count(b"/Type/Page") >= 2


def test_a_difference_is_marked_by_sign_and_form_on_both_sides() -> None:
    before = hanoi(2)
    after = edit.add_state(before, "SB1", "State_dd")
    after = edit.delete(after, [Address("SB1", "State_aa", "Op_1b")])
    after = edit.rename(after, Address("SB1", "State_cc"), "State_ee")
    panels = draw_difference(compare(before, after))
    svg = as_svg(one_below_another(panels), "difference")
    shown = words_of(svg)
    assert {"State_cc", "State_ee", "State_dd", "before", "after"} <= set(shown)
    assert "The state State_cc of SB1 is now called State_ee." in shown
    assert 'stroke-dasharray="5 3"' in svg
    for colour in (LIGHT["ok"], LIGHT["risk"], LIGHT["acc"]):
        assert colour in svg
    assert LIGHT["bad"] not in svg
    same = as_svg(one_below_another(draw_difference(compare(before, before))), "same")
    assert "No difference." in words_of(same)


def test_facts_for_which_a_node_has_no_room_are_counted() -> None:
    name = "State_" + "10" * 12
    document = parse_json(f'{{"S": {{"{name}": {{}}}}}}', "many.json")
    shown = words_of(svg_of(read_blueprint(document)))
    facts = [word for word in shown if word in ("0", "1")]
    assert f"+{24 - len(facts)}" in shown
    assert len(facts) > 8
