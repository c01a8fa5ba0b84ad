"""True runs and forged ones: what ``verify.py`` and ``replay --verify --blueprint`` believe.

The true runs are samples, random scripts and commands, people, faults, and random blueprints of up
to three levels (``tests/front/told_runs.py``). Their stories are changed in ten ways, and the chain
is made anew (``tests/front/forged_runs.py``). ``tests/front/plain_judge.py`` was written apart. It
says which changed stories are impossible for sure. ``apart`` counts stories about which the two
programs disagree. The share that is still believed is told by kind.

Then the head of a log is signed (``tests/front/forged_heads.py``): the true story of every tenth
run and three forged ones, each with the right key, a revoked one, a person's and an unknown one.
Only the right key may be believed, and only where the story is.

All of them, by two processes, so that a stopped count goes on where it was::

    python -m benches.forged --keep forged.jsonl
"""

from __future__ import annotations

import io
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from random import Random
from unittest.mock import patch

from benches.row import Row
from benches.shares import Share, asked, counted, shares_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.verifier import told_again
from tests.front.forged_heads import (
    RIGHT,
    SIGNERS,
    headed,
    is_believed_by_replay,
    is_believed_here,
    known_keys,
)
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
HEADS, ALL_HEADS = "heads", 1_000
"""So many true runs have the heads of their logs signed."""
FORGED_HEADS = 3
"""So many forged stories are signed for a true one."""


def rows() -> Iterator[Row]:
    """A fiftieth of all, by this process."""
    yield from _rows(counted(believed, _parts(0, TRUE)))


def all_rows(keep: Path | None = None) -> Iterator[Row]:
    """All true and all forged runs, by two processes. ``keep`` is the file of what was counted
    before.
    """
    yield from _rows(counted(believed, _parts(0, ALL_TRUE), workers=2, keep=keep))


def _parts(first: int, behind: int) -> list[Share]:
    """The true runs of these seeds, and a tenth of them with signed heads."""
    share = ALL_TRUE // ALL_HEADS
    heads = shares_of([HEADS], first // share, behind // share, AT_ONCE)
    return shares_of([TRUE_RUNS], first, behind, AT_ONCE) + heads


def believed(kind: str, first: int, behind: int) -> dict[str, int]:
    """Count what is believed of the true runs of these seeds, and of what is made of them."""
    with tempfile.TemporaryDirectory() as name:
        runs = told_runs(range(first, behind), Path(name))
    if kind == HEADS:
        return heads_believed(runs, Random(f"heads {first}"))
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


def heads_believed(runs: Sequence[ToldRun], random: Random) -> dict[str, int]:
    """Count, by the key that signs its head, which logs are believed, of true and forged stories.

    ``wrong`` counts those that must not be, and ``apart`` those about which the two programs
    disagree.
    """
    counts = Counter({"wrong": 0, "apart": 0})
    with known_keys():
        for run in runs:
            story = Story.of(run.raw)
            forgeries = random.sample(FORGERIES, FORGED_HEADS)
            others = (forged(story, forgery, random) for forgery in forgeries)
            for one in (story, *filter(None, others)):
                raw = run.raw if one is story else one.raw()
                possible = not told_again(raw, run.blueprint)
                for key, signer in SIGNERS.items():
                    told = ToldRun(headed(raw, signer), run.blueprint)
                    here, there = is_believed_here(told), is_believed_by_replay(told)
                    counts.update([f"made {key}"], **{f"believed {key}": here})
                    counts["wrong"] += here != (possible and key == RIGHT)
                    counts["apart"] += here != there
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


def _rows(sums: Mapping[str, Counter[str]]) -> Iterator[Row]:
    counts = sums[TRUE_RUNS]
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
    heads = sums.get(HEADS, Counter())
    for key in SIGNERS:
        made = heads[f"made {key}"]
        most = "possible stories" if key == RIGHT else "0"
        yield Row(f"{made:,} heads signed with {key}", heads[f"believed {key}"], "believed",
                  bound=most)  # fmt: skip
    yield Row("signed heads", heads["wrong"] + heads["apart"], "wrongly believed, or apart",
              bound="0")  # fmt: skip


if __name__ == "__main__":
    told = asked("Count forged runs that are believed.", ALL_TRUE)
    parts = _parts(told.first, told.behind)
    for row in _rows(counted(believed, parts, told.workers, told.keep)):
        print(f"{row.work}: {row.ours:g} {row.unit}", flush=True)
