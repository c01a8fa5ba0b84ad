"""The ways out of failure states, against a plain search by hand."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.front.recovery import recoverability
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.dispatch.naive import Config, Naive


def fewest(naive: Naive, start: Config) -> int | None:
    """The number of operations to the nearest configuration in which nothing has failed."""
    layer, seen, count = [start], {json.dumps(start, sort_keys=True)}, 0
    while layer:
        if any(naive.healthy(one, "A") for one in layer):
            return count
        further = []
        for one in layer:
            for after, _ in naive.moves(one, "A"):
                key = json.dumps(after, sort_keys=True)
                if key not in seen:
                    seen.add(key)
                    further.append(after)
        layer, count = further, count + 1
    return None


@pytest.mark.parametrize("seed", range(share_of(40)))
def test_a_plain_search_finds_the_same(seed: int) -> None:
    chance = Random(seed)
    plain: dict[str, Any] = blueprint_values(seed, chance.randrange(5))
    for branch in plain.values():
        if chance.random() < 0.6:
            digit = chance.randrange(branch["HEADER"]["NUM_FACTS"])
            branch["_facts"] = {str(digit): {"failure": [chance.choice("01")]}}
    blueprint = read_blueprint(parse_json(json.dumps(plain), "file.json"))
    naive = Naive(plain)
    goal = {"A": plain["A"]["HEADER"]["ACTIVATING"]}
    for one in recoverability(blueprint):
        given = {one.state.branch: one.state.state}
        try:
            start = start_configuration(Hierarchy(blueprint), given)
        except RunRefused:
            assert (one.path, one.cost) == (None, None)
            continue
        assert (None if one.path is None else len(one.path)) == fewest(naive, start)
        if not naive.fails("A", goal["A"]) and naive.healthy(start, "A"):
            assert one.cost == naive.best(start, "A", goal)


def test_a_state_that_is_declared_safe_needs_no_way_out() -> None:
    branch = {
        "HEADER": {"NUM_FACTS": 1},
        "_facts": {"0": {"failure": ["x", "y"]}},
        "_states": {"Sx": {"safe": True}},
        "S0": {"go": "S1"},
        "Sx": {},
        "Sy": {},
        "S1": {},
    }
    blueprint = read_blueprint(parse_json(json.dumps({"A": branch}), "file.json"))
    safe, lost = recoverability(blueprint)
    assert (safe.path, safe.cost, safe.is_complete) == ((), None, False)
    assert (lost.path, lost.cost) == (None, None)
