"""Bounds shorten the joint search; its routes are the same, leg for leg, as without bounds."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.search import nothing
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route import planner
from smsl_studio.dispatch.route.planner import Leg, Planner
from smsl_studio.errors import RunRefused
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.dispatch.runs import blueprint, branch

SEEDS = range(share_of(150))
RING = {"00": "next>01, prev>10", "01": "next>11, prev>00", "11": "next>10, prev>01"}


def wide(subs: int) -> dict[str, Any]:
    """A base whose every digit is a sub-SB in a ring of four states."""
    edges = {}
    for digits in product("01", repeat=subs):
        here = "".join(digits)
        ways = []
        for at, digit in enumerate(here):
            other = "1" if digit == "0" else "0"
            ways.append(f"turn{at}>{here[:at]}{other}{here[at + 1 :]}")
        edges[here] = ", ".join(ways)
    below = {f"SB{at + 2}": at for at in range(subs)}
    ring = branch({**RING, "10": "next>00, prev>11"}, initial="00", activating="11")
    return {"SB1": branch(edges, subs=below), **dict.fromkeys(below, ring)}


def cases(seed: int) -> Iterator[tuple[Blueprint, Terms, dict[str, str], list[Address]]]:
    """Random hierarchies with costs, some edges shut out; starts and goals anywhere."""
    values = blueprint_values(seed) if seed % 3 else wide(2 + seed % 2)
    made = blueprint(values)
    hierarchy, dice = Hierarchy(made), random.Random(seed)
    edges = [edge.address for one in made for edge in one.edges()]
    terms = Terms(
        shut=dict.fromkeys(dice.sample(edges, min(3, len(edges))), "avoided"),
        costs={edge: dice.choice((0, 0.5, 2, 3)) for edge in dice.sample(edges, len(edges) // 3)},
    )
    for _ in range(3):
        given = {root: dice.choice(list(made[root].table)) for root in hierarchy.roots}
        try:
            start = start_configuration(hierarchy, given)
        except RunRefused:
            continue
        names = dice.sample(list(made.branches), min(len(made.branches), dice.choice((1, 1, 2))))
        chosen = [n for n in hierarchy.order if n in names]
        yield made, terms, start, [Address(n, dice.choice(list(made[n].table))) for n in chosen]


def plan(
    made: Blueprint, terms: Terms, start: dict[str, str], goals: Sequence[Address]
) -> tuple[Leg, ...] | None:
    return Planner(Hierarchy(made), terms).legs(start, goals)


@pytest.mark.parametrize("seed", SEEDS)
def test_with_bounds_the_search_finds_the_same_legs(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    with_bounds = [plan(*case) for case in cases(seed)]
    monkeypatch.setattr(planner, "CostBounds", lambda *_: nothing)
    assert with_bounds == [plan(*case) for case in cases(seed)]


def test_a_wide_base_is_planned_without_walking_all_that_its_subs_could_do(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made = blueprint(wide(6))
    start = start_configuration(Hierarchy(made), {})
    monkeypatch.setattr(planner, "patience", lambda _: 2**6)
    legs = plan(made, Terms(), start, [Address("SB1", "State111111")])
    assert legs is not None
    assert legs[0].cost == 12
