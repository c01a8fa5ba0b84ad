"""The quick path of the planner: the same routes as the walk over joint configurations."""

from __future__ import annotations

from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.dispatch.route import planner
from smsl_studio.dispatch.route.decomposition import is_decomposed
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.stop import StopListener, Stopped, heeding
from tests.counts import share_of
from tests.dispatch.large import chained, cube, cube_of_rings, line_of_rings, ring, three_levels
from tests.dispatch.planned import answer, decomposed, lines, questions, unwalked, walked
from tests.dispatch.runs import blueprint

SEEDS = share_of(200)
GROUPS = max(1, SEEDS // 20)


@pytest.mark.parametrize("group", range(GROUPS))
def test_the_routes_are_those_of_the_walk(group: int) -> None:
    short = 0
    for seed in range(group, SEEDS, GROUPS):
        for question in questions(seed, 3):
            found = answer(question)
            assert lines(found) == lines(walked(question)), seed
            assert found == walked(question), seed
            if decomposed(question):
                assert unwalked(question), f"no move fits the ranks: {seed}"
                short += 1
    assert short, "no question of this group takes the quick path"


@pytest.mark.parametrize(
    ("values", "goal", "cost", "operations"),
    [
        (three_levels(), "State_1111", 32, 52),
        (line_of_rings(20), "State_" + "1" * 20, 140, 160),
        (cube_of_rings(7), "State_1111111", 49, 56),
        (cube_of_rings(7), "State_1110111", 42, 48),
        (chained(7), "State_1111111", 49, 56),
    ],
)
def test_more_configurations_than_anyone_can_walk(
    values: dict[str, Any],
    goal: str,
    cost: float,
    operations: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delattr(planner, "PlanSearch")
    made = blueprint(values)
    hierarchy = Hierarchy(made)
    legs = Planner(hierarchy).legs(start_configuration(hierarchy, {}), [Address("BASE", goal)])
    assert legs is not None
    (leg,) = legs
    assert leg.cost == cost
    assert len(leg.operations) == operations


def test_it_goes_on_where_it_was_called_off() -> None:
    made = blueprint(three_levels(3, 2, 3))
    hierarchy = Hierarchy(made)
    question = start_configuration(hierarchy, {}), [Address("BASE", "State_111")]
    own, called_off = Planner(hierarchy), 0
    while True:
        try:
            with heeding(StopListener(4 + called_off // 5).heed):
                legs = own.legs(*question)
            break
        except Stopped:
            called_off += 1
    assert called_off > 3
    assert legs == Planner(hierarchy).legs(*question)


def _valid(values: dict[str, Any], goal: str = "State_11") -> bool:
    made = blueprint(values)
    hierarchy = Hierarchy(made)
    own = Planner(hierarchy)
    start = start_configuration(hierarchy, {})
    movers = [name for name in hierarchy.order if name in hierarchy.tree("BASE")]
    return is_decomposed(own.stepper, start, Address("BASE", goal), movers)


def _with(sb: str, **fields: Any) -> dict[str, Any]:
    values = cube_of_rings(2, 3)
    values[sb] = {**fields, **values[sb]}
    return values


def test_it_is_used_only_where_it_is_valid() -> None:
    assert _valid(cube_of_rings(2, 3))
    assert not _valid(cube_of_rings(2, 3), "State_01"), "a digit is off at the goal"
    assert not _valid(_with("BASE", _operations={"U0": {"subs": "load"}}))
    assert not _valid(_with("SUB0", _operations={"Go0": {"requires": {"SUB1/0": "1"}}}))
    assert not _valid(_with("SUB0", _operations={"Go0": {"cost": 1 / 3}}))
    assert not _valid(_with("SUB0", _facts={"0": {"failure": ["1"]}}))
    shared = {**cube_of_rings(2, 3), "OTHER": cube(["SUB0"])}
    assert not _valid(shared), "two bases wait for one sub-SB"
    hazard = [{"name": "both", "facts": {"SUB0/0": "1", "SUB1/0": "1"}}]
    assert not _valid({"_hazards": hazard, **cube_of_rings(2, 3)})
    below = {**cube_of_rings(2, 3), "SUB0": cube(["LOW"]), "LOW": ring(3)}
    assert _valid(below)
    below["SUB0"]["HEADER"] |= {"INITIAL": "State_1", "ACTIVATING": "State_0"}
    assert not _valid(below), "a digit is off in ACTIVATING"
