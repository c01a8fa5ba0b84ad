"""Relocating: the states that agree with the scene, compared with every combination of states."""

from __future__ import annotations

import random
from collections.abc import Mapping
from itertools import product
from typing import Any

import pytest

from smsl_studio.blueprint.check import state_check
from smsl_studio.blueprint.configuration import Hierarchy, disagreements, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.recovery import MOST, candidates, located, stands
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.errors import RunRefused
from tests.dispatch.fake_host import FakeHost
from tests.dispatch.generated import blueprint_values
from tests.dispatch.runs import Story, blueprint


def twins(seed: int, dice: random.Random) -> dict[str, Any]:
    """A random blueprint in which some states read like others."""
    values = blueprint_values(seed)
    for sb in values.values():
        for name in [name for name in sb if name.startswith("S")]:
            for letter in "TU":
                if dice.random() < 0.3:
                    sb[letter + name[1:]] = {"o0": name}
    return {
        name: dict(sorted(sb.items(), key=lambda one: (one[0] == "HEADER", dice.random())))
        for name, sb in values.items()
    }


def opened(made: Blueprint, dice: random.Random) -> LiveRun | None:
    """A run somewhere, whose scene is that of a random configuration, or of none."""
    known = Hierarchy(made)
    try:
        starts = {root: dice.choice(list(made[root].table)) for root in known.roots}
        here = start_configuration(known, starts)
        there = {**here, **{r: dice.choice(list(made[r].table)) for r in known.roots}}
        there = start_configuration(known, {r: there[r] for r in known.roots})
    except RunRefused:
        return None
    host = FakeHost(made)
    blind = {key for key in host.facts if dice.random() < 0.15}
    host = FakeHost(made, blind=blind)
    run = LiveRun(known, host, host.open(here), here)
    for name, state in there.items():
        if not known.bases[name] or dice.random() < 0.7:
            for digit, value in enumerate(made[name].facts(state)):
                if (name, digit) in host.facts:
                    host.facts[name, digit] = value
    for key in host.facts:
        if dice.random() < 0.03:
            host.facts[key] = None
    run.look()
    return run


def every(run: LiveRun, keeps: bool) -> list[Mapping[str, str]]:
    """All that agrees with itself and with the scene; ``keeps``: an SB whose committed state checks
    true stays there. What nobody senses is believed to be as it was committed."""
    made, here, scene = run.blueprint, run.configuration, run.senses.scene
    names = list(here)
    found: list[Mapping[str, str]] = []
    for states in product(*(made[name].table for name in names)):
        one = dict(zip(names, states, strict=True))
        if disagreements(run.hierarchy, one) or not stands(run, one):
            continue
        if any(_unsensed(run, name, one[name]) != _unsensed(run, name, here[name]) for name in one):
            continue
        true = (
            state_check(made, name, here[name], scene, {**one, name: here[name]}).truth
            for name in names
        )
        kept = [name for name, truth in zip(names, true, strict=True) if truth is True]
        if not keeps or all(one[name] == here[name] for name in kept):
            found.append(one)
    return found


def _unsensed(run: LiveRun, name: str, state: str) -> list[str]:
    own = run.blueprint[name]
    values = enumerate(own.facts(state))
    scene = run.senses.scene
    return [v for d, v in values if d not in own.subs and scene.get(name, d) is None]


def test_the_same_as_trying_every_combination() -> None:
    dice = random.Random(7)
    met: dict[int, int] = {}
    for seed in range(400):
        made = blueprint(twins(seed, dice))
        size = 1
        for branch in made:
            size *= len(branch.table)
        run = opened(made, dice) if size <= 3000 else None
        if run is None:
            continue
        for ask, keeps in ((candidates, True), (located, False)):
            expected = every(run, keeps)
            assert list(ask(run)) == expected[:MOST], seed
            met[min(len(expected), 9)] = met.get(min(len(expected), 9), 0) + 1
    assert met[0] > 20
    assert met[1] > 20
    assert sum(met[count] for count in met if count > 1) > 20
    assert met[9] > 1


def wide(count: int) -> Blueprint:
    """A base with many subs; each has a state that reads like its ACTIVATING, and one
    that reads like its INITIAL."""
    off, on = "S_" + "0" * count + "0", "S_" + "0" * count + "1"
    full = "S_" + "1" * (count + 1)
    header = {"INITIAL": off, "ACTIVATING": full, "NUM_FACTS": count + 1}
    subs = {f"B{index}": index for index in range(count)}
    base = {"HEADER": {**header, "SUB_SBS": subs}, off: {"go": on}, on: {"all": full}, full: {}}
    below = {
        "HEADER": {"INITIAL": "A_0", "ACTIVATING": "A_1", "NUM_FACTS": 1},
        "A_0": {"y": "A_1"},
        "B_0": {},
        "B_1": {},
        "A_1": {},
    }
    return blueprint({"A": base, **dict.fromkeys(subs, below)})


def test_a_base_with_forty_ambiguous_subs_decides_where_they_are() -> None:
    made = wide(40)
    names = [f"B{index}" for index in range(40)]
    there = {"A": "S_" + "1" * 41, **dict.fromkeys(names, "A_1")}
    host = FakeHost(made, lasts=3)
    story = Story(made, host, goals=["A/S_" + "0" * 40 + "1"], attended=True).tick(2)
    for name in names:
        host.facts[name, 0] = "1"
    story.run()
    assert story.dispatcher.status.candidates == (there,)
    story.dispatcher.take_over()
    story.tick()
    story.dispatcher.give_back()
    story.tick()
    assert story.dispatcher.status.candidates == (there,)


def test_ambiguity_in_many_places_is_told_by_a_few_of_them() -> None:
    story = Story(wide(40), goals=["A/S_" + "0" * 40 + "1"], attended=True).tick(2)
    story.dispatcher.take_over()
    story.tick()
    story.dispatcher.give_back()
    story.tick()
    refused = story.of("commanded")[-1].refused
    assert refused.startswith("the scene agrees with several configurations, A/S_0")
    assert refused.count(" or ") == MOST - 1


@pytest.mark.parametrize("asked", [False, True])
def test_subs_that_are_shared_on_many_levels_are_looked_at_once(asked: bool) -> None:
    values: dict[str, Any] = {}
    for level in range(40):
        both = {f"B{level}": 0, f"C{level}": 1}
        head = {"INITIAL": "S00", "ACTIVATING": "S11", "NUM_FACTS": 2, "SUB_SBS": both}
        values[f"A{level}"] = {"HEADER": head, "S00": {"o": "S11"}, "S11": {}}
        for name in both:
            values[name] = flat({f"A{level + 1}": 0})
    values["A40"] = flat({})
    made = blueprint({**values, "_levels": {"A40/0": "human" if asked else "automatic"}})
    story = Story(made, FakeHost(made), attended=True)
    if asked:
        assert [one.address for one in story.of("task_opened")] == ["A40/0"]
    else:
        assert story.run().end.reason == "goal_reached"


def flat(subs: dict[str, int]) -> dict[str, Any]:
    head = {"INITIAL": "S0", "ACTIVATING": "S1", "NUM_FACTS": 1, "SUB_SBS": subs}
    return {"HEADER": head, "S0": {"o": "S1"}, "S1": {}}
