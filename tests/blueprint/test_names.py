"""Fresh names follow the pattern of the existing names."""

from __future__ import annotations

import json
from itertools import count

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.names import (
    FreeNames,
    fresh_branch_name,
    fresh_operation_name,
    fresh_state_name,
)
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of


def branch(states: dict[str, dict[str, str]], header: dict[str, int] | None = None) -> StateBranch:
    values = {"A": {"HEADER": header or {}, **states}}
    return read_blueprint(parse_json(json.dumps(values), "f"))["A"]


@pytest.mark.parametrize(
    ("states", "num_facts", "expected"),
    [
        ([], None, "State0"),
        ([], 3, "State000"),
        (["State0"], None, "State1"),
        (["State000", "State100"], 3, "State001"),
        (["State_00", "State_01", "State_10"], None, "State_11"),
        (["State_aa", "State_ab"], None, "State_ba"),
        (["chess_0a1b"], 2, "chess_0a0a"),
        (["Idle", "Working"], None, "State1"),
        (["Idle", "State1"], None, "State2"),
        (["Idle"], None, "State1"),
        (["Idle", "Busy"], None, "State1"),
        (["State0", "State1"], None, "State2"),
    ],
)
def test_a_state_gets_the_prefix_and_unused_facts(
    states: list[str], num_facts: int | None, expected: str
) -> None:
    header = {"NUM_FACTS": num_facts} if num_facts else {}
    assert fresh_state_name(branch({name: {} for name in states}, header)) == expected


def test_a_missing_state_of_a_regular_sb_is_the_one_proposed() -> None:
    full = hanoi(2)["SB1"]
    without: dict[str, dict[str, str]] = {name: {} for name in full.table if name != "State_bc"}
    assert fresh_state_name(branch(without)) == "State_bc"


def test_an_operation_is_named_after_its_state() -> None:
    one = branch({"State000": {}, "State100": {"Operation100": "State000"}})
    assert fresh_operation_name(one, "State000") == "Operation000"
    assert fresh_operation_name(one, "State100") == "Operation100A"
    lettered = branch({"State100": {"Operation100A": "State100"}})
    assert fresh_operation_name(lettered, "State100") == "Operation100B"
    op = branch({"State_aa": {"Op_1b": "State_ba"}, "State_ba": {}})
    assert fresh_operation_name(op, "State_ba") == "Op_ba"
    many = {f"Operation0{letter}": "State0" for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ"}
    assert fresh_operation_name(branch({"State0": many}), "State0") == "Operation01"


def test_an_sb_gets_the_next_number() -> None:
    blueprint = read_blueprint(parse_json('{"SB1": {}, "SB3": {}}', "f"))
    assert fresh_branch_name(blueprint) == "SB2"


NAMES = st.sampled_from(["a", "a1", "a2", "a3", "a5", "a9", "a10", "a11", "b01", "b02", "b"])


@settings(max_examples=share_of(50), deadline=None)
@given(st.sets(NAMES), st.lists(NAMES, max_size=30))
def test_each_name_is_the_next_free_one_like_it(taken: set[str], wanted: list[str]) -> None:
    names = FreeNames(taken)
    for name in wanted:
        stem = name.rstrip("0123456789")
        width = len(name) - len(stem)
        first = int(name[len(stem) :]) + 1 if width else 2
        free = (one for n in count(first) if (one := f"{stem}{n:0{width}}") not in taken)
        expected = next(free) if name in taken else name
        assert names.take(name) == expected
        taken.add(expected)
