"""The map of branches: cards do not touch, and no line passes through a card."""

from __future__ import annotations

from itertools import combinations, pairwise
from random import Random

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.picture.branch_map import WIDE, BranchMap, MapCard, branch_map
from smsl_studio.picture.branch_map_svg import map_panel
from smsl_studio.picture.colours import LIGHT
from tests.counts import share_of
from tests.dispatch.runs import blueprint, branch, sample


def any_blueprint(chance: Random) -> Blueprint:
    """Up to ten SBs, each fact expanded by any of them or by one that does not exist."""
    names = [f"B{number}" for number in range(chance.randrange(1, 11))]
    made = {}
    for name in names:
        facts = chance.randrange(1, 5)
        digits = [digit for digit in range(facts) if chance.random() < 0.5]
        chosen = chance.sample([*names, "GONE"], min(len(digits), len(names)))
        subs = dict(zip(chosen, digits, strict=False))
        made[name] = branch({"0" * facts: "up>" + "1" * facts, "1" * facts: ""}, subs=subs)
    return blueprint(made)


def touches(card: MapCard, a: tuple[float, float], b: tuple[float, float]) -> bool:
    """Whether an upright or level line passes through the inside of a card."""
    left, right = sorted((a[0], b[0]))
    top, bottom = sorted((a[1], b[1]))
    beside = right <= card.left or left >= card.left + WIDE
    return not (beside or bottom <= card.top or top >= card.top + card.height)


def overlap(one: MapCard, other: MapCard) -> bool:
    """Whether two cards cover the same place."""
    corners = (other.left, other.top), (other.left + WIDE, other.top + other.height)
    return touches(one, *corners)


def upright(drawn: BranchMap) -> list[tuple[float, float, float, str]]:
    """The upright parts of all lines: place, top, bottom, and where the line leads."""
    parts = ((a, b, link.sub) for link in drawn.links for a, b in pairwise(link.line))
    return [(a[0], min(a[1], b[1]), max(a[1], b[1]), sub) for a, b, sub in parts if a[0] == b[0]]


@pytest.mark.parametrize("seed", range(share_of(150)))
def test_cards_are_apart_and_lines_pass_beside_them(seed: int) -> None:
    made = any_blueprint(Random(seed))
    drawn = branch_map(made)
    assert set(drawn.cards) == set(made.branches)
    for one, other in combinations(drawn.cards.values(), 2):
        assert not overlap(one, other)
    for link in drawn.links:
        for a, b in pairwise(link.line):
            assert a[0] == b[0] or a[1] == b[1]
            assert not any(touches(card, a, b) for card in drawn.cards.values())
    for (x, top, end, _), (beside, start, bottom, _) in combinations(upright(drawn), 2):
        assert abs(x - beside) > 1.0 or end <= start or bottom <= top
    every = [(name, digit, sub) for name in made.branches for digit, sub in made[name].subs.items()]
    there = {(link.base, link.digit, link.sub) for link in drawn.links}
    assert there == {one for one in every if one[2] in made.branches}


def test_a_line_leaves_the_row_of_its_fact_and_ends_at_its_sub() -> None:
    drawn = branch_map(sample("three-levels"))
    (first, second) = drawn.links
    assert (first.base, first.sub) == ("SURGERY", "REGISTRATION")
    base, sub = drawn.cards["SURGERY"], drawn.cards["REGISTRATION"]
    assert first.line[0] == (base.left + WIDE, base.row(first.digit))
    assert first.line[-1][0] == sub.left
    assert second.line[-1][0] == drawn.cards["DIGITIZATION"].left


def test_subs_that_expand_each_other_are_drawn() -> None:
    made = blueprint(
        {
            "A": branch({"0": "up>1", "1": ""}, subs={"B": 0}),
            "B": branch({"0": "up>1", "1": ""}, subs={"A": 0}),
        }
    )
    drawn = branch_map(made)
    assert [(link.base, link.sub) for link in drawn.links] == [("A", "B"), ("B", "A")]
    assert drawn.cards["B"].left > drawn.cards["A"].left


def test_a_sub_that_does_not_exist_is_said_on_the_card() -> None:
    made = blueprint({"A": branch({"0": "up>1", "1": ""}, subs={"GONE": 0})})
    assert branch_map(made).links == ()
    assert "GONE, which does not exist" in map_panel(made, LIGHT).svg


def test_no_branches_are_an_empty_map() -> None:
    drawn = branch_map(blueprint({}))
    assert (dict(drawn.cards), drawn.links, drawn.width) == ({}, (), 0.0)
