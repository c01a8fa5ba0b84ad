"""Levels over facts: whose answer makes a fact known, in any world."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.people.rules import leveled_rules
from smsl_studio.host.local import LocalHost
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.smsl.json_form import parse_json


def rule(note: dict[str, Any], level: str = "", world: str = "table") -> FactRule | None:
    """The rule of the only fact, as a world has it and its level makes it."""
    file = {"A": {"_facts": {"0": note}, "State_0": {"go": "State_1"}, "State_1": {}}}
    blueprint = read_blueprint(parse_json(json.dumps(file), "x.json"))
    opened = LocalHost(blueprint, world).open({"A": "State_0"})
    levels = Levels(blueprint, {"A/0": level} if level else {})
    return leveled_rules(blueprint, opened, levels).get(("A", 0))


def test_what_nobody_has_a_say_in_stays_as_the_world_has_it() -> None:
    assert rule({}) is None
    assert rule({"aggregation": "all"}) is None, "the table world reads its own"


def test_a_human_fact_is_asked_also_where_it_stands_on_the_table() -> None:
    assert rule({"aggregation": "human", "max_age": 60}) == FactRule("human", max_age=60)
    assert rule({"max_age": 0.3}, "human") == FactRule("human"), "that age is of sensors"


@pytest.mark.parametrize("note", [{}, {"aggregation": "human"}])
def test_a_shared_fact_is_sensed_and_then_asked(note: dict[str, Any]) -> None:
    assert rule(note, "shared") == FactRule("single", shared=True)


def test_an_automatic_fact_is_sensed_alone() -> None:
    assert rule({"aggregation": "human"}, "automatic") is None
