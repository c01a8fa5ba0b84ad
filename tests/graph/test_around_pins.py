"""A tidy drawing goes around pinned states: they stay to the last digit, and nothing covers them.

``benches.pins`` draws more graphs.
"""

from __future__ import annotations

from collections.abc import Mapping
from random import Random

import pytest

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.arrangement import BEST, KINDS
from smsl_studio.graph.layout import place_anew, place_states
from smsl_studio.graph.tidied import tidied
from tests.graph.pinned import covered, pinned_branch, random_case
from tests.graph.printed_layouts import random_graph
from tests.graph.test_layout import Places, chain, cube, hanoi, sample


@pytest.mark.parametrize("seed", [*range(7), 14])
def test_pinned_states_stay_and_nothing_covers_them(seed: int) -> None:
    """In the last case the states settle in two turns."""
    branch, shown, kind = random_case(Random(seed))
    pins = branch.notes.pinned
    found = tidied(branch, shown, kind=kind)
    assert list(found) == list(branch.table)
    assert {n: repr(found[n]) for n in pins} == {n: repr(shown[n]) for n in pins}
    assert covered(branch, found) == []
    assert tidied(branch, found, kind=kind) == found, "tidy twice is tidy once"


def shapes() -> Mapping[str, StateBranch]:
    names = [f"State_{number}" for number in range(14)]
    return {
        "triangle": StateBranch("SB", dict(hanoi(3))),
        "cube in rows": cube(4),
        "long chain": chain(*names),
        "alone": StateBranch("SB", {**{name: {} for name in names}, "Z": {"a": "Y"}, "Y": {}}),
        "300 states": random_graph(300, 2),
    }


@pytest.mark.parametrize("name", list(shapes()))
@pytest.mark.parametrize("share", [0.1, 0.7])
def test_special_drawings_go_around_pins_too(name: str, share: float) -> None:
    branch, chance = shapes()[name], Random(7)
    shown = place_states(branch)
    chosen = chance.sample(list(branch.table), max(1, int(share * len(branch.table))))
    wide = max(x for x, _ in shown.values()) + 400.0
    pins = {name: (chance.uniform(-200, wide), chance.uniform(-300, 900)) for name in chosen}
    branch = pinned_branch(branch, pins)
    found = tidied(branch, {**shown, **pins})
    assert {n: found[n] for n in pins} == pins
    assert covered(branch, found) == []
    assert tidied(branch, found) == found


def test_a_drawing_without_pins_is_that_of_before() -> None:
    branch = random_graph(20, 1)
    shown = place_states(branch)
    assert tidied(pinned_branch(branch, {}), shown) == tidied(branch, shown)


@pytest.mark.parametrize("kind", [*KINDS, "rows of facts"])
def test_the_new_drawing_is_moved_to_the_pin(kind: str) -> None:
    """Around one pin the drawing is the usual one, shifted as a whole."""
    branch = random_graph(12, 5)
    if kind not in KINDS:
        branch, kind = sample("registration.json")["REGISTRATION"], BEST
    usual = place_anew(branch, kind)
    first, *others = branch.table
    at = (usual[first][0] + 3_000.0, usual[first][1] - 1_000.0)
    strewn = {name: (17.0 * i, 3.0 * i) for i, name in enumerate(others)}
    found = tidied(pinned_branch(branch, {first: at}), {**strewn, first: at}, kind=kind)
    shift = {(found[n][0] - usual[n][0], found[n][1] - usual[n][1]) for n in branch.table}
    assert shift == {(3_000.0, -1_000.0)}


def test_what_is_tidy_around_the_pins_hardly_moves() -> None:
    """A state that was added moves to its place, and the others stay."""
    branch = random_graph(14, 3)
    shown = tidied(branch, place_states(branch))
    table = {**branch.table, "New": {"on": "S3"}}
    pins = {name: shown[name] for name in ("S0", "S5")}
    after = pinned_branch(StateBranch("SB", table, branch.header), pins)
    drawn: Places = {**shown, "New": (5.0, 5.0)}
    found = tidied(after, drawn)
    moved = [name for name in branch.table if found[name] != shown[name]]
    assert len(moved) <= 4
    assert covered(after, found) == []


def test_of_a_selection_the_pinned_states_stay() -> None:
    branch = cube(4)
    names = list(branch.table)
    strewn = {name: (7.0 * i, 3.0 * i) for i, name in enumerate(names[3:8])}
    shown: Places = {**place_states(branch), **strewn}
    pins = {name: shown[name] for name in names[3:5]}
    branch = pinned_branch(branch, pins)
    found = tidied(branch, shown, names[3:8])
    assert {n for n in names if found[n] != shown[n]} == set(names[5:8])
    assert tidied(branch, shown, names[3:5]) == shown, "all of them are pinned"


@pytest.mark.parametrize("seed", [0, 2])
def test_wide_states_of_a_selection_cover_none(seed: int) -> None:
    """So many operations join the states that none of them settles."""
    chance = Random(seed)
    names = [f"State_with_a_very_long_name_{number}" for number in range(24)]
    table = {a: {f"to_{b}": b for b in chance.sample(names, 16)} for a in names}
    branch = StateBranch("SB", dict(table))
    shown = {name: (400.0 * (at % 6), 100.0 * (at // 6)) for at, name in enumerate(names)}
    chosen, pins = chance.sample(names, 8), chance.sample(names, 2)
    branch = pinned_branch(branch, {name: shown[name] for name in pins})
    strewn = {**shown, **{n: shown[names[0]] for n in chosen if n not in pins}}
    found = tidied(branch, strewn, chosen)
    moved = {name for name in names if found[name] != strewn[name]}
    assert moved
    assert moved <= set(chosen) - set(pins)
    assert covered(branch, found) == []


def test_if_all_states_are_pinned_none_moves() -> None:
    branch = random_graph(9, 1)
    shown = {name: (13.37 * i, -0.1 * i) for i, name in enumerate(branch.table)}
    assert tidied(pinned_branch(branch, shown), shown, kind=BEST) == shown


def test_far_pins_do_no_harm() -> None:
    branch = random_graph(9, 1)
    shown = place_states(branch)
    pins = {"S0": (-9_999_999.0, 9_999_999.0), "S4": (9_999_999.0, -9_999_999.5)}
    branch = pinned_branch(branch, pins)
    found = tidied(branch, {**shown, **pins})
    assert {n: found[n] for n in pins} == pins
    assert covered(branch, found) == []
    assert tidied(branch, found) == found
