"""True runs and forged ones: what ``verify.py`` and ``replay --verify --blueprint`` believe.

The true runs are samples, random scripts and commands, people, faults, and random blueprints of up
to three levels (``tests/front/told_runs.py``). Their stories are changed in ten ways, and the chain
is made anew (``tests/front/forged_runs.py``). ``tests/front/plain_judge.py`` was written apart. It
says which changed stories are impossible for sure. ``apart`` counts stories about which the two
programs disagree. The share that is still believed is told by kind.

All of them, by two processes, so that a stopped count goes on where it was::

    python -m benches.forged --keep forged.jsonl
"""

from __future__ import annotations

import io
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random
from unittest.mock import patch

from benches.row import Row
from benches.shares import asked, counted, shares_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.verifier import told_again
from tests.front.forged_runs import FORGERIES, forged
from tests.front.plain_judge import why_impossible
from tests.front.told_runs import ToldRun, told_runs
from tests.runlog.impossible import Story

TRUE, ALL_TRUE = 200, 10_000
EACH = 10
"""So many forged runs are made for a true one."""
AT_ONCE = 250
"""So many true runs are kept in memory: a share."""
TRUE_RUNS = "true runs"


def rows() -> Iterator[Row]:
    """A fiftieth of all, by this process."""
    parts = shares_of([TRUE_RUNS], 0, TRUE, AT_ONCE)
    yield from _rows(counted(believed, parts)[TRUE_RUNS])


def all_rows() -> Iterator[Row]:
    """All true and all forged runs, by two processes."""
    parts = shares_of([TRUE_RUNS], 0, ALL_TRUE, AT_ONCE)
    yield from _rows(counted(believed, parts, workers=2)[TRUE_RUNS])


def believed(kind: str, first: int, behind: int) -> dict[str, int]:
    """Count what is believed of the true runs of these seeds, and of what is made of them."""
    with tempfile.TemporaryDirectory() as name:
        runs = told_runs(range(first, behind), Path(name))
    counts = Counter({"true": 0, "believed": 0, "apart": 0, "impossible believed": 0})
    for run in runs:
        refusal = told_again(*run)
        counts.update(["true", f"end {Story.of(run.raw).end['reason']}"])
        counts.update({"believed": not refusal, "apart": _differs(run, refusal)})
    random = Random(f"forged {first}")
    while counts["forged"] < EACH * len(runs):
        run = random.choice(runs)
        story = Story.of(run.raw)
        for forgery in FORGERIES:
            changed = forged(story, forgery, random)
            if changed is not None:
                _take(counts, forgery.__name__, ToldRun(changed.raw(), run.blueprint), changed)
    return dict(counts)


def _take(counts: Counter[str], kind: str, run: ToldRun, story: Story) -> None:
    refusal = told_again(*run)
    counts.update(["forged", f"made {kind}"])
    counts["apart"] += _differs(run, refusal)
    if not refusal and why_impossible(story, run.blueprint):
        counts["impossible believed"] += 1
    elif not refusal:
        counts[f"possible {kind}"] += 1


def _differs(run: ToldRun, refusal: str) -> bool:
    """Whether ``replay`` says something else. It asks ``told_again`` about the same bytes and the
    same blueprint again, so that it gets the answer that is known: this saves a third of the time.
    """

    def answered(raw: bytes, blueprint: Blueprint) -> str:
        same = raw == run.raw and blueprint is run.blueprint
        return refusal if same else told_again(raw, blueprint)

    with patch("smsl_studio.front.verifier.told_again", answered):
        verdict = verify_stream(io.BytesIO(run.raw), "log", run.blueprint)
    return (verdict.doubt is None) == bool(refusal)


def _rows(counts: Counter[str]) -> Iterator[Row]:
    ends = sorted(name for name in counts if name.startswith("end "))
    words = ", ".join(f"{counts[name]:,} {name.removeprefix('end ')}" for name in ends)
    yield Row(f"{counts['true']:,} true runs ({words})", counts["believed"], "believed",
              bound=str(counts["true"]))  # fmt: skip
    kinds = [forgery.__name__ for forgery in FORGERIES if counts[f"made {forgery.__name__}"]]
    shares = ", ".join(
        f"{kind.replace('_', ' ')} {counts[f'possible {kind}'] / counts[f'made {kind}']:.0%} "
        f"of {counts[f'made {kind}']:,}"
        for kind in kinds
    )
    yield Row(f"{counts['forged']:,} forged runs; still possible: {shares}",
              counts["impossible believed"], "impossible ones believed", bound="0")  # fmt: skip
    yield Row("the two programs", counts["apart"], "stories apart", bound="0")


if __name__ == "__main__":
    told = asked("Count forged runs that are believed.", ALL_TRUE)
    parts = shares_of([TRUE_RUNS], told.first, told.behind, AT_ONCE)
    for row in _rows(counted(believed, parts, told.workers, told.keep)[TRUE_RUNS]):
        print(f"{row.work}: {row.ours:g} {row.unit}", flush=True)
