"""Properties follow edits: names change in their texts, and every other character stays."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import Formula, read_formula
from smsl_studio.blueprint.properties.follow import followed
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.front.inputs import inspect
from smsl_studio.smsl.json_form import parse_json
from tests.blueprint.properties.drawn import formulas, written

BRANCHES = {
    "A": {
        "State_00": {"Up": "State_10"},
        "State_10": {"Up": "State_11", "Down": "State_00"},
        "State_11": {"Down": "State_10"},
        "_facts": {"1": {"name": "Clamp fixed"}},
    },
    "B": {"State_x": {"Up": "State_y"}, "State_y": {}},
}
SENTENCES: list[dict[str, Any]] = [
    {"never": "  A/0=1   and not (A in State_11 or B = x)"},
    {"before": ['A/"Clamp fixed" != 1', "B in 'State_y'"]},
    {"way_back": {"from": "A/1 = 1", "to": "A/0 = 0", "within": 3}},
    {"at_most": {"operation": "A/Up", "times": 1}},
    {"at_most": {"operation": "Down", "times": 1}},
    {"cost": {"goal": "A/State_11", "limit": 2}},
    {"never": "cannot be read ="},
]
PROPERTIES = [{"name": f"p{n}", **one} for n, one in enumerate(SENTENCES)]


def blueprint() -> Blueprint:
    text = json.dumps({"_properties": PROPERTIES, **BRANCHES}, indent=1)
    return read_blueprint(parse_json(text, "file.json"))


def texts(after: Blueprint) -> list[Any]:
    """The values of the kinds, in the order of the file. All that could be read still can be."""
    (fault,) = inspect(after, ["R29"])
    assert "p6" in str(fault.address)
    found = after.document.values["_properties"]
    return [one[kind] for one in found for kind in one if kind != "name"]


BEFORE = [one[kind] for one in SENTENCES for kind in one]


def changed(after: Blueprint) -> dict[int, Any]:
    return {n: one for n, one in enumerate(texts(after)) if one != BEFORE[n]}


def test_a_renamed_sb_is_renamed_in_each_sentence() -> None:
    after = editing.rename(blueprint(), Address("A"), "two words")
    assert changed(after) == {
        0: "  'two words'/0=1   and not ('two words' in State_11 or B = x)",
        1: ["'two words'/\"Clamp fixed\" != 1", "B in 'State_y'"],
        2: {"from": "'two words'/1 = 1", "to": "'two words'/0 = 0", "within": 3},
        3: {"operation": "two words/Up", "times": 1},
        5: {"goal": "two words/State_11", "limit": 2},
    }
    # As digits alone the name would be that of a fact.
    again = editing.rename(blueprint(), Address("B"), "0")
    assert changed(again)[0] == "  A/0=1   and not (A in State_11 or '0' = x)"


def test_a_renamed_state_and_operation_are_renamed() -> None:
    after = editing.rename(blueprint(), Address("A", "State_11"), "State11")
    assert changed(after) == {
        0: "  A/0=1   and not (A in State11 or B = x)",
        5: {"goal": "A/State11", "limit": 2},
    }
    edge = Address("A", "State_00", "Up")
    assert changed(editing.rename(blueprint(), edge, "Rise")) == {}
    everywhere = editing.rename(blueprint(), edge, "Rise", True)
    assert changed(everywhere) == {3: {"operation": "A/Rise", "times": 1}}
    down = editing.rename(blueprint(), Address("A", "State_10", "Down"), "Sink", True)
    assert changed(down) == {4: {"operation": "Sink", "times": 1}}


def test_a_renamed_value_is_renamed_where_its_fact_is_named() -> None:
    after = editing.rename_value(blueprint(), "A", 1, "1", "y")
    assert changed(after) == {
        0: "  A/0=1   and not (A in State_1y or B = x)",
        1: ['A/"Clamp fixed" != y', "B in 'State_y'"],
        2: {"from": "A/1 = y", "to": "A/0 = 0", "within": 3},
        5: {"goal": "A/State_1y", "limit": 2},
    }


def test_a_moved_fact_keeps_its_sentences() -> None:
    after = editing.move_fact(blueprint(), "A", 1, 0)
    assert changed(after)[2] == {"from": "A/0 = 1", "to": "A/1 = 0", "within": 3}
    assert changed(after)[0] == "  A/1=1   and not (A in State_11 or B = x)"
    assert 1 not in changed(after)


@pytest.mark.parametrize(
    "edit",
    [
        lambda one: editing.delete(one, [Address("B")]),
        lambda one: editing.delete_fact(one, "A", 1),
        lambda one: editing.delete_fact(one, "A", 0),
    ],
)
def test_what_a_property_speaks_of_is_not_deleted(edit: Any) -> None:
    with pytest.raises(EditRefused, match="the property 'p"):
        edit(blueprint())


@given(formulas)
def test_a_text_that_follows_nothing_keeps_its_bytes(formula: Formula) -> None:
    text = written(formula)
    assert followed(text, lambda term: term) == text
    back = followed(followed(text, _turned), _turned)
    assert read_formula(back) == formula


def _turned(term: Any) -> Any:
    """The comparison with the names of SBs turned round."""
    from dataclasses import replace

    return replace(term, branch=term.branch[::-1])
