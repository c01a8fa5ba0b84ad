"""Random merges against an oracle: nothing lost, nothing invented, conflicts where both changed."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.merge import merge
from tests.blueprint.merge.random_merges import (
    check_against_the_oracle,
    check_that_it_is_readable,
    check_the_other_order,
    sides,
)
from tests.blueprint.merge.sides import things
from tests.counts import share_of

COUNT = share_of(100)
PARTS = COUNT // 25


@pytest.mark.parametrize("part", range(PARTS))
def test_random_merges_keep_what_one_side_changed(part: int) -> None:
    conflicts = 0
    for number in range(part, COUNT, PARTS):
        base, ours, theirs = sides(number, renames=False)
        done = check_against_the_oracle(base, ours, theirs)
        check_that_it_is_readable(done)
        conflicts += len(done.conflicts)
    assert conflicts > 10


@pytest.mark.parametrize("part", range(PARTS))
def test_the_order_of_the_sides_only_changes_which_one_conflicts_keep(part: int) -> None:
    for number in range(part, COUNT, PARTS):
        base, ours, theirs = sides(number, renames=number % 2 == 0)
        check_the_other_order(base, ours, theirs)


@pytest.mark.parametrize("part", range(PARTS))
def test_a_side_that_changed_nothing_takes_the_other(part: int) -> None:
    for number in range(part, COUNT, PARTS):
        base, ours, _ = sides(number, renames=True)
        for done in (merge(base, ours, base), merge(base, base, ours), merge(base, ours, ours)):
            assert done.conflicts == (), number
            assert things(done.blueprint) == things(ours), number
