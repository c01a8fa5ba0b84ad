"""The SVG of a branch: well formed, every state and operation in it, marks where they belong."""

from __future__ import annotations

from xml.etree import ElementTree as ET

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rules import hanoi
from smsl_studio.picture.svg import HEIGHT, WIDTH, Point, draw_branch
from smsl_studio.smsl.json_form import parse_json

SVG = "{http://www.w3.org/2000/svg}"


def read(text: str) -> Blueprint:
    return read_blueprint(parse_json(text, "test.json"))


def on_a_row(branch: StateBranch) -> dict[str, Point]:
    return {name: (200.0 * index, 0.0) for index, name in enumerate(branch.table)}


def texts(svg: str) -> list[str]:
    return [node.text or "" for node in ET.fromstring(svg).iter(f"{SVG}text")]


def test_every_state_and_operation_is_drawn_without_the_prefix_they_share() -> None:
    branch = hanoi(2)["SB1"]
    svg = draw_branch(branch, on_a_row(branch))
    titles = [node.text for node in ET.fromstring(svg).iter(f"{SVG}title")]
    assert titles == list(branch.table)
    assert set(branch.table) <= set(texts(svg))
    edges = [edge.name.removeprefix("Op_") for edge in branch.edges()]
    assert sorted(text for text in texts(svg) if len(text) == 2) == sorted(edges)


def test_the_activating_state_has_a_second_outline_and_the_initial_one_a_dot() -> None:
    branch = hanoi(2)["SB1"]
    groups = {
        group.findtext(f"{SVG}title"): group
        for group in ET.fromstring(draw_branch(branch, on_a_row(branch))).iter(f"{SVG}g")
    }
    outlines = {name: len(group.findall(f"{SVG}rect")) for name, group in groups.items()}
    assert [name for name, count in outlines.items() if count == 2] == ["State_cc"]
    assert [n for n, g in groups.items() if g.find(f"{SVG}circle") is not None] == ["State_aa"]


def test_opposite_operations_bend_apart_and_edges_end_at_the_box() -> None:
    branch = read('{"B": {"S0": {"go": "S1"}, "S1": {"back": "S0"}}}')["B"]
    root = ET.fromstring(draw_branch(branch, {"S0": (0.0, 0.0), "S1": (400.0, 0.0)}))
    curves = [p.get("d", "") for p in root.iter(f"{SVG}path") if "Q" in p.get("d", "")]
    assert len(curves) == 2
    middles = [float(d.split("Q")[1].split()[1]) for d in curves]
    assert middles[0] == -middles[1] != 0
    x, y = (float(v) for v in curves[0][1:].split("Q")[0].split())
    assert x == WIDTH / 2
    assert abs(y) < HEIGHT / 2


def test_parallel_operations_and_loops_each_have_their_own_line() -> None:
    branch = read('{"B": {"S0": {"a": "S1", "b": "S1", "c": "S0", "d": "S0"}, "S1": {}}}')["B"]
    root = ET.fromstring(draw_branch(branch, {"S0": (0.0, 0.0), "S1": (300.0, 80.0)}))
    lines = [p.get("d") for p in root.iter(f"{SVG}path") if p.get("marker-end")]
    assert len(lines) == len(set(lines)) == 5  # four operations and the mark of the initial state


def test_the_picture_holds_every_node() -> None:
    branch = hanoi(2)["SB1"]
    root = ET.fromstring(draw_branch(branch, on_a_row(branch)))
    left, top, width, height = map(float, root.get("viewBox", "").split())
    for box in list(root.iter(f"{SVG}rect"))[1:]:
        x, y = float(box.get("x", "")), float(box.get("y", ""))
        assert left < x < left + width - float(box.get("width", ""))
        assert top < y < top + height - float(box.get("height", ""))


def test_names_that_look_like_markup_stay_text_and_loops_are_drawn() -> None:
    branch = read('{"B & \\"C\\"": {"S<0>": {"a&b": "S<0>"}}}')['B & "C"']
    svg = draw_branch(branch, {"S<0>": (0.0, 0.0)})
    assert ET.fromstring(svg).get("aria-label") == 'B & "C"'
    assert {"S<0>", "a&b"} <= set(texts(svg))


def test_a_state_without_a_position_is_left_out_with_its_operations() -> None:
    branch = hanoi(2)["SB1"]
    positions = on_a_row(branch)
    del positions["State_aa"]
    drawn = texts(draw_branch(branch, positions))
    assert "State_aa" not in drawn
    kept = [e for e in branch.edges() if "State_aa" not in (e.source, e.target)]
    assert sum(len(text) == 2 for text in drawn) == len(kept)


def test_an_empty_branch_is_an_empty_picture() -> None:
    assert texts(draw_branch(read('{"B": {}}')["B"], {})) == []
