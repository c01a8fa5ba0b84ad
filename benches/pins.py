"""Drawings that are tidied around pinned states: how many break a promise, of 300 random ones.

A pinned state stays to the last digit, no node covers another one (but a pinned one a pinned one),
and a drawing that is tidied again stays as it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from benches.row import Row
from smsl_studio.graph.tidied import tidied
from tests.graph.pinned import covered, random_case

CASES = 300


def rows() -> Iterator[Row]:
    """Measure the rows of this bench."""
    moved = covers = unsteady = 0
    for seed in range(CASES):
        branch, shown, kind = random_case(Random(seed))
        found = tidied(branch, shown, kind=kind)
        moved += any(found[name] != shown[name] for name in branch.notes.pinned)
        covers += bool(covered(branch, found))
        unsteady += tidied(branch, found, kind=kind) != found
    for words, figure in (
        ("a pinned state moved", moved),
        ("a state covers another", covers),
        ("tidied again it differs", unsteady),
    ):
        yield Row(f"{CASES} drawings around pins: {words}", figure, "drawings", bound="0")
