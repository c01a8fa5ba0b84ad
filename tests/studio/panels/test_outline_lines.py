"""The lines of the outline: levels, facts, sub-SBs, marks; and what is odd is still shown."""

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
from smsl_studio.studio.panels.outline_lines import DEEPEST, FULL, lines_of, marked, worst_of
from tests.bombs.table import BY_NAME

SAMPLES = Path(__file__).parents[3] / "samples"


def read(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), "a.json"))


def test_sub_sbs_stand_below_their_fact_one_level_down() -> None:
    blueprint = read_blueprint(read_document(SAMPLES / "hfsm.json"))
    lines = marked(lines_of(blueprint), worst_of(inspect(blueprint)))
    assert [(line.depth, line.text, line.right) for line in lines] == [
        (0, "SB1", "0"), (1, "Fact 1", ""), (1, "Fact 2", ""), (2, "SB2", "1"),
        (3, "Fact 1", ""), (1, "Fact 3", ""),
    ]  # fmt: skip
    assert lines[0].severity == "W"
    assert [line.sub for line in lines] == [False, False, True, False, False, False]


def test_values_beyond_0_and_1_are_named() -> None:
    blueprint = read_blueprint(read_document(SAMPLES / "hanoi.json"))
    lines = marked(lines_of(blueprint), worst_of(inspect(blueprint)))
    assert lines[0].severity == "E"
    assert [line.right for line in lines[1:]] == ["a b c"] * 3


def test_sbs_in_a_cycle_are_still_shown() -> None:
    blueprint = read(
        {
            "A": {"HEADER": {"SUB_SBS": {"B": 0}}, "State0": {}, "State1": {}},
            "B": {"HEADER": {"SUB_SBS": {"A": 0}}, "State0": {}, "State1": {}},
        }
    )
    names = [line.text for line in lines_of(blueprint) if line.digit is None]
    assert set(names) == {"A", "B"}


def test_an_sb_without_states_has_no_facts() -> None:
    assert [line.text for line in lines_of(read({"A": {"HEADER": {}}}))] == ["A"]


def test_imports_that_failed_stand_at_the_end_with_the_files_that_led_there(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text('{"_imports": ["b.json", "gone.json"], "A": {"S_0": {}}}')
    (tmp_path / "b.json").write_text('{"_imports": ["a.json"], "B": {"S_0": {}}}')
    lines = lines_of(read_blueprint(read_document(tmp_path / "a.json")))
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
    assert max(line.depth for line in lines) == 2 * DEEPEST
    facts = [line.branch for line in lines if line.digit is not None]
    assert facts == list(blueprint.branches)
    begun = [line for line in lines if line.depth == 0]
    assert [line.text for line in begun] == [f"B{n}" for n in range(0, 10 * DEEPEST + 1, DEEPEST)]
    assert [line.right for line in begun] == [line.text[1:] for line in begun]


@pytest.mark.parametrize("name", ["sub_diamonds", "sub_cycle", "sub_cycles", "shared_sub"])
def test_what_would_be_shown_again_and_again_is_opened_once(name: str) -> None:
    """Two to the power of 200 ways lead down the diamonds."""
    blueprint = made(name, 200)
    lines = lines_of(blueprint)
    named = [(line.branch, line.digit) for line in lines if line.digit is not None]
    assert {branch for branch, _ in named} == set(blueprint.branches)
    subs = sum(len(branch.subs) for branch in blueprint)
    assert len(lines) <= FULL + len(set(named)) + subs + len(blueprint.branches)


def test_sub_sbs_that_few_share_stand_below_each_of_them() -> None:
    lines = lines_of(made("sub_diamonds", 3))
    assert [line.text for line in lines if line.digit is None].count("l2") == 4


def made(name: str, count: int) -> Blueprint:
    text = BY_NAME[name].make("json", count)
    return read_blueprint(parse_bytes(text.encode(), "large.json"))
