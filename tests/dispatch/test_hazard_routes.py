"""Routes go around hazards, against plain search over all joint steps that meet none."""

from __future__ import annotations

import heapq
import random
from collections.abc import Iterator
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.hazards import guard_hazards
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import RunRefused
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.dispatch.runs import Story, blueprint, branch

Config = dict[str, str]


def drawn(seed: int) -> tuple[dict[str, Any], list[dict[str, str]]]:
    """A random blueprint with hazards of one to three facts, often of several SBs."""
    values = blueprint_values(seed)
    dice = random.Random(f"hazards {seed}")
    facts = [(sb, d) for sb in values for d in range(values[sb]["HEADER"]["NUM_FACTS"])]
    hazards = [
        {f"{sb}/{d}": dice.choice("01") for sb, d in dice.sample(facts, min(len(facts), count))}
        for count in dice.sample((1, 2, 2, 3), 2)
    ]
    named = [{"name": f"h{n}", "facts": facts} for n, facts in enumerate(hazards)]
    return {"_hazards": named, **values}, hazards


def meets(hazards: list[dict[str, str]], here: Config) -> bool:
    """Whether a configuration has all facts of a hazard; states are named S and their digits."""
    return any(
        all(here[key.split("/")[0]][1 + int(key.split("/")[1])] == v for key, v in one.items())
        for one in hazards
    )


def best(stepper: Stepper, start: Config, tree: list[str], goal: Address, hazards: Any) -> Any:
    """The least cost over all joint steps of a tree that meet no hazard, None if there is none."""
    order = list(start)
    heap: list[tuple[float, tuple[str, ...]]] = [(0.0, tuple(start.values()))]
    done = set()
    while heap and not meets(hazards, start):
        cost, key = heapq.heappop(heap)
        here = dict(zip(order, key, strict=True))
        if here[goal.branch] == goal.state:
            return cost
        if key in done:
            continue
        done.add(key)
        for name in tree:
            for edge in stepper.edges.out(name, here[name]):
                step = stepper.step(here, edge)
                if isinstance(step, JointStep) and not any(
                    meets(hazards, one) for one in passed(here, step)
                ):
                    after = {**here, **step.after}
                    heapq.heappush(heap, (cost + step.cost, tuple(after.values())))
    return None


def passed(here: Config, step: JointStep) -> Iterator[Config]:
    """Where everything stands after each function of a step."""
    now = dict(here)
    for action in step.actions:
        now |= action.moved
        yield dict(now)


@pytest.mark.parametrize("seed", range(share_of(90)))
def test_the_planner_finds_the_cheapest_route_around_hazards(seed: int) -> None:
    values, hazards = drawn(seed)
    made = blueprint(values)
    hierarchy = Hierarchy(made)
    try:
        start = start_configuration(hierarchy, {})
    except RunRefused:
        return
    dice = random.Random(seed)
    plain = Stepper(hierarchy)
    for _ in range(3):
        sb = dice.choice(list(made.branches))
        if len(hierarchy.roots_of(sb)) > 1:
            continue
        goal = Address(sb, dice.choice(list(made[sb].table)))
        tree = list(hierarchy.tree(hierarchy.roots_of(sb)[0]))
        legs = Planner(hierarchy, Terms(hazards=guard_hazards(made))).legs(start, [goal])
        wanted = best(plain, start, tree, goal, hazards)
        assert (legs is None) == (wanted is None)
        if legs is not None:
            assert sum(leg.cost for leg in legs) == wanted
            for leg in legs:
                for before, step in zip(leg.before, leg.steps, strict=True):
                    assert not any(meets(hazards, one) for one in passed(dict(before), step))


TWO_WAYS = {
    "_hazards": [{"name": "Blind cut", "facts": {"SB1/0": "1", "SB1/1": "0"}}],
    "SB1": branch(
        {"00": "cut>10, look>01", "01": "cut>11", "10": "look>11", "11": ""}, activating="11"
    ),
}


def test_a_run_goes_the_other_way() -> None:
    story = Story(blueprint(TWO_WAYS)).run()
    assert story.started == ["SB1/State00/look", "SB1/State01/cut"]
    assert story.end.reason == "goal_reached"


def test_a_route_that_exists_only_through_a_hazard_is_no_route_and_names_it() -> None:
    for more in ({}, {"SB2": branch({"0": "go>1", "1": ""}, activating="1")}):
        values = {**TWO_WAYS, **more}
        story = Story(blueprint(values), avoid=["SB1/State00/look"]).run()
        assert (story.end.reason, story.started) == ("no_route", [])
        assert "SB1/State00/look" in story.end.sentence, "what is avoided would make a route"
    values = {**TWO_WAYS, "SB1": branch({"00": "cut>10", "10": "look>11", "11": ""})}
    story = Story(blueprint(values)).run()
    assert (story.end.reason, story.started) == ("no_route", [])
    assert "through the hazard Blind cut" in story.end.sentence
    details = story.of("held")[0].details
    assert any("State00/cut would meet the hazard Blind cut" in line for line in details)


def test_a_rise_that_passes_a_hazard_on_its_way_is_no_way() -> None:
    """The sub-SB alone goes through 10; its own operations lead around it."""
    sub = branch({"00": "near>10, far>01", "10": "end>11", "01": "end>11", "11": ""},
                 activating="11", operations={"far": {"cost": 5}})  # fmt: skip
    base = branch({"0": "rise>1", "1": ""}, activating="1", subs={"S": 0})
    plain = Story(blueprint({"B": base, "S": sub})).run()
    assert plain.started == ["B/State0/rise", "S/State00/near", "S/State10/end"]
    hazard = [{"name": "h", "facts": {"S/0": "1", "S/1": "0", "B/0": "0"}}]
    story = Story(blueprint({"_hazards": hazard, "B": base, "S": sub})).run()
    assert story.end.reason == "goal_reached"
    assert story.started == ["S/State00/far", "B/State0/rise", "S/State01/end"]


def test_pending_states_count_and_digits_in_transit_are_as_committed() -> None:
    """Both subs rise in one step: S is pending in 1 while the base is still in 00."""
    base = branch({"00": "both>11", "11": ""}, activating="11", subs={"S": 0, "T": 1})
    subs = {name: branch({"0": "on>1", "1": ""}, activating="1") for name in "ST"}
    pending = {"S/0": "1", "B/0": "0"}
    for facts, reason in ((pending, "no_route"), ({"B/0": "1", "B/1": "0"}, "goal_reached")):
        hazard = [{"name": "h", "facts": facts}]
        story = Story(blueprint({"_hazards": hazard, "B": base, **subs})).run()
        assert (story.end.reason, facts) == (reason, facts)
