"""10,000 random sequences of acts in a real window: after each act all its parts must agree.

An act adds a state or an operation, renames, moves, deletes, undoes, redoes, saves, opens the file
again, shows another mode, tab, SB or fact, or runs a few operations in a table world. After each
act the drawing, the selection, Properties, the outline, the title, the text, the history and the
blueprint are compared (``tests/sequences/agreement.py``). Saved files are read back with their
positions. Without ``--all`` it runs a tenth. ``python -m tests.sequences NUMBER`` shows one
sequence again.

All of them, so that a stopped count goes on where it was::

    python -m benches.sequences --keep sequences.jsonl
"""

from __future__ import annotations

import os
import sys
import time
from collections import Counter
from collections.abc import Iterator

from benches.row import Row
from benches.shares import asked, counted, shares_of

ALL, SOME = 10_000, 1_000
SHARE = 50
"""The number of sequences in one window before another window is opened."""
KIND, WORKERS = "sequences", 2


def rows() -> Iterator[Row]:
    """Run a tenth of the sequences."""
    return _rows(counted(_share, shares_of([KIND], 0, SOME, SHARE), WORKERS)[KIND])


def all_rows() -> Iterator[Row]:
    """Run all sequences, which takes an hour of two cores."""
    return _rows(counted(_share, shares_of([KIND], 0, ALL, SHARE), WORKERS)[KIND])


def _rows(counts: Counter[str]) -> Iterator[Row]:
    count = counts[KIND]
    yield Row(f"{count:,} random sequences at a window, something does not agree in",
              counts["findings"], "sequences", bound="0")  # fmt: skip
    yield Row("one sequence and what is compared", counts["CPU ms"] / count)


def _share(_: str, first: int, behind: int) -> dict[str, int]:
    """Run one share at a window without a display. Its findings are printed."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from smsl_studio.studio.shell.application import make_application
    from tests.sequences.shares import findings

    application = make_application(["sequences"])
    began = time.process_time()
    found = list(findings(first, behind))
    application.processEvents()
    print(*found, sep="\n", end="\n" * bool(found), file=sys.stderr, flush=True)
    spent = round((time.process_time() - began) * 1000)
    return {KIND: behind - first, "findings": len(found), "CPU ms": spent}


if __name__ == "__main__":
    told = asked("Run random sequences of acts at a window.", ALL)
    parts = shares_of([KIND], told.first, told.behind, SHARE)
    for row in _rows(counted(_share, parts, told.workers, told.keep)[KIND]):
        print(f"{row.work}: {row.ours:g} {row.unit}", flush=True)
