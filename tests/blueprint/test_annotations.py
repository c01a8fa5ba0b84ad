"""Annotations are parsed to typed values; values of a wrong type are reported."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address, fact_text, note_key, split_fact
from smsl_studio.blueprint.annotations import read_hazards
from smsl_studio.blueprint.meaning import hazards_meaning
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.notes import Notes, read_notes
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json


def branch(**fields: Any) -> StateBranch:
    values = {"A": {"S0": {"o": "S1", "a/b": "S1"}, "S1": {"o": "S0"}, **fields}}
    return read_blueprint(parse_json(json.dumps(values), "f"))["A"]


def test_the_note_of_an_edge_overrides_that_of_its_name() -> None:
    notes = {"o": {"cost": 3, "title": "go"}, "S0/o": {"cost": 5}, "a~1b": {"risk": "high"}}
    noted = branch(_operations=notes)
    assert (noted.cost("S0", "o"), noted.cost("S1", "o"), noted.cost("S0", "a/b")) == (5, 3, 1)
    assert noted.operation_note("S0", "o").title == "go"
    assert noted.operation_note("S0", "a/b").risk == "high"
    assert branch().operation_note("S0", "o").subs == "drive"
    assert branch().cost("S0", "o") == 1


def test_an_edge_can_set_back_what_its_name_says() -> None:
    notes = {"o": {"repeatable": True}, "S0/o": {"repeatable": False}}
    noted = branch(_operations=notes)
    assert not noted.operation_note("S0", "o").repeatable
    assert noted.operation_note("S1", "o").repeatable


ODD_LINES: tuple[Any, ...] = (
    [[1, 2]],
    {"bend": [[1, 2]]},
    {"bends": {}},
    {"bends": [1, 2]},
    {"bends": [[1, 2, 3]]},
    {"bends": [[1, True]]},
    {"bends": [[1, "2"]]},
    {"bends": [[1e300, 2]]},
    {"bends": [[float("nan"), 2]]},
    {"bends": [[1, 2]] * 41},
    {"label": 0.5},
    {"label": [0.5, 1]},
    {"label": [1.01, 1, 1]},
    {"label": [-0.1, 1, 1]},
    {"label": [0.5, 1, 2001]},
    {"label": [0.5, float("inf"), 1]},
    {"label": [0.5, None, 1]},
)
"""Lines of operations that do not fit."""


@pytest.mark.parametrize(
    ("fields", "path"),
    [
        ({"_facts": {"0": {"nam": "x"}}}, ("_facts", "0")),
        ({"_facts": {"first": {"name": "x"}}}, ("_facts", "first")),
        ({"_facts": []}, ("_facts",)),
        ({"_states": {"S0": {"safe": "perhaps"}}}, ("_states", "S0")),
        ({"_operations": {"o": {"cost": -1}}}, ("_operations", "o")),
        ({"_operations": {"o": {"cost": 1e300}}}, ("_operations", "o")),
        ({"_operations": {"o": {"cost": True}}}, ("_operations", "o")),
        ({"_operations": {"o": {"timeout": "5"}}}, ("_operations", "o")),
        ({"_operations": {"o": {"touches": [False]}}}, ("_operations", "o")),
        ({"_operations": {"o": {"repeatable": 1}}}, ("_operations", "o")),
        ({"_facts": {"0": {"k": True}}}, ("_facts", "0")),
        ({"_states": {"S0": {"safe": "yes"}}}, ("_states", "S0")),
        ({"_operations": {"o": {"subs": "both"}}}, ("_operations", "o")),
        ({"_operations": {"o": "words"}}, ("_operations", "o")),
        ({"_layout": {"S0": [1]}}, ("_layout", "S0")),
        ({"_layout": {"S0": [1, True]}}, ("_layout", "S0")),
        ({"_layout": {"S0": [1, 1e300]}}, ("_layout", "S0")),
        ({"_layout": {"_operations": [1, 2]}}, ("_layout", "_operations")),
        *(
            ({"_layout": {"_operations": {"S0/o": odd}}}, ("_layout", "_operations", "S0/o"))
            for odd in ODD_LINES
        ),
        *(
            (
                {"_layout": {"_operations": {key: {"bends": [[1, 2]]}}}},
                ("_layout", "_operations", key),
            )
            for key in ("o", "", "S0/", "S0/o/o")
        ),
    ],
)
def test_what_does_not_fit_is_left_out_and_reported(
    fields: dict[str, Any], path: tuple[str, ...]
) -> None:
    notes = read_notes(fields)
    assert [where for where, _ in notes.faults] == [path]
    assert replace(notes, faults=()) == Notes()


def test_a_word_that_does_not_fit_takes_no_other_along() -> None:
    """A slip in a cost must not open a gate that ``requires`` keeps shut."""
    raw = {"cost": "dear", "requires": {"A/0": "1"}, "colour": "red"}
    notes = read_notes({"_operations": {"o": raw}, "_facts": {"0": {"on": 1, "name": "Lit"}}})
    assert notes.operations["o"].requires == {"A/0": "1"}
    assert notes.operations["o"].cost is None
    assert notes.written["o"] == {"requires"}
    assert notes.facts[0].name == "Lit"
    assert sorted(sentence.partition(":")[0] for _, sentence in notes.faults) == [
        "colour", "cost", "on"
    ]  # fmt: skip


def test_hazards_name_facts_that_must_not_hold_together() -> None:
    raw = [{"name": "both", "facts": {"A/0": "1", "B/1": "1"}}, {"name": 5}]
    hazards, faults = read_hazards(raw)
    assert [hazard.name for hazard in hazards] == ["both"]
    assert faults
    slip = {"name": "both", "facts": {"A/0": "1"}, "colour": "red"}
    assert [hazard.facts for hazard in read_hazards([slip])[0]] == [{"A/0": "1"}]
    assert hazards_meaning([slip]) != hazards_meaning([{**slip, "colour": "blue"}])
    assert read_hazards(None) == ((), ())
    assert read_hazards({})[1]


@pytest.mark.parametrize("name", ["SB1", "a/b", "~1", "/", "x/0", "~"])
def test_written_facts_and_edges_are_read_back_for_any_names(name: str) -> None:
    assert split_fact(fact_text(name, 12)) == (name, 12)
    assert Address.split(note_key(name)) == (name,)
    assert Address.split(note_key("o/p", name)) == (name, "o/p")


@pytest.mark.parametrize("text", ["", "A", "A/", "/0", "A/x", "A/-1", "A/²", "A/" + "9" * 99])
def test_what_is_no_written_fact_is_none(text: str) -> None:
    assert split_fact(text) is None
