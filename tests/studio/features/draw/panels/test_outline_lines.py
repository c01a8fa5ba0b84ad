"""The lines of the outline: levels, facts, sub-SBs and marks; odd blueprints are shown too."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.files import parse_bytes, read_document
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.features.draw.panels.outline_lines import OutlineLine, worst_of
from smsl_studio.studio.features.draw.panels.outline_nodes import (
    DEEPEST,
    MOST_PLANNED,
    OutlineNodes,
)
from tests.bombs.table import BY_NAME
from tests.bombs.test_work import steps

SAMPLES = Path(__file__).parents[5] / "samples"


def read(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), "a.json"))


def lines_of(blueprint: Blueprint, depth: int = 100) -> list[tuple[int, OutlineLine]]:
    """Every line, with how many stand above it, down to a depth."""
    nodes, worst = OutlineNodes(blueprint), worst_of(inspect(blueprint))
    stack = [(0, node) for node in reversed(nodes.top)]
    found = []
    while stack:
        above, node = stack.pop()
        found.append((above, nodes.line(node, worst)))
        assert nodes.leads_down(node) == bool(nodes.below(node))
        if above < depth:
            stack += [(above + 1, below) for below in reversed(nodes.below(node))]
    return found


def test_sub_sbs_stand_below_their_fact_one_level_down() -> None:
    lines = lines_of(read_blueprint(read_document(SAMPLES / "hfsm.json")))
    assert [(above, line.text, line.right) for above, line in lines] == [
        (0, "SB1", "0"), (1, "Fact 1", ""), (1, "Fact 2", ""), (2, "SB2", "1"),
        (3, "Fact 1", ""), (1, "Fact 3", ""),
    ]  # fmt: skip
    assert lines[0][1].severity == "W"
    assert [line.sub for _, line in lines] == [False, False, True, False, False, False]


def test_values_beyond_0_and_1_are_named() -> None:
    lines = [line for _, line in lines_of(read_blueprint(read_document(SAMPLES / "hanoi.json")))]
    assert lines[0].severity == "E"
    assert [line.right for line in lines[1:]] == ["a b c"] * 3


def test_sbs_in_a_cycle_are_still_shown_but_not_below_themselves() -> None:
    blueprint = read(
        {
            "A": {"HEADER": {"SUB_SBS": {"B": 0}}, "State0": {}, "State1": {}},
            "B": {"HEADER": {"SUB_SBS": {"A": 0}}, "State0": {}, "State1": {}},
        }
    )
    names = [line.text for _, line in lines_of(blueprint) if line.digit is None]
    assert names == ["A", "B", "B", "A"]


def test_an_sb_without_states_has_no_facts() -> None:
    assert [line.text for _, line in lines_of(read({"A": {"HEADER": {}}}))] == ["A"]


def test_an_sb_without_states_shows_the_facts_that_its_header_plans() -> None:
    header = {"NUM_FACTS": 10**9, "SUB_SBS": {"B": 0, "C": 500}}
    one: dict[str, Any] = {"State0": {}, "State1": {}}
    lines = lines_of(read({"A": {"HEADER": header}, "B": one, "C": one}))
    digits = [line.digit for _, line in lines if line.branch == "A"]
    assert digits == [None, *range(MOST_PLANNED), 500]
    # No sub-SB is hidden because its base has lost its states.
    assert [(above, line.branch) for above, line in lines if line.text in "BC"] == [
        (2, "B"), (2, "C"),
    ]  # fmt: skip


def test_imports_that_failed_stand_at_the_end_with_the_files_that_led_there(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text('{"_imports": ["b.json", "gone.json"], "A": {"S_0": {}}}')
    (tmp_path / "b.json").write_text('{"_imports": ["a.json"], "B": {"S_0": {}}}')
    blueprint = read_blueprint(read_document(tmp_path / "a.json"))
    lines = [line for _, line in lines_of(blueprint)]
    assert [(line.text, line.home) for line in lines if line.branch and line.digit is None] == [
        ("A", ""), ("B", "b.json"),
    ]  # fmt: skip
    assert str(tmp_path / "b.json") in lines[2].tip
    failed = [(line.text, line.right, line.tip.split(". ")[-1]) for line in lines if line.fault]
    assert sorted(failed) == [
        ("a.json", "cycle", "a.json > b.json > a.json"),
        ("gone.json", "not read", "a.json > gone.json"),
    ]


def test_a_chain_of_more_levels_than_are_shown_goes_on_at_the_margin() -> None:
    blueprint = made("sub_chain", 10 * DEEPEST)
    lines = lines_of(blueprint)
    assert max(above for above, _ in lines) == 2 * DEEPEST
    facts = [line.branch for _, line in lines if line.digit is not None]
    assert facts == list(blueprint.branches)
    begun = [line for above, line in lines if above == 0]
    assert [line.text for line in begun] == [f"B{n}" for n in range(0, 10 * DEEPEST + 1, DEEPEST)]
    assert [line.right for line in begun] == [line.text[1:] for line in begun]


@pytest.mark.parametrize(
    "name", ["sub_chain", "sub_diamonds", "sub_cycle", "sub_cycles", "shared_sub", "known_subs"]
)
def test_every_sb_and_fact_is_found_however_many_ways_lead_there(name: str) -> None:
    """Two to the power of 200 ways lead down the diamonds, and only one is gone."""
    blueprint = made(name, 200)
    nodes = OutlineNodes(blueprint)
    for branch in blueprint:
        for digit in (None, *range(branch.num_facts)):
            node = nodes.first((branch.name, digit))
            assert node is not None
            assert node.key == (branch.name, digit)
    # The lines that stand beside those ways are made with them.
    facts = sum(branch.num_facts for branch in blueprint)
    assert nodes.made <= 2 * (facts + len(blueprint.branches))


def test_what_is_not_there_is_not_found() -> None:
    nodes = OutlineNodes(read_blueprint(read_document(SAMPLES / "hfsm.json")))
    wrong = [("SB3", None), ("SB3", 0), ("SB1", 7), ("SB1", -1), ("", 0)]
    assert [nodes.first(key) for key in wrong] == [None] * len(wrong)


@pytest.mark.parametrize("name", ["sub_cycles", "shared_sub", "sub_chain", "sub_diamonds"])
def test_lines_that_nobody_asks_for_are_not_made(name: str) -> None:
    blueprint = made(name, 200)
    subs = sum(len(branch.subs) for branch in blueprint)
    assert steps(lambda: OutlineNodes(blueprint)) <= 20 * (len(blueprint.branches) + subs)
    nodes = OutlineNodes(blueprint)
    assert nodes.made == 0
    assert "shape" not in next(reversed(list(blueprint))).__dict__


def test_sub_sbs_that_several_share_stand_below_each_of_them() -> None:
    lines = lines_of(made("sub_diamonds", 3))
    assert [line.text for _, line in lines if line.digit is None].count("l2") == 4


def made(name: str, count: int) -> Blueprint:
    text = BY_NAME[name].make("json", count)
    return read_blueprint(parse_bytes(text.encode(), "large.json"))
