"""A tidy drawing keeps what a person knows of it: what was tidy stays, what is not chosen too."""

from __future__ import annotations

import itertools
import statistics
from random import Random

import pytest

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.arrangement import KINDS, LAYERS
from smsl_studio.graph.folded import chain_of, folded_chain
from smsl_studio.graph.layout import place_anew, place_states
from smsl_studio.graph.tidied import tidied
from tests.graph.edited import edited, random_branch
from tests.graph.test_layout import Places, chain, covers, cube, hanoi, sample

FARM = {
    "Home": {"walk": "Field", "drive": "Town"},
    "Field": {"dig": "Barn", "back": "Home"},
    "Barn": {"load": "Town"},
    "Town": {"sell": "Home", "buy": "Shop"},
    "Shop": {"pay": "Town"},
}


def farm() -> StateBranch:
    return StateBranch("SB", dict(FARM))


@pytest.mark.parametrize("kind", KINDS)
def test_a_tidy_drawing_stays_as_it_is_wherever_it_lies(kind: str) -> None:
    branch = farm()
    fresh = tidied(branch, place_anew(branch, kind), kind=kind)
    elsewhere = {name: (x + 1000.0, y - 300.0) for name, (x, y) in fresh.items()}
    assert tidied(branch, elsewhere, kind=kind) == elsewhere


def test_a_drawing_upside_down_stays_upside_down() -> None:
    branch = sample("registration.json")["REGISTRATION"]
    mirrored = {name: (x, -y) for name, (x, y) in place_anew(branch).items()}
    assert tidied(branch, mirrored) == mirrored


def test_a_triangle_stands_as_ever() -> None:
    branch = StateBranch("SB", dict(hanoi(3)))
    moved = {name: (y, x) for name, (x, y) in place_anew(branch).items()}
    assert tidied(branch, moved) == place_anew(branch)


def test_a_drawing_that_was_never_tidy_is_laid_out_anew() -> None:
    branch = farm()
    chance = Random(4)
    strewn = {name: (chance.random() * 900, chance.random() * 900) for name in branch.table}
    found = tidied(branch, strewn)
    shape = {(x - found["Home"][0], y - found["Home"][1]) for x, y in found.values()}
    fresh = place_anew(branch)
    anew = {(x - fresh["Home"][0], y - fresh["Home"][1]) for x, y in fresh.values()}
    assert shape in (anew, {(x, -y) for x, y in anew})


def test_of_a_selection_only_the_selected_states_move() -> None:
    branch = cube(4)
    former = place_states(branch)
    chosen = list(branch.table)[3:8]
    strewn = {**former, **{name: (7.0 * i, 3.0 * i) for i, name in enumerate(chosen)}}
    found = tidied(branch, strewn, chosen)
    assert list(found) == list(branch.table)
    assert {n: at for n, at in found.items() if n not in chosen} == {
        n: at for n, at in strewn.items() if n not in chosen
    }
    assert not covers(found)


def test_after_random_edits_a_tidy_drawing_is_where_it_was() -> None:
    """The bench ``mental_map`` makes twenty times as many edits."""
    moved: list[float] = []
    for seed in range(5):
        chance = Random(seed)
        branch = random_branch(chance)
        places: Places = tidied(branch, place_states(branch))
        for _ in range(10):
            branch, places, movements = edited(branch, places, chance)
            moved.append(statistics.median(movements))
    assert statistics.median(moved) <= 40.0


@pytest.mark.parametrize("count", [7, 8, 12, 13, 30])
def test_a_long_chain_is_folded_into_rows(count: int) -> None:
    names = [f"State{number}" for number in range(count)]
    branch = chain(*names, more={names[3]: {"stay": names[3]}, names[-1]: {"back": names[-2]}})
    row = {name: (300.0 * number, 50.0) for number, name in enumerate(names)}
    places = tidied(branch, row)
    assert list(places) == names
    assert not covers(places)
    wide, high = (max(at) - min(at) for at in zip(*places.values(), strict=True))
    assert wide < 3.2 * high + 500.0
    for one, other in itertools.pairwise(names):
        (ax, ay), (bx, by) = places[one], places[other]
        assert (ax == bx) != (ay == by), "neighbours stay neighbours"
    assert tidied(branch, places) == places
    assert len({y for _, y in tidied(branch, row, kind=LAYERS).values()}) == 1, "as asked for"


def test_what_is_no_long_chain_is_not_folded() -> None:
    assert chain_of(chain("A", "B", "C")) == ["A", "B", "C"]
    assert chain_of(farm()) == []
    ring = chain("A", "B", "C", more={"C": {"back": "A"}})
    assert chain_of(ring) == []
    two = StateBranch("SB", {"A": {"go": "B"}, "B": {}, "C": {"go": "D"}, "D": {}})
    assert chain_of(two) == []
    six = chain("A", "B", "C", "D", "E", "F")
    assert folded_chain(six, place_anew(six)) is None


def alone(branch: StateBranch, count: int) -> StateBranch:
    """The same SB with states that no operation joins with the others."""
    return StateBranch("SB", {**branch.table, **{f"Alone{at}": {} for at in range(count)}})


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("seed", range(6))
def test_a_drawing_that_was_tidied_rests(count: int, seed: int) -> None:
    chance = Random(seed)
    for branch in (sample("registration.json")["REGISTRATION"], farm(), random_branch(chance)):
        more = alone(branch, count)
        rows = enumerate(more.table)
        former = {name: (float(chance.randrange(900)), 50.0 * at) for at, name in rows}
        former |= place_anew(branch) if seed % 3 else {}
        found = tidied(more, former)
        assert tidied(more, found) == found


def test_a_triangle_stays_a_triangle_beside_a_state_that_stands_alone() -> None:
    branch = StateBranch("SB", dict(hanoi(3)))
    more = alone(branch, 1)
    placed = place_anew(more)
    assert {name: placed[name] for name in branch.table} == {
        name: (x - min(x for x, _ in place_anew(branch).values()), y)
        for name, (x, y) in place_anew(branch).items()
    }
    assert placed["Alone0"][1] > max(y for _, y in place_anew(branch).values())
    moved = {**placed, "Alone0": (900.0, 0.0)}
    assert tidied(more, moved) == placed
