"""The graph of one SB has the same steps as the stepper, in the same order."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.properties.formula_text import read_formula
from smsl_studio.blueprint.properties.meaning import meaning_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.lone import LoneExploration, is_lone
from smsl_studio.inspection.proof.space import Space
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.inspection.proof.brute import drawn_condition


def told(found: Exploration) -> list[Any]:
    """All that was explored, in names."""
    steps = [
        [(str(found.name(label)), found.keys[to]) for label, to in found.steps(node)]
        for node in range(len(found))
    ]
    depths = [found.depth(node) for node in range(len(found))]
    return [found.keys, steps, depths, found.bound, list(map(found.origin, range(len(found))))]


@pytest.mark.parametrize("seed", range(share_of(40)))
def test_the_graph_of_one_sb_has_all_its_steps(seed: int) -> None:
    chance = Random(seed)
    plain = blueprint_values(seed, 0)
    (branch,) = plain.values()
    for note in branch["_operations"].values():
        note.pop("requires", None)
    if chance.random() < 0.5:
        branch["_facts"] = {"0": {"failure": [chance.choice("01")]}}
    states = [state for state in branch if state.startswith("S")]
    for operation in ("z/a", "~", "a"):  # their addresses are in another order
        branch[chance.choice(states)][operation] = chance.choice(states)
    blueprint = read_blueprint(parse_json(json.dumps(plain), "file.json"))
    text, _ = drawn_condition(plain, chance)
    shut = [meaning_of(read_formula(text), blueprint)]
    for routed, hazards, limit in ((False, (), 1_000), (True, (), 1_000), (True, shut, 1_000),
                                   (False, (), 3)):  # fmt: skip
        try:
            space = Space(blueprint, routed, hazards)
        except RunRefused:
            return
        assert is_lone(space.hierarchy, space.cone)
        assert told(LoneExploration(space, limit)) == told(Exploration(space, limit))
