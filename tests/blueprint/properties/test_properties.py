"""``_properties``: what is read, what cannot be read, and what the digests cover."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties import read_formula
from smsl_studio.blueprint.properties.property import (
    Property,
    properties_of,
    read_properties,
    texts_of,
)
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.inputs import inspect
from smsl_studio.smsl.json_form import parse_json

F, G = "SB/0 = 0", "SB in State_1"
ONE, TWO = read_formula(F), read_formula(G)
SB = {"State_0": {"Up": "State_1"}, "State_1": {"Down": "State_0"}}
GOOD: list[tuple[dict[str, Any], Property]] = [
    ({"never": F}, Property("p", "never", formulas=(ONE,))),
    ({"before": [F, G]}, Property("p", "before", formulas=(ONE, TWO))),
    ({"after": [F, G], "severity": "W"}, Property("p", "after", "W", formulas=(ONE, TWO))),
    ({"way_back": {"from": F, "to": G}}, Property("p", "way_back", formulas=(ONE, TWO))),
    (
        {"way_back": {"from": F, "to": G, "within": 0}, "why": "for people"},
        Property("p", "way_back", why="for people", formulas=(ONE, TWO), within=0),
    ),
    ({"reachable": F, "_comment": 3}, Property("p", "reachable", formulas=(ONE,))),
    (
        {"at_most": {"operation": "U?", "times": 2}},
        Property("p", "at_most", operation="U?", times=2),
    ),
    ({"cost": {"goal": "SB/State_1", "limit": 2.5}}, Property("p", "cost", goal="SB/State_1",
                                                              limit=2.5)),
]  # fmt: skip


def blueprint(properties: Any, **more: Any) -> Blueprint:
    text = json.dumps({"_properties": properties, "SB": SB, **more}, indent=1)
    return read_blueprint(parse_json(text, "file.json"))


def found(properties: Any, **more: Any) -> list[tuple[str, str, str]]:
    """Severity, address and message of each finding of R29."""
    told = inspect(blueprint(properties, **more), ["R29"])
    return [(one.severity.value, str(one.address), one.message) for one in told]


@pytest.mark.parametrize(("written", "wanted"), GOOD)
def test_each_kind_is_read(written: dict[str, Any], wanted: Property) -> None:
    properties = [{"name": "p", **written}]
    assert properties_of(blueprint(properties)) == (wanted,)
    assert found(properties) == []
    # The keys that lead to a text are those of the file.
    for formula, keys in texts_of(wanted):
        value: Any = properties[0]
        for key in keys:
            value = value[int(key) if isinstance(value, list) else key]
        assert read_formula(value) == formula


@pytest.mark.parametrize(
    ("written", "words", "column"),
    [
        (3, "a property is an object", "3"),
        ({"name": "p"}, "it has none of the kinds", "{"),
        ({"name": "p", "never": F, "reachable": F}, "it has never and reachable of the", "{"),
        ({"name": "p", "nevr": F}, "nevr is no key of a property", '"nevr"'),
        ({"never": F}, "name must be a text", "{"),
        ({"name": "", "never": F}, "name must be a text", '"name"'),
        ({"name": "p", "severity": "I", "never": F}, "severity is E or W", '"severity"'),
        ({"name": "p", "never": 3}, "a condition must be a text", '"never"'),
        ({"name": "p", "never": "SB ="}, "character 5: a value is expected", '"never"'),
        ({"name": "p", "before": [F]}, "before must be a list of two conditions", '"before"'),
        ({"name": "p", "after": [F, "x y"]}, "character 3: '=', '!=' or 'in'", '"x y"'),
        ({"name": "p", "way_back": F}, "way_back must be an object with from, to", '"way_back"'),
        ({"name": "p", "way_back": {"from": F}}, "way_back has no to", '"way_back"'),
        (
            {"name": "p", "way_back": {"from": F, "to": G, "within": -1}},
            "within must be a whole number from 0 up",
            '"within"',
        ),
        (
            {"name": "p", "at_most": {"operation": "Up", "times": True}},
            "times must be a whole number",
            '"times"',
        ),
        ({"name": "p", "at_most": {"operation": "Upp", "times": 1}}, "no operation is called Upp",
         '"operation"'),
        ({"name": "p", "cost": {"goal": "SB/State_1", "limit": 1, "most": 2}},
         "most is no key of cost", '"most"'),
        ({"name": "p", "cost": {"goal": "SB/State_2", "limit": 1}}, "State_2", '"goal"'),
        ({"name": "p", "cost": {"goal": "SB", "limit": 1}}, "the goal SB is no state", '"goal"'),
        ({"name": "p", "never": "SB/1 = 0"}, "SB has 1 facts, so 1 is none", '"never"'),
        ({"name": "p", "never": "SB = 2"}, "Fact 1 of SB never has the value 2", '"never"'),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_an_error_at_its_key(written: Any, words: str, column: str) -> None:
    whole = blueprint([written])
    (finding,) = inspect(whole, ["R29"])
    assert words in finding.message
    assert finding.severity.value == "E"
    named = isinstance(written, dict) and written.get("name")
    assert str(finding.address) == ("_properties/p" if named else "_properties")
    line = whole.document.text.splitlines()[finding.place.line - 1]
    assert line[finding.place.column - 1 :].startswith(column)


def test_a_list_is_needed_and_a_name_counts_once() -> None:
    ((severity, address, words),) = found({"name": "p", "never": F})
    assert (severity, address) == ("E", "_properties")
    assert "_properties must be a list" in words
    ((_, address, words),) = found([{"name": "p", "never": F}, {"name": "p", "reachable": G}])
    assert (address, "the name is used twice" in words) == ("_properties/p", True)
    assert len(read_properties([{"name": "p", "never": F}] * 2)[0]) == 1


def test_values_that_only_sensors_read_are_known() -> None:
    note = {"_facts": {"0": {"values": {"x": "jammed"}, "failure": ["y"]}}, **SB}
    for value in "xy":
        assert found([{"name": "p", "never": f"SB = {value}"}], SB=note) == []


@pytest.mark.parametrize(
    ("hazard", "address", "words"),
    [
        ({"name": "h", "facts": {"SB/0": "2"}}, "_hazards/h", "SB/0 never has the value 2"),
        ({"name": "h", "facts": {"SB/1": "0"}}, "_hazards/h", "it names SB/1, which is no fact"),
        ({"name": "h", "facts": {"0": "0"}}, "_hazards/h", "it names 0, which is no fact"),
        ({"name": "h"}, "_hazards/h", "a hazard is not understood"),
        ({"name": "h", "facts": {"SB/0": 1}}, "_hazards/h", "a hazard is not understood"),
        ("h", "_hazards", "a hazard is not understood"),
        (
            {"name": "again", "facts": {"SB/0": "0"}},
            "_hazards/again",
            "the name again is used twice",
        ),
    ],
)
def test_a_hazard_that_cannot_be_read_is_an_error(hazard: Any, address: str, words: str) -> None:
    hazards = [{"name": "again", "facts": {"SB/0": "1"}}, hazard]
    ((severity, where, said),) = found([], _hazards=hazards)
    assert (severity, where) == ("E", address)
    assert words in said


def test_the_meaning_covers_properties_and_their_order_counts_nothing() -> None:
    one, other = {"name": "a", "never": F}, {"name": "b", "reachable": G}
    both, turned = digests(blueprint([one, other])), digests(blueprint([other, one]))
    assert both == turned
    assert blueprint([one, other]) == blueprint([other, one])
    assert digests(blueprint([one])).meaning != both.meaning
    assert digests(blueprint([one])).behaviour == both.behaviour
    # A default that is written out changes nothing, and no property is as it was without the key.
    assert digests(blueprint([{**one, "severity": "E"}, other])) == both
    without = read_blueprint(parse_json(json.dumps({"SB": SB}), "file.json"))
    assert digests(blueprint([])) == digests(without)
