"""Sameness against a plain bisimulation, and flat blueprints that are the same as their origin."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.errors import EditRefused, PlanningError, RunRefused
from smsl_studio.front.inputs import read
from smsl_studio.front.shapes import diff_behaviour, flatten
from smsl_studio.inspection.equivalence.refinement import Refinement
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.inspection.equivalence.pairs import blueprint, changed
from tests.inspection.equivalence.plain import (
    after,
    bisimilar,
    naive_system,
    told_apart,
)
from tests.inspection.proof.asked_steps import asked_steps
from tests.inspection.proof.brute import starts_of
from tests.stories.person import SAMPLES


@pytest.mark.parametrize("seed", range(share_of(60)))
def test_a_plain_bisimulation_says_the_same(seed: int) -> None:
    chance = Random(seed)
    plain = blueprint_values(seed)
    other = changed(plain, chance)
    sides = blueprint(plain), blueprint(other)
    starts = starts_of(lambda: diff_behaviour(*sides), *sides)
    if not starts:
        return
    systems = naive_system(plain, starts[0]), naive_system(other, starts[1])
    found = diff_behaviour(*sides)
    assert found.configurations == (len(systems[0][0]), len(systems[1][0]))
    assert found.equal is bisimilar(*systems)
    assert found.equal or told_apart(*systems, found.path)
    assert diff_behaviour(sides[1], sides[0]).path == found.path


def test_both_verdicts_come_up() -> None:
    verdicts = set()
    for seed in range(20):
        plain = blueprint_values(seed)
        other = changed(plain, Random(seed))
        try:
            verdicts.add(diff_behaviour(blueprint(plain), blueprint(other)).equal)
        except RunRefused:
            continue
    assert verdicts == {True, False}


@pytest.mark.parametrize("seed", range(share_of(40)))
def test_a_label_that_leads_to_several_configurations(seed: int) -> None:
    chance = Random(seed)
    sizes = chance.randint(2, 5), chance.randint(2, 5)
    one, other = (
        (
            [chance.choice("ab") if chance.random() < 0.3 else "a" for _ in range(size)],
            [
                sorted(
                    {
                        (chance.choice("xy"), chance.randrange(size))
                        for _ in range(chance.randint(0, 3))
                    }
                )
                for _ in range(size)
            ],
        )
        for size in sizes
    )
    shift = sizes[0]
    moved = [[(label, at + shift) for label, at in row] for row in other[1]]
    found = Refinement([*one[0], *other[0]], [*one[1], *moved])
    assert found.alike(0, shift) is bisimilar(one, other)
    if not found.alike(0, shift):
        path = found.run(0, shift)
        assert len(path) <= found.round_of(0, shift)
        assert after(one, path) or after(other, path)


@pytest.mark.parametrize("sample", sorted(SAMPLES.glob("*.json")), ids=lambda path: path.stem)
def test_a_flat_sample_behaves_as_its_origin(sample: Any) -> None:
    whole = read(sample)
    flat = flatten(whole)
    assert len(flat.branches) == 1
    found = diff_behaviour(whole, flat)
    assert (found.equal, found.reason) == (True, "")
    assert found.configurations[0] == found.configurations[1]


@pytest.mark.parametrize("seed", range(100, 160))
def test_a_flat_random_blueprint_behaves_as_its_origin(seed: int) -> None:
    whole = blueprint(blueprint_values(seed))
    try:
        flat = flatten(whole)
    except RunRefused:
        return
    assert diff_behaviour(whole, flat).equal is True


def test_one_sb_and_what_is_below_it_are_flattened_alone() -> None:
    whole = read(SAMPLES / "three-levels.json")
    middle = next(name for name in whole.branches if whole.bases.get(name) and whole[name].subs)
    flat = flatten(whole, middle)
    below = {sub for _, sub in Hierarchy(whole).subs[middle]}
    assert list(flat.branches) == [middle]
    keys = [note.name for note in flat[middle].notes.facts.values()]
    assert {key.partition(".")[0] for key in keys} == {middle, *below}


def test_what_requires_a_fact_elsewhere_is_not_flattened_alone() -> None:
    values: dict[str, Any] = {name: {"S0": {"go": "S1"}, "S1": {}} for name in ("A", "B")}
    values["A"]["_operations"] = {"go": {"requires": {"B/0": "1"}}}
    with pytest.raises(EditRefused, match="would be left out"):
        flatten(blueprint(values), "A")
    assert len(flatten(blueprint(values))["A+B"].table) == 3


def test_a_goal_that_is_never_reached_is_still_named() -> None:
    values = {"A": {"HEADER": {"ACTIVATING": "S1"}, "S0": {}, "S1": {"back": "S0"}}}
    flat = flatten(blueprint(values))
    assert (flat["A"].activating, flat["A"].table["S1"]) == ("S1", {})
    assert diff_behaviour(blueprint(values), flat).equal is True


def test_limits_are_told() -> None:
    whole = read(SAMPLES / "hanoi.json")
    found = diff_behaviour(whole, whole, 5)
    assert (found.equal, found.path) == (None, ())
    assert "5 configurations" in found.reason
    with pytest.raises(PlanningError, match="more than 5 configurations"):
        flatten(whole, limit=5)


def test_many_sbs_fill_no_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """2 to the power of 40 configurations are fewer than a limit may be, and each is large."""
    monkeypatch.setattr("smsl_studio.inspection.proof.space.MOST_STORED", 4_000)
    one = {"HEADER": {"ACTIVATING": "S1"}, "S0": {"on": "S1"}, "S1": {"off": "S0"}}
    many = blueprint({f"B{number}": one for number in range(40)})
    words = "100 configurations of 40 SBs, which would fill the memory"
    with pytest.raises(PlanningError, match=words):
        flatten(many, limit=2**50)
    found = diff_behaviour(many, many, limit=2**50)
    assert found.equal is None
    assert words in found.reason


def test_that_there_are_surely_too_many_is_told_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """24 roots of two states have 16 million configurations, and each root has two."""
    asked = asked_steps(monkeypatch)
    pair = {"State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}}
    roots = blueprint({f"R{number}": pair for number in range(24)})
    found = diff_behaviour(roots, roots)
    assert (found.equal, found.configurations) == (None, (1, 1))
    assert "met the limit of 416,666 configurations of 24 SBs" in found.reason
    with pytest.raises(PlanningError, match="more than 416,666 configurations"):
        flatten(roots)
    assert len(asked) < 200


def test_groups_that_do_not_touch_are_all_explored_if_there_are_few() -> None:
    pair = {"State_0": {"on": "State_1"}, "State_1": {"off": "State_0"}}
    roots = blueprint({f"R{number}": pair for number in range(5)})
    assert diff_behaviour(roots, roots).configurations == (32, 32)
    assert diff_behaviour(roots, roots, limit=32).equal is True
    assert diff_behaviour(roots, roots, limit=31).equal is None


def test_other_facts_differ_at_the_start() -> None:
    one = {"A": {"State0": {"go": "State1"}, "State1": {}}}
    other = {"A": {"State00": {"go": "State11"}, "State11": {}}}
    found = diff_behaviour(blueprint(one), blueprint(other))
    assert (found.equal, found.path) == (False, ())
    assert found.reason == "file.json has the fact 1, and file.json has not"


def test_equal_operations_that_lead_to_other_facts_differ_after_them() -> None:
    one = {"A": {"State0": {"go": "State1"}, "State1": {}}}
    other = {"A": {"State0": {"go": "State2"}, "State2": {}}}
    found = diff_behaviour(blueprint(one), blueprint(other))
    assert (found.equal, found.path) == (False, ("go",))
    assert found.reason == "after 1 operation 0 is 1 in file.json and 2 in file.json"
