"""The seeds of random counts: all of a bench or a part of them, with progress.

``--seeds=A:B`` runs the seeds from A up to B, without B. So a long count can be split among days or
processors: the figures of the parts are added. Progress stands on standard error every half minute.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator

EVERY = 30.0
"""Seconds of wall time from one word about progress to the next."""


def chosen(words: str, begin: int, count: int) -> Iterator[int]:
    """Yield ``count`` seeds from ``begin`` on, or those that ``--seeds=A:B`` chooses, and tell how
    far the work is. SystemExit if the option cannot be read."""
    first, last = begin, begin + count
    for given in sys.argv:
        if given.startswith("--seeds="):
            first, last = _range(given.partition("=")[2])
    print(f"{words}: seeds {first} to {last - 1}", file=sys.stderr, flush=True)
    told = time.monotonic()
    for seed in range(first, last):
        if time.monotonic() - told > EVERY:
            told = time.monotonic()
            done = f"{words}: {seed - first:,} of {last - first:,} are done"
            spent = f"{time.process_time():,.0f} s of CPU time; next is seed {seed}"
            print(f"{done}, {spent}", file=sys.stderr, flush=True)
        yield seed


def is_part() -> bool:
    """Whether a part of the seeds was chosen, so that nothing else is measured."""
    return any(given.startswith("--seeds=") for given in sys.argv)


def _range(text: str) -> tuple[int, int]:
    first, _, last = text.partition(":")
    if not (first.isdecimal() and last.isdecimal() and int(first) < int(last)):
        raise SystemExit("--seeds=A:B needs two whole numbers, A below B")
    return int(first), int(last)
