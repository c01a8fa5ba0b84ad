"""Notes and groups in pictures: how words are broken, where frames lie, what a file shows."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.drawn_parts import (
    AROUND,
    BAR,
    MOST_LINES,
    NOTE_WIDTH,
    DrawnParts,
    by_words,
    day_words,
)
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.part import chosen_part
from smsl_studio.picture.part_svg import draw_frame, draw_part
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.svg import as_svg, draw_blueprint, one_below_another
from smsl_studio.picture.words import broken, width
from smsl_studio.smsl.json_form import parse_json

NOTES = {
    "1": {
        "text": "It drifts when warm",
        "author": "R. Stein",
        "date": "2026-11-12",
        "at": [40, 60],
    },
    "2": {"text": "On <S0> & co", "at": [90, 40], "state": "S0"},
}


def blueprint(notes: Any = NOTES, groups: Any = None) -> Blueprint:
    layout = {"S0": [0, 0], "S1": [300, 0], "S2": [600, 200]}
    groups = (
        {"1": {"title": "One fact <missing>", "states": ["S0", "S1"]}} if groups is None else groups
    )
    sb = {"S0": {"o": "S1"}, "S1": {"p": "S2"}, "S2": {}, "_notes": notes,
          "_layout": {**layout, "_groups": groups}}  # fmt: skip
    return read_blueprint(parse_json(json.dumps({"A": sb}), "f.json"))


def figure(made: Blueprint) -> Figure:
    picture = Picture(made, "A")
    return Figure(picture, place_states(picture.branch))


@given(st.text(max_size=400), st.floats(20.0, 200.0), st.integers(1, 6))
def test_no_line_is_wider_than_its_room_and_no_more_are_drawn(
    text: str, room: float, most: int
) -> None:
    lines = broken(text, 11.0, room, most)
    assert len(lines) <= most
    assert all(width(line, 11.0) <= room or len(line) <= 8 for line in lines)


def test_lines_break_at_spaces_and_in_words_that_are_too_long() -> None:
    assert broken("one two three", 11.0, 50.0, 9) == ["one two", "three"]
    assert broken("one\ntwo", 11.0, 50.0, 9) == ["one", "two"]
    assert "".join(broken("x" * 40, 11.0, 50.0, 9)) == "x" * 40
    assert broken("a\n\nb", 11.0, 50.0, 9) == ["a", "", "b"]


def test_a_cut_text_ends_with_dots() -> None:
    lines = broken("word " * 2_000, 11.0, 100.0, 3)
    assert len(lines) == 3
    assert lines[-1].endswith("…")
    assert not broken("word word", 11.0, 100.0, 3)[-1].endswith("…")
    assert broken("\n" * 10_000, 11.0, 100.0, 3)[-1].endswith("…")


@pytest.mark.parametrize(
    ("day", "words"),
    [("2026-11-12", "12 Nov 2026"), ("2026-13-12", "2026-13-12"), ("soon", "soon"), ("", "")],
)
def test_a_day_is_said_as_people_do(day: str, words: str) -> None:
    assert day_words(day) == words
    assert by_words("R. Stein", day) == ("R. Stein, " + words if words else "R. Stein")


def test_a_note_on_a_state_moves_with_it_and_a_free_one_does_not() -> None:
    made = blueprint()
    parts = DrawnParts(made["A"], {"S0": 0, "S1": 1, "S2": 2})
    at = np.array([(10.0, 20.0), (300.0, 0.0), (600.0, 200.0)])
    free, hung = parts.note_rects(at).tolist()
    assert free[:2] == [40.0, 60.0]
    assert hung[:2] == [100.0, 60.0]
    assert free[2] - free[0] == NOTE_WIDTH


def test_a_frame_is_around_its_states_with_room_for_its_title() -> None:
    made = blueprint()
    parts = DrawnParts(made["A"], {"S0": 1, "S1": 0, "S2": 2})
    boxes = np.array([(0.0, 0.0, 54.0, 27.0), (300.0, 50.0, 54.0, 27.0), (900.0, 0.0, 1.0, 1.0)])
    ((left, top, right, bottom),) = parts.group_rects(boxes).tolist()
    assert (top, bottom) == (-27.0 - AROUND - BAR, 77.0 + AROUND)
    assert (left, right) == (-54.0 - AROUND, 354.0 + AROUND)


def test_a_file_shows_notes_and_groups() -> None:
    svg = as_svg(one_below_another(draw_blueprint(blueprint(), ["A"])), "x")
    for words in ("It drifts when warm", "R. Stein, 12 Nov 2026", "On &lt;S0&gt; &amp; co",
                  "One fact &lt;missing&gt;"):  # fmt: skip
        assert words in svg
    assert "It drifts" not in as_svg(one_below_another(draw_blueprint(blueprint({}), ["A"])), "x")


def test_the_picture_is_as_large_as_its_notes_need() -> None:
    left, _, _, bottom = figure(blueprint({"1": {"text": "far", "at": [-900, 900]}})).bounds()
    assert left <= -900.0
    assert bottom >= 900.0


def test_a_selection_has_the_notes_of_its_states_and_groups_that_are_whole() -> None:
    made = blueprint()
    drawing = figure(made)
    part = chosen_part(drawing.picture, [Address("A", "S0"), Address("A", "S1")])
    assert drawing.drawn_with([0]) == ([1], [])
    assert drawing.drawn_with([0, 1]) == ([1], [0])
    assert drawing.drawn_with(None) == ([0, 1], [0])
    svg = draw_part(drawing, part, "x")
    assert "One fact" in svg
    assert "It drifts" not in svg


def test_a_frame_of_a_picture_has_the_notes_in_it() -> None:
    drawing = figure(blueprint())
    part = chosen_part(drawing.picture, [])
    scale = drawing.scale
    svg = draw_frame(drawing, part, (30.0 * scale, 50.0 * scale, 60.0 * scale, 70.0 * scale), "x")
    assert "It drifts" in svg
    assert "It drifts" not in draw_frame(drawing, part, (5000.0, 5000.0, 5100.0, 5100.0), "x")


def test_an_sb_of_notes_alone_is_drawn() -> None:
    sb = {"_notes": {"1": {"text": "Begin here", "at": [0, 0]}}}
    made = read_blueprint(parse_json(json.dumps({"A": sb}), "f.json"))
    svg = as_svg(one_below_another(draw_blueprint(made, ["A"])), "x")
    assert "Begin here" in svg


def test_at_most_so_many_lines_are_drawn() -> None:
    made = blueprint({"1": {"text": "word\n" * 1_900, "at": [0, 0]}})
    svg = as_svg(one_below_another(draw_blueprint(made, ["A"])), "x")
    assert svg.count(">word") == MOST_LINES
