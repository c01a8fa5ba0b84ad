"""The frame of a group contains the loops of its states and the names of these loops."""

from __future__ import annotations

import json

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.hidden_names import RADIUS, HiddenMarks
from smsl_studio.picture.labels import AsideRect, meet
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.strands import LineStyle
from smsl_studio.smsl.json_form import parse_json
from tests.stories.at_canvas import sample


@st.composite
def figures(draw: st.DrawFn) -> Figure:
    """States in a row with loops and other operations, the first ones in a group."""
    count = draw(st.integers(2, 5))
    names = [f"State{at}" for at in range(count)]
    table: dict[str, object] = {"HEADER": {}}
    for at, name in enumerate(names):
        loops = {f"turn{at}{'n' * (3 * loop)}": name for loop in range(draw(st.integers(0, 4)))}
        ends = draw(st.lists(st.sampled_from(names), max_size=2, unique=True))
        table[name] = loops | {f"go{at}{end}": end for end in ends if end != name}
    members = names[: draw(st.integers(1, count))]
    table["_layout"] = {"_groups": {"1": {"title": "Motion", "states": members}}}
    picture = Picture(read_blueprint(parse_json(json.dumps({"S": table}), "test.json")), "S")
    step = draw(st.integers(180, 400)), draw(st.integers(-200, 200))
    return Figure(picture, {n: (at * step[0], at * step[1]) for at, n in enumerate(names)})


@given(figures())
def test_a_frame_contains_the_loops_of_its_states_and_their_names(figure: Figure) -> None:
    ((left, top, right, bottom),) = figure.group_rects.tolist()
    ((title_left, title_top, title_right, _),) = figure.title_rects.tolist()
    assert top == title_top
    assert left <= title_left
    assert title_right <= right
    picture, members = figure.picture, figure.drawn.members[0].tolist()
    for edge in range(len(picture.operations)):
        if picture.source[edge] == picture.target[edge] and picture.source[edge] in members:
            line, name = figure.geometry.shape(edge).bounds, figure.geometry.label(edge)
            # A name without room beside its loop stands away from it, with a leader.
            away = name is None or isinstance(name, AsideRect)
            for rect in (line,) if name is None or away else (line, name):
                assert left <= rect[0]
                assert top <= rect[1]
                assert rect[2] <= right
                assert rect[3] <= bottom


def test_a_mark_of_hidden_names_that_a_node_covers_says_so() -> None:
    picture = Picture(sample("hanoi.json"), "SB1")
    picture.crowd = 10_000  # a large picture
    for gap, covered in ((60.0, False), (8.0, True)):
        side = 46.0 + gap
        at = [(at % 6 * side, at // 6 * 300.0) for at in range(len(picture))]
        boxes = np.hstack([np.array(at), np.tile([23.0, 12.0], (len(at), 1))])
        style = LineStyle(compact=True)
        geometry = Geometry(picture, boxes, style, lambda edge: (400.0, 15.0), {})
        marks = HiddenMarks(geometry).of(range(len(picture.operations)))
        rects = [(x - w, y - h, x + w, y + h) for x, y, w, h in boxes.tolist()]
        assert marks
        assert covered == any(not mark.radius for mark in marks)
        for mark in marks:
            x, y = mark.at
            ring = (x - RADIUS, y - RADIUS, x + RADIUS, y + RADIUS)
            assert not mark.radius or not any(meet(ring, rect) for rect in rects)


def test_a_mark_with_room_is_in_the_middle_of_its_line_in_a_large_picture() -> None:
    picture = Picture(sample("hanoi.json"), "SB1")
    picture.crowd = 10_000
    turn = np.linspace(0.0, 6.0, len(picture))
    at = 5000.0 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    boxes = np.hstack([at, np.full((len(at), 2), 3.0)])
    style = LineStyle(compact=True)
    geometry = Geometry(picture, boxes, style, lambda edge: (9000.0, 9000.0), {})
    marks = HiddenMarks(geometry).of(range(len(picture.operations)))
    assert marks
    for mark in marks:
        shape = geometry.shape(mark.edges[0])
        assert mark.radius == RADIUS
        assert np.allclose(mark.at, shape.at(shape.length / 2), atol=1.0)
