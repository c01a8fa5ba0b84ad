"""An SB that moves alone is planned by its goal tree, with the same legs as the joint search."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.dispatch.route.ways import Ways
from smsl_studio.generate.rules import hanoi
from tests.counts import share_of
from tests.dispatch.runs import blueprint

SEEDS = range(share_of(40))
COSTS = (0, 0, 1, 1, 2, 0.1, 0.2, 0.3)


class Joint(Ways):
    """No SB moves alone, so that joint configurations are searched."""

    def alone(self, stepper: Stepper, branch: str) -> bool:
        return False


def values(dice: random.Random) -> dict[str, Any]:
    """Two flat roots: ties, zero costs, parallel edges, self loops, failures, ``requires``."""
    states = [f"State{a}{b}" for a in "012x" for b in "01"]
    notes: dict[str, Any] = {}
    for name in dice.sample("pqrst", 3):
        notes[name] = {"cost": dice.choice(COSTS)}
    notes[dice.choice("pqrst")] = {"requires": {"B/0": dice.choice("01")}}
    notes[f"{dice.choice(states)}/{dice.choice('pqrst')}"] = {"cost": dice.choice(COSTS)}
    notes["q"] = {"requires": {"A/1": dice.choice("01")}, "cost": dice.choice(COSTS)}
    table = {
        state: {
            name: dice.choice([*states, *states, *states, "Nowhere"])
            for name in dice.sample("pqrst", dice.randint(1, 4))
        }
        for state in states
    }
    facts = {"_facts": {"0": {"failure": ["x"]}}} if dice.random() < 0.5 else {}
    head = {"INITIAL": "State00", "ACTIVATING": "State20", "NUM_FACTS": 2}
    other = {"HEADER": {"NUM_FACTS": 1}, "State0": {"on": "State1"}, "State1": {"off": "State0"}}
    return {"A": {"HEADER": head, "_operations": notes, **facts, **table}, "B": other}


def some_edge(made: Blueprint, dice: random.Random) -> Address:
    edges = [edge.address for edge in made["A"].edges() if edge.target in made["A"].table]
    return dice.choice(edges)


@pytest.mark.parametrize("seed", SEEDS)
def test_kept_ways_give_what_a_search_of_joint_configurations_finds(seed: int) -> None:
    dice = random.Random(seed)
    made = blueprint(values(dice))
    hierarchy = Hierarchy(made)
    kept = Ways(hierarchy)
    shut: dict[Address, str] = {}
    costs: dict[Address, float] = {}
    for _ in range(8):
        match dice.choice(("shut", "shut", "open", "cost")):
            case "shut":
                shut[some_edge(made, dice)] = "pruned"
            case "open" if shut:
                del shut[dice.choice(list(shut))]
            case _:
                costs[some_edge(made, dice)] = dice.choice(COSTS)
        terms = Terms(shut=dict(shut), costs=dict(costs))
        start = {"A": dice.choice(list(made["A"].table)), "B": dice.choice(("State0", "State1"))}
        goals = [Address("A", dice.choice(list(made["A"].table)))]
        if dice.random() < 0.3:
            goals.append(Address("B", "State1"))
        by_tree = Planner(hierarchy, terms, kept).legs(start, goals)
        assert by_tree == Planner(hierarchy, terms, Joint(hierarchy)).legs(start, goals)


def test_edges_without_a_function_are_no_way() -> None:
    made = hanoi(3)
    edges = [edge.address for edge in made["SB1"].edges()]
    bound = {edge for edge in edges if edge != Address("SB1", "State_aaa", "Op_1c")}
    start, goals = {"SB1": "State_aaa"}, [Address("SB1", "State_ccc")]
    legs = Planner(Hierarchy(made), Terms(bound=bound)).legs(start, goals)
    joint = Planner(Hierarchy(made), Terms(bound=bound), Joint(Hierarchy(made)))
    assert legs == joint.legs(start, goals)
    assert legs is not None
    assert len(legs[0].operations) == 8


def test_a_way_of_a_large_branch_is_told_with_every_step() -> None:
    made = hanoi(7)
    start: Mapping[str, str] = {"SB1": "State_aaaaaaa"}
    legs = Planner(Hierarchy(made)).legs(start, [Address("SB1", "State_ccccccc")])
    assert legs is not None
    assert len(legs[0].steps) == legs[0].cost == 127
    assert dict(legs[0].before[0]) == start
    for step, before, after in zip(legs[0].steps, legs[0].before, legs[0].before[1:], strict=False):
        assert {**before, **step.after} == after
