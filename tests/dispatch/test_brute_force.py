"""Random hierarchies against brute force: what can be reached, the costs, and what a run does."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.dispatch.route.planner import Planner
from smsl_studio.errors import RunRefused
from smsl_studio.host.local import LocalHost
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.dispatch.naive import Naive
from tests.dispatch.runs import Story, blueprint

SEEDS = (*range(share_of(200)), 1495, 3049)  # the last two: load below a sub that is shared


def cases(seed: int, count: int) -> Iterator[tuple[Naive, dict[str, str], str, dict[str, str]]]:
    """(oracle, start, root, goals) for one seed, where a run may start at all."""
    values = blueprint_values(seed)
    hierarchy = Hierarchy(blueprint(values))
    try:
        start = start_configuration(hierarchy, {})
    except RunRefused:
        return
    dice = random.Random(seed)
    for _ in range(count):
        found = {}
        for sb in dice.sample(list(values), min(len(values), dice.choice((1, 1, 2)))):
            found[sb] = dice.choice([state for state in values[sb] if state[0] == "S"])
        roots = {root for sb in found for root in hierarchy.roots_of(sb)}
        if len(roots) == 1:
            yield Naive(values), start, roots.pop(), found


@pytest.mark.parametrize("seed", SEEDS)
def test_the_planner_finds_what_brute_force_finds(seed: int) -> None:
    for naive, start, root, wanted in cases(seed, 3):
        hierarchy = Hierarchy(blueprint(naive.plain))
        goals = [Address(sb, wanted[sb]) for sb in hierarchy.order if sb in wanted]
        legs = Planner(hierarchy).legs(start, goals)
        best = naive.best(start, root, wanted)
        assert (legs is None) == (best is None)
        if legs is not None and best is not None:
            cost = sum(leg.cost for leg in legs)
            assert cost == best if len(goals) == 1 else cost >= best


@pytest.mark.parametrize("seed", range(share_of(100)))
def test_out_of_and_around_failures_the_planner_finds_what_brute_force_finds(seed: int) -> None:
    for naive, start, root, wanted in cases(seed, 3):
        for sb in naive.tree(root)[:: 1 + seed % 2]:
            naive.plain[sb]["_facts"] = {"0": {"failure": [str(seed % 2)]}}
        hierarchy = Hierarchy(blueprint(naive.plain))
        goals = [Address(sb, wanted[sb]) for sb in hierarchy.order if sb in wanted]
        legs = Planner(hierarchy).legs(start, goals)
        if all(start[sb] == state for sb, state in wanted.items()):
            assert legs == ()
        elif naive.healthy(start, root):
            best = naive.best(start, root, wanted)
            assert (legs is None) == (best is None)
            if legs is not None and len(goals) == 1:
                assert legs[0].cost == best
        elif legs is not None and legs[0].goal is None:
            assert legs[0].cost == naive.best(start, root, None)
        elif naive.best(start, root, None) is None:
            assert legs is None


@pytest.mark.parametrize("seed", SEEDS)
def test_a_run_reaches_what_brute_force_reaches_and_never_disagrees(seed: int) -> None:
    for naive, start, root, wanted in cases(seed, 1):
        made = blueprint(naive.plain)
        goals = [f"{sb}/{state}" for sb, state in wanted.items()]
        story = Story(made, LocalHost(made, "table"), goals=goals)
        if not story.dispatcher.finished:
            story.run()
        best = naive.best(start, root, wanted)
        assert (story.end.reason == "goal_reached") == (best is not None), story.end
        if story.end.reason == "goal_reached":
            assert {sb: story.end.configuration[sb] for sb in wanted} == wanted
        configuration = dict(start)
        for event in story.of("committed"):
            configuration |= event.configuration
            assert naive.agrees(configuration)
        assert not story.of("mismatch")
