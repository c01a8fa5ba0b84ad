"""Searches in arrays, with all three ways to number configurations, against the layers of
diagrams."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import numpy as np
import pytest

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.graph.joint import array_runs
from smsl_studio.graph.joint.array_runs import ArrayReach, shortest_run
from smsl_studio.graph.joint.array_search import ArrayBound
from smsl_studio.graph.joint.goals import FoundRun, SearchGoals
from smsl_studio.graph.joint.hashed import HashNumbers
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import JointBox
from smsl_studio.graph.joint.ranks import ranked
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.graph.joint.test_products import drawn


def steps_of(plain: dict[str, Any]) -> JointSteps:
    return JointSteps(Hierarchy(read_blueprint(parse_json(json.dumps(plain), "file.json"))))


def drawn_box(steps: JointSteps, chance: Random) -> JointBox:
    """Some states of one or two SBs."""
    names = chance.sample(range(len(steps.numbers.sizes)), min(2, len(steps.numbers.sizes)))
    return {
        at: frozenset(chance.sample(range(size), chance.randint(1, max(size // 2, 1))))
        for at in names
        if (size := steps.numbers.sizes[at])
    }


def runs(steps: JointSteps, goals: SearchGoals, reach: JointReach) -> list[FoundRun | None]:
    """The run by each way to number configurations."""
    found = [shortest_run(steps, goals), ArrayReach(steps).nearest(goals)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(array_runs, "PLAIN_BITS", 0)
        found += [
            shortest_run(steps, goals),
            shortest_run(steps, goals, (reach.diagram, reach.whole)),
            ArrayReach(steps).nearest(goals),
        ]
    return found


@pytest.mark.parametrize("seed", range(share_of(40)))
def test_all_numberings_find_the_same(seed: int) -> None:
    chance = Random(seed)
    try:
        steps = steps_of(drawn(seed))
    except RunRefused:
        return
    reach = JointReach(steps)
    assert ArrayReach(steps).count == reach.count
    for _ in range(4):
        box = drawn_box(steps, chance)
        first, *others = runs(steps, SearchGoals([box]), reach)
        assert all(one == first for one in others)
        wanted = reach.diagram.box(box)
        assert (first is None) != reach.can_meet(wanted)
        if first is not None:
            ways, during = reach.paths.nearest(wanted, 0)
            assert (len(first.path), during) == (len(ways) - 1, False)
            assert reach.has(ways[-1], first.end)


def grid(count: int, states: int) -> dict[str, Any]:
    """SBs that count up and down by themselves; the last one also begins anew."""
    values: dict[str, Any] = {}
    for n in range(count):
        table: dict[str, dict[str, str]] = {f"S{m}": {} for m in range(states)}
        for m in range(states - 1):
            table[f"S{m}"]["go"], table[f"S{m + 1}"]["back"] = f"S{m + 1}", f"S{m}"
        values[f"C{n}"] = {"HEADER": {"NUM_FACTS": 1}, **table}
    for m in range(states):
        values[f"C{count - 1}"][f"S{m}"]["anew"] = "S0"
    return values


def test_a_table_of_cells_grows_with_what_is_found() -> None:
    steps = steps_of(grid(5, 9))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(array_runs, "PLAIN_BITS", 0)
        found = ArrayReach(steps)
    assert (found.count, found.bound) == (9**5, "")


def test_ranks_have_no_gap_in_codes_of_several_groups() -> None:
    values = grid(5, 9)
    for n in range(5):  # of two neighbours one is at 0
        low = {f"C{near}/0": "0" for near in (n - 1, n + 1) if 0 <= near < 5}
        values[f"C{n}"]["_operations"] = {"S0/go": {"requires": low}}
    steps = steps_of(values)
    reach = JointReach(steps)
    layout, numbers = ranked(reach.diagram, reach.whole)
    assert len(layout.groups) > 1
    everything = np.array([layout.code(one) for one in reach.diagram.members(reach.whole, 10**6)])
    assert reach.count < 9**5
    assert sorted(numbers.of(everything).tolist()) == list(range(reach.count))
    goals = SearchGoals([{0: frozenset({8}), 2: frozenset({8})}])
    first, *others = runs(steps, goals, reach)
    assert first is not None
    assert all(one == first for one in others)


def test_the_first_run_by_its_addresses_is_found() -> None:
    steps = steps_of(grid(3, 4))
    run = shortest_run(steps, SearchGoals([{0: frozenset({2}), 1: frozenset({1})}]))
    assert run is not None
    assert [str(one) for one in run.path] == ["C0/S0/go", "C0/S1/go", "C1/S0/go"]


def test_bounds_are_told_and_what_is_near_is_found_all_the_same() -> None:
    steps = steps_of(grid(5, 9))
    for bound, words in (
        (ArrayBound(1_000), "1,000 configurations in arrays"),
        (ArrayBound(steps=5_000), "5,000 steps in arrays"),
    ):
        found = ArrayReach(steps, bound)
        assert found.bound == words
        assert 0 < found.count <= 1_000
        assert found.nearest(SearchGoals([{0: frozenset({2})}])) is not None
        assert found.nearest(SearchGoals([{0: frozenset({8}), 1: frozenset({8})}])) is None


def test_cells_are_the_same_for_the_same_configuration() -> None:
    numbers = HashNumbers()
    codes = np.array([5, 2**40, 5, 7, 2**40], np.int64)
    first = numbers.of(codes).tolist()
    assert first[0] == first[2]
    assert first[1] == first[4]
    assert len(set(first)) == 3
    assert numbers.of(codes).tolist() == first
    assert not numbers.made_room(100)
    assert numbers.made_room(numbers.size)
