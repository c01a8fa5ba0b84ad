"""How far states move that an edit did not touch, when the drawing is tidied after the edit.

There are 1,000 random edits of 50 drawings. Each edit gives the median over its untouched states.
The figures are the median over all edits, and the share of edits with at most 40 pixels. A drawing
that is always laid out anew stands beside them for comparison.
"""

from __future__ import annotations

import statistics
from collections.abc import Iterator
from random import Random

from benches.row import Row
from smsl_studio.graph.layout import place_anew, place_states
from smsl_studio.graph.tidied import tidied
from tests.graph.edited import edited, random_branch

DRAWINGS, EDITS, NEAR = 50, 20, 40.0


def rows() -> Iterator[Row]:
    """Measure the rows of this bench."""
    medians: list[float] = []
    anew: list[float] = []
    for seed in range(DRAWINGS):
        chance = Random(seed)
        branch = random_branch(chance)
        places = tidied(branch, place_states(branch))
        for _ in range(EDITS):
            before = place_anew(branch)
            branch, places, far = edited(branch, places, chance)
            medians.append(statistics.median(far))
            after = place_anew(branch)
            both = before.keys() & after.keys()
            anew.append(
                statistics.median(
                    max(abs(after[n][0] - before[n][0]), abs(after[n][1] - before[n][1]))
                    for n in both
                )
            )
    work = f"{len(medians):,} edits and tidy: the median movement"
    yield Row(
        work,
        statistics.median(medians),
        "px",
        others=(("laid out anew", statistics.median(anew)),),
        bound="at most 40",
    )
    near = 100.0 * sum(far <= NEAR for far in medians) / len(medians)
    kept = 100.0 * sum(far <= NEAR for far in anew) / len(anew)
    yield Row(
        "edits after which the median is at most 40 px", near, "%", (("laid out anew", kept),)
    )
