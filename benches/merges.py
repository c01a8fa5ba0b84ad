"""2,000 random three-way merges against the oracle of the tests, and each with its sides swapped.

The oracle merges lists of facts about a blueprint and knows nothing of trees or texts (see
``tests/blueprint/merge/sides.py``). Without ``--all`` it runs a tenth. A finding is printed with
the number of the merge.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from time import process_time

from benches.row import Row
from smsl_studio.blueprint.merge import merge
from tests.blueprint.merge.random_merges import (
    check_against_the_oracle,
    check_that_it_is_readable,
    check_the_other_order,
    sides,
)

ALL, SOME = 2_000, 200


def rows() -> Iterator[Row]:
    """Merge a tenth."""
    return _rows(SOME)


def all_rows() -> Iterator[Row]:
    """Merge all, about a minute."""
    return _rows(ALL)


def _rows(count: int) -> Iterator[Row]:
    found = conflicts = 0
    spent = 0.0
    for number in range(count):
        base, ours, theirs = sides(number, renames=False)
        try:
            done = check_against_the_oracle(base, ours, theirs)
            check_that_it_is_readable(done)
            check_the_other_order(*sides(number, renames=True))
        except AssertionError as error:
            found += 1
            print(f"merge {number}: {error}", file=sys.stderr)
            continue
        conflicts += len(done.conflicts)
        begin = process_time()
        merge(base, ours, theirs)
        spent += process_time() - begin
    words = f"{count:,} random merges, {conflicts:,} conflicts"
    yield Row(f"{words}: findings", found, "merges", bound="0")
    yield Row(f"{words}: one merge", spent / count * 1000)
