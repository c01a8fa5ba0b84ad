"""Bundles: operations between the same two states are one line, and none is lost."""

from __future__ import annotations

import json
import re
from collections import Counter
from html import unescape
from random import Random
from typing import Any

import numpy as np
import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.inputs import read
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.bundles import NO_BUNDLES, bundles_of, chip_size, line_width
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.svg import draw_blueprint
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.picture.measured import Drawing, drawing_of, measure

SAMPLES = ["registration", "hanoi-corrected", "hfsm", "registration-failures", "three-levels"]


def parse(values: dict[str, Any]) -> Document:
    return parse_json(json.dumps(values), "file.json")


def sample(name: str) -> Blueprint:
    return read(samples_dir() / f"{name}.json")


def random_ends(seed: int) -> tuple[Any, Any]:
    chance = Random(seed)
    count = chance.randint(1, 6)
    ends = [(chance.randrange(count), chance.randrange(-1, count)) for _ in range(20)]
    source, target = zip(*ends, strict=True)
    return np.array(source, dtype=np.int32), np.array(target, dtype=np.int32)


@pytest.mark.parametrize("seed", range(share_of(30)))
def test_operations_between_two_states_are_in_one_bundle(seed: int) -> None:
    source, target = random_ends(seed)
    found = bundles_of(source, target)
    pairs: dict[tuple[int, int], list[int]] = {}
    for edge, (a, b) in enumerate(zip(source.tolist(), target.tolist(), strict=True)):
        if b >= 0 and a != b:
            pairs.setdefault((min(a, b), max(a, b)), []).append(edge)
    wanted = {own[0]: tuple(own) for own in pairs.values() if len(own) > 1}
    assert dict(found.members) == wanted
    assert found.hidden == {edge for own in wanted.values() for edge in own[1:]}
    # Some operations drawn by themselves leave the others in their bundle.
    chosen = set(Random(seed).sample(range(20), 5))
    left = found.without(chosen)
    kept = ([edge for edge in own if edge not in chosen] for own in wanted.values())
    assert sorted(left.members.values()) == sorted(tuple(own) for own in kept if len(own) > 1)
    assert found.without(()) is found


def collapsed(name: str, branch: str) -> Figure:
    blueprint = sample(name)
    picture = Picture(blueprint, branch)
    return Figure(picture.bundled(picture.all_bundles), place_states(blueprint[branch]))


@pytest.mark.parametrize("name", SAMPLES)
def test_no_line_and_no_chip_lies_on_a_node(name: str) -> None:
    for branch in sample(name):
        figure = collapsed(name, branch.name)
        picture, whole = figure.picture, drawing_of(figure)
        edges = [e for e, target in enumerate(picture.target.tolist()) if target >= 0]
        shown = [at for at, edge in enumerate(edges) if edge not in picture.bundles.hidden]
        assert len(shown) == picture.line_count
        drawn = Drawing(
            whole.nodes,
            [whole.ends[at] for at in shown],
            [whole.lines[at] for at in shown],
            [whole.labels[at] for at in shown],
        )
        found = measure(drawn)
        assert (found.edge_through_node, found.label_on_node, found.hidden) == (0, 0, 0)


@pytest.mark.parametrize("name", SAMPLES)
def test_a_picture_names_every_operation_once(name: str) -> None:
    blueprint = sample(name)
    panels = draw_blueprint(blueprint, list(blueprint.branches), collapsed=True)
    for branch, panel in zip(blueprint, panels, strict=True):
        titles = [
            unescape(one) for one in re.findall(r"<title>(.*?)</title>", panel.svg, re.DOTALL)
        ]
        bundled = {title for title in titles if " -> " in title}
        told = Counter(line.split(" -> ")[1] for title in bundled for line in title.splitlines())
        single = Counter(t.split(" needs ")[0] for t in titles if " -> " not in t)
        names = Counter(edge.name for edge in branch.edges())
        assert all(told[one] + single[one] >= count for one, count in names.items())
        for title in bundled:
            own = [line.split(" -> ") for line in title.splitlines()]
            assert len(own) > 1
            assert len({frozenset((a, b)) for a, _, b in own}) == 1
            assert all(branch.table[a][operation] == b for a, operation, b in own)


def test_a_line_has_a_head_where_an_operation_leads() -> None:
    values = {"SB": {"State_0": {"a": "State_1", "b": "State_1"},
                     "State_1": {"c": "State_2"}, "State_2": {"d": "State_1"}}}  # fmt: skip
    blueprint = read_blueprint(parse(values))
    picture = Picture(blueprint, "SB")
    picture = picture.bundled(picture.all_bundles)
    assert dict(picture.bundles.members) == {0: (0, 1), 2: (2, 3)}
    assert [picture.leads_back(edge) for edge in (0, 2)] == [False, True]
    assert [picture.line_of(edge) for edge in range(4)] == [0, 0, 2, 2]
    assert (picture.line_count, set(picture.edges_of(1))) == (2, {0, 2})
    assert picture.bundled(NO_BUNDLES).line_count == 4


def test_a_line_drawn_by_hand_stays_single() -> None:
    states = {"State_0": {"a": "State_1", "b": "State_1", "c": "State_1"}, "State_1": {}}
    layout = {"State_0": [0, 0], "State_1": [400, 0],
              "_operations": {"State_0/b": {"bends": [[200, 90]]}}}  # fmt: skip
    blueprint = read_blueprint(parse({"SB": {"_layout": layout, **states}}))
    (panel,) = draw_blueprint(blueprint, ["SB"], collapsed=True)
    titles = re.findall(r"<title>(.*?)</title>", panel.svg, re.DOTALL)
    assert "b" in titles
    assert any(title.count("\n") == 1 for title in titles)


def test_a_chip_is_as_wide_as_its_number_and_three_make_a_line_thicker() -> None:
    assert chip_size(2) == chip_size(99) == (18.0, 18.0)
    assert chip_size(100)[0] > 18.0
    assert (line_width(2), line_width(3)) == (3.0, 4.0)
