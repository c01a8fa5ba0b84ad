"""Names that look alike: one finding for each cause, and none for names with different fact
values."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.smsl.json_form import parse_json


def alike(values: dict[str, Any]) -> tuple[Finding, ...]:
    return inspect(read_blueprint(parse_json(json.dumps(values), "f.json")), ["R09"])


def chess(header: dict[str, int], name: str, operation: str) -> dict[str, Any]:
    """One piece on the blocks of a board; those of the other side have capital letters."""
    blocks = ("a", "A", "b", "B", "c", "C")
    table = {
        name.format(here): {operation.format(here, there): name.format(there) for there in blocks}
        for here in blocks
    }
    return {"CHESS": {"HEADER": header, **table}}


@pytest.mark.parametrize(
    ("header", "name", "operation"),
    [
        ({"NUM_FACTS": 1}, "State_{}", "move-{}-to-{}"),
        ({"NUM_FACTS": 1}, "State_{}", "move-star-chess-from-{0}2-to-{1}"),
        ({"NUM_FACTS": 2}, "State_0{}", "Op_1{1}"),
        ({"NUM_FACTS": 2}, "State_blk{0}blk{0}", "move blk{} to blk{}"),
        ({}, "State{}", "{}/{}"),
    ],
)
def test_what_a_fact_value_tells_apart_is_no_look_alike(
    header: dict[str, int], name: str, operation: str
) -> None:
    assert alike(chess(header, name, operation)) == ()


def test_facts_that_are_given_in_states_tell_names_apart_too() -> None:
    states = {"on-a": {"go-A": "on-A"}, "on-A": {"go-a": "on-a"}}
    facts = {"on-a": {"facts": ["a"]}, "on-A": {"facts": ["A"]}}
    assert alike({"SB": {**states, "_states": facts}}) == ()
    assert len(alike({"SB": states})) == 2


def test_case_elsewhere_in_a_name_is_one_finding_with_its_places() -> None:
    table = chess({"NUM_FACTS": 1}, "State_{}", "move-{}-to-{}")["CHESS"]
    for here in ("a", "b", "c"):
        table[f"State_{here}"] |= {f"Move-{here}-to-b": "State_b", f"Move-{here}-to-c": "State_c"}
    (finding,) = alike({"CHESS": table})
    assert finding.message == "the operation Move-a-to-b differs from move-a-to-b only by case"
    assert 1 + len(finding.others) == 6


def test_each_pair_of_characters_is_a_cause_of_its_own() -> None:
    names = [f"{word}{n}" for word in ("alp", "bet") for n in ("0x", "Ox", "1x", "lx")]
    found = alike({"SB": {name: {"go": name} for name in names}})
    assert [1 + len(one.others) for one in found] == [2, 2]
    assert all(one.message.endswith("only by characters that look alike") for one in found)


def test_values_that_cannot_be_told_by_eye_are_still_told() -> None:
    """A Cyrillic letter beside the Latin one, and a zero beside an O."""
    (cyrillic,) = alike({"SB": {"State_a": {"go": "State_а"}, "State_а": {"back": "State_a"}}})
    assert "characters that look alike" in cyrillic.message
    (zero,) = alike({"SB": {"State_0": {"go": "State_O"}, "State_O": {"back": "State_0"}}})
    assert "characters that look alike" in zero.message


def test_names_of_sbs_have_no_facts() -> None:
    pair = {"State_a": {"go": "State_A"}, "State_A": {"go": "State_a"}}
    (finding,) = alike({"Arm-a": pair, "Arm-A": pair})
    assert str(finding.address) == "Arm-A"
