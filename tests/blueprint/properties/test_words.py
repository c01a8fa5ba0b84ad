"""Hazards and properties in plain words."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.property import read_properties
from smsl_studio.blueprint.properties.words import LONGEST, hazard_words, property_words
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json

FILE = """{
 "DRILL": {"_facts": {"0": {"name": "drill running"}},
           "State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}},
 "REG": {"_facts": {"0": {"name": "registered"}, "1": {"name": "fixed"}},
         "State_00": {"go": "State_11"}, "State_11": {}},
 "BED": {"_facts": {"0": {"name": "fixed"},
                    "1": {"name": "height", "values": {"h": "high"}}},
         "State_0l": {"go": "State_1h"}, "State_1h": {}},
 "PEG": {"State_a": {"go": "State_b"}, "State_b": {}}
}"""


ROUTE = "The cheapest route"


@pytest.fixture
def blueprint() -> Blueprint:
    return read_blueprint(parse_json(FILE, "words.json"))


def said(blueprint: Blueprint, **fields: Any) -> str:
    found, faults = read_properties([{"name": "one", **fields}])
    assert not faults
    return property_words(found[0], blueprint)


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ('DRILL/0 = 1 and REG/"registered" = 0', "drill running while not registered"),
        ("DRILL != 1 and REG/0 != 0", "not drill running while registered"),
        ("not DRILL = 1", "not drill running"),
        ('REG/1 = 1 and BED/"fixed" = 0', "fixed of REG while not fixed of BED"),
        ("BED/1 = h", "height is high"),
        ("BED/1 != l", "height is not l"),
        ("PEG = a", "PEG is a"),
        ("not PEG in State_a", "PEG is not in State_a"),
        ("PEG = a or PEG = b", "PEG is a or PEG is b"),
        ("DRILL = 1 and REG/0 = 1 and PEG = a", "drill running while registered and PEG is a"),
        ("DRILL = 1 and (PEG = a or PEG = b)", "drill running while (PEG is a or PEG is b)"),
        ("not (DRILL = 1 and PEG = a)", "not (drill running and PEG is a)"),
        ("NO/3 = 1", "NO/3 is 1"),
        ('REG/"gone" != 1', "REG/gone is not 1"),
    ],
)
def test_a_condition_is_said(blueprint: Blueprint, formula: str, words: str) -> None:
    assert said(blueprint, never=formula) == f"Never: {words}"


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"before": ["REG/0 = 1", "DRILL = 1"]}, "First registered, only then drill running"),
        (
            {"after": ["DRILL = 1", "PEG = a"]},
            "After drill running: every way to the goal passes PEG is a",
        ),
        (
            {"way_back": {"from": "DRILL = 1", "to": "DRILL = 0", "within": 3}},
            "From drill running: there is always a way to not drill running, in at most 3 steps",
        ),
        (
            {"way_back": {"from": "PEG = a and DRILL = 1", "to": "PEG = b"}},
            "From PEG is a and drill running: there is always a way to PEG is b",
        ),
        ({"reachable": "PEG = b"}, "Possible: PEG is b"),
        ({"at_most": {"operation": "g*", "times": 1}}, f"{ROUTE} carries out g* at most once"),
        ({"at_most": {"operation": "go", "times": 0}}, f"{ROUTE} carries out go never"),
        (
            {"cost": {"goal": "PEG/State_b", "limit": 12.5}},
            "The cheapest route to PEG/State_b costs at most 12.5",
        ),
    ],
)  # fmt: skip
def test_each_kind_is_said(blueprint: Blueprint, fields: dict[str, Any], words: str) -> None:
    assert said(blueprint, **fields) == words


def test_a_hazard_is_said_like_never(blueprint: Blueprint) -> None:
    facts = {"DRILL/0": "1", "REG/0": "0"}
    assert hazard_words(facts, blueprint) == "Never: drill running while not registered"
    unknown = {"NO/0": "1", "PEG/9": "a"}
    assert hazard_words(unknown, blueprint) == "Never: NO/0 is 1 while PEG/9 is a"
    assert hazard_words({}, blueprint) == "Never: "


def test_a_long_sentence_is_cut(blueprint: Blueprint) -> None:
    words = said(blueprint, never=" and ".join(["PEG = a"] * 1000))
    assert len(words) == LONGEST
    assert words.endswith("…")
