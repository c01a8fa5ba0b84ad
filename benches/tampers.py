"""100,000 tampers with approvals: how many of them are let through.

Each is drawn from a number (``tests/inspection/approval/tampers.py``), so that a finding can be
looked at again. A tamper is let through if the blueprint counts as approved all the same. A changed
byte that changes no meaning of a blueprint does not count. Two more kinds change a log or another
file of a bundle (``tests/front/bundle_tampers.py``). They are let through if ``verify.py`` says
that the bundle is consistent. It tells reasons and no codes.

All of them, by two processes, so that a stopped count goes on where it was::

    python -m benches.tampers --keep tampers.jsonl

``--kind register`` counts one kind alone.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from benches.row import Row
from benches.shares import asked, counted, shares_of
from tests.front.bundle_tampers import BUNDLE_KINDS, is_let_through
from tests.inspection.approval.tampers import FITS, KINDS, tampered

COUNT = 100_000
ALL_KINDS = [*KINDS, *BUNDLE_KINDS]
EACH = -(-COUNT // len(ALL_KINDS))
"""So many seeds for each kind."""
SOME = 250


def rows() -> Iterator[Row]:
    """A twenty-fifth of all, by this process."""
    began = time.process_time()
    yield from _rows(counted(tried, shares_of(ALL_KINDS, 0, SOME)))
    yield Row("one tamper", (time.process_time() - began) * 1000 / (SOME * len(ALL_KINDS)))


def all_rows(keep: Path | None = None) -> Iterator[Row]:
    """All, by two processes. ``keep`` is the file of what was counted before."""
    yield from _rows(counted(tried, shares_of(ALL_KINDS, 0, EACH), workers=2, keep=keep))


def tried(kind: str, first: int, behind: int) -> dict[str, int]:
    """Count the tampers of these seeds: all, those let through, and those of no fitting code."""
    counts = Counter(tried=0, through=0, unfit=0)
    for number in range(first, behind):
        if kind in BUNDLE_KINDS:
            through = is_let_through(kind, number)
            counts.update(tried=through is not None, through=bool(through))
            continue
        found = tampered(kind, number)
        if found is not None:
            codes = found[1]
            counts.update(tried=1, through=not codes, unfit=not codes & FITS[kind])
            counts.update(f"told {code}" for code in codes)
    return dict(counts)


def _rows(sums: Mapping[str, Counter[str]]) -> Iterator[Row]:
    for kind, counts in sums.items():
        yield Row(f"{counts['tried']:,} tampers, {kind}: let through", counts["through"], "",
                  bound="0")  # fmt: skip
        if kind in KINDS:
            yield Row(f"{kind}: told by a code that does not fit", counts["unfit"], "", bound="0")


if __name__ == "__main__":
    told = asked("Count tampers that are let through.", EACH, ALL_KINDS)
    parts = shares_of([told.kind] if told.kind else ALL_KINDS, told.first, told.behind)
    for row in _rows(counted(tried, parts, told.workers, told.keep)):
        print(f"{row.work}: {row.ours:g}", flush=True)
