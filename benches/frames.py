"""100,000 frames that are random, cut, doubled, out of order or of another session, at the socket
of a served world: how many operations they begin, and how many programs were not sent away.

Each is drawn from a number (``tests/channel/frame_trials.py``). All of them, by two processes, so
that a stopped count goes on where it was::

    python -m benches.frames --keep frames.jsonl
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from benches.row import Row
from benches.shares import asked, counted, shares_of
from tests.channel.frame_trials import KINDS, Trials

COUNT = 100_000
EACH = COUNT // len(KINDS)
"""So many seeds for each kind."""
SOME = 250


def rows() -> Iterator[Row]:
    """An eightieth of all, by this process."""
    began = time.process_time()
    yield from _rows(counted(tried, shares_of([*KINDS], 0, SOME)))
    yield Row("one program", (time.process_time() - began) * 1000 / (SOME * len(KINDS)))


def all_rows() -> Iterator[Row]:
    """All, by two processes."""
    yield from _rows(counted(tried, shares_of([*KINDS], 0, EACH), workers=2))


def tried(kind: str, first: int, behind: int) -> dict[str, int]:
    """Count the programs of these seeds: all, the operations begun, those not sent away."""
    with TemporaryDirectory() as folder:
        trials = Trials(Path(folder))
        try:
            kept = sum(not trials.tried(kind, number) for number in range(first, behind))
        finally:
            trials.close()
        return {"tried": behind - first, "begun": trials.begun, "kept": kept}


def _rows(sums: Mapping[str, Counter[str]]) -> Iterator[Row]:
    for kind, counts in sums.items():
        what = f"{counts['tried']:,} programs with frames that are wrong ({kind})"
        yield Row(f"{what}: operations begun", counts["begun"], "", bound="0")
        yield Row(f"{what}: not sent away", counts["kept"], "", bound="0")


if __name__ == "__main__":
    told = asked("Count operations that wrong frames begin.", EACH, [*KINDS])
    parts = shares_of([told.kind] if told.kind else [*KINDS], told.first, told.behind)
    for row in _rows(counted(tried, parts, told.workers, told.keep)):
        print(f"{row.work}: {row.ours:g}", flush=True)
