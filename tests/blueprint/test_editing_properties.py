"""The edit of ``_properties``: what it writes, and what it refuses."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.completion import offers_at
from smsl_studio.blueprint.properties.property import properties_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.json_form import parse_json

A = {"_facts": {"0": {"name": "on"}}, "State_0": {"go": "State_1"}, "State_1": {}}
B = {"State_a": {"go": "State b"}, "State b": {}}
GOOD = {"name": "p", "never": 'A/"on" = 1'}


def written(**fields: Any) -> Blueprint:
    return read_blueprint(parse_json(json.dumps({**fields, "A": A, "B": B}, indent=1), "p.json"))


def test_properties_are_set_and_removed() -> None:
    before = written()
    after = edit.set_properties(before, [GOOD])
    assert [one.name for one in properties_of(after)] == ["p"]
    assert read_blueprint(parse_json(after.document.text, "p.json")) == after
    assert edit.set_properties(after, []) == before


@pytest.mark.parametrize(
    ("odd", "words"),
    [
        ({"name": "p"}, "it has none of the kinds"),
        ({"name": "p", "never": "A/0 ="}, "a value is expected"),
        ({"name": "p", "never": "A/0 = 7"}, "never has the value 7"),
        ({"name": "p", "never": "C = 1"}, "there is no SB C"),
        ({"name": "p", "cost": {"goal": "A/State_9", "limit": 1}}, "State_9"),
        ({"name": "q", "never": "A = 1"}, "the name is used twice"),
    ],
)
def test_what_cannot_be_read_is_refused(odd: dict[str, Any], words: str) -> None:
    before = written(_properties=[{"name": "q", "never": "A = 0"}])
    with pytest.raises(EditRefused, match=words):
        edit.set_properties(before, [before.document.values["_properties"][0], odd])


def test_an_odd_one_that_was_there_stays() -> None:
    odd = {"name": "odd", "never": "C = 1"}
    before = written(_properties=[odd])
    after = edit.set_properties(before, [odd, GOOD])
    assert after.document.values["_properties"] == [odd, GOOD]


def test_a_value_that_is_no_list_is_refused() -> None:
    with pytest.raises(EditRefused, match="is no list"):
        edit.set_properties(written(_properties=3), [GOOD])


@pytest.mark.parametrize(
    ("typed", "start", "offered"),
    [
        ("", 0, ['A/"on"', "B/0", "A in", "B in", "not", "("]),
        ("o", 0, ['A/"on"', "not"]),
        ('A/"', 0, ['A/"on"']),
        ('A/"on" ', 7, ["=", "!=", "in"]),
        ('A/"on" = ', 9, ["0", "1"]),
        ('A/"on" = 1', 9, []),
        ('A/"on" = 1 ', 11, ["and", "or"]),
        ('A/"on" = 1 and b', 15, ["B/0", "B in"]),
        ("B in ", 5, ["State_a", "'State b'"]),
        ("B in 'st", 5, ["State_a", "'State b'"]),
        ("not (B != ", 10, ["'State b'", "State_a"]),
        ("C = ", 4, []),
    ],
)
def test_names_values_and_words_are_offered(typed: str, start: int, offered: list[str]) -> None:
    found = offers_at(typed, len(typed), written())
    assert list(found.texts) == offered
    assert found.start == start
