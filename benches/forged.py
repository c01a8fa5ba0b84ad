"""True runs and forged ones: what ``verify.py`` and ``replay --verify --blueprint`` believe.

The true runs are samples, random scripts and commands, people, faults, and random blueprints of up
to three levels (``tests/front/told_runs.py``). Their stories are changed in ten ways, and the chain
is made anew (``tests/front/forged_runs.py``). ``tests/front/plain_judge.py`` was written apart. It
says which changed stories are impossible for sure. ``apart`` counts stories about which the two
programs disagree. The share that is still believed is told by kind.
"""

from __future__ import annotations

import io
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from random import Random

from benches.row import Row
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.verifier import told_again
from tests.front.forged_runs import FORGERIES, forged
from tests.front.plain_judge import why_impossible
from tests.front.told_runs import ToldRun, told_runs
from tests.runlog.impossible import Story

TRUE, FORGED = 200, 2_000
ALL_TRUE, ALL_FORGED = 10_000, 100_000
AT_ONCE = 250
"""So many runs are kept in memory."""


def rows() -> Iterator[Row]:
    """A fiftieth of all."""
    return _rows(TRUE, FORGED)


def all_rows() -> Iterator[Row]:
    """All true and all forged runs."""
    return _rows(ALL_TRUE, ALL_FORGED)


class _Counts:
    """What was believed of the runs so far."""

    def __init__(self) -> None:
        self.true, self.believed, self.apart = 0, 0, 0
        self.ends = Counter[str]()
        self.seen: dict[str, Counter[str]] = defaultdict(Counter)

    def take_true(self, run: ToldRun) -> None:
        self.true += 1
        self.believed += not told_again(*run)
        self.apart += self._differs(run, told_again(*run))
        self.ends[Story.of(run.raw).end["reason"]] += 1

    def take_forged(self, kind: str, run: ToldRun, story: Story) -> None:
        refusal = told_again(*run)
        self.apart += self._differs(run, refusal)
        if refusal:
            self.seen[kind]["refused"] += 1
        else:
            wrong = bool(why_impossible(story, run.blueprint))
            self.seen[kind]["impossible" if wrong else "possible"] += 1

    def _differs(self, run: ToldRun, refusal: str) -> bool:
        verdict = verify_stream(io.BytesIO(run.raw), "log", run.blueprint)
        return (verdict.doubt is None) == bool(refusal)


def _rows(true: int, many: int) -> Iterator[Row]:
    counts = _Counts()
    for first in range(0, true, AT_ONCE):
        with tempfile.TemporaryDirectory() as name:
            runs = told_runs(range(first, min(first + AT_ONCE, true)), Path(name))
        _take(counts, runs, many * len(runs) // true, first)
    words = ", ".join(f"{count:,} {reason}" for reason, count in sorted(counts.ends.items()))
    yield Row(f"{counts.true:,} true runs ({words})", counts.believed, "believed",
              bound=str(counts.true))  # fmt: skip
    total = sum(seen.total() for seen in counts.seen.values())
    wrong = sum(seen["impossible"] for seen in counts.seen.values())
    shares = ", ".join(
        f"{kind.replace('_', ' ')} {seen['possible'] / seen.total():.0%} of {seen.total():,}"
        for kind, seen in counts.seen.items()
    )
    yield Row(f"{total:,} forged runs; still possible: {shares}", wrong,
              "impossible ones believed", bound="0")  # fmt: skip
    yield Row("the two programs", counts.apart, "stories apart", bound="0")


def _take(counts: _Counts, runs: list[ToldRun], many: int, seed: int) -> None:
    """Take true runs, and so many that are made of them, of all kinds alike."""
    for run in runs:
        counts.take_true(run)
    random = Random(f"forged {seed}")
    made = 0
    while made < many:
        run = random.choice(runs)
        story = Story.of(run.raw)
        for forgery in FORGERIES:
            changed = forged(story, forgery, random)
            if changed is not None:
                counts.take_forged(forgery.__name__, ToldRun(changed.raw(), run.blueprint), changed)
                made += 1
