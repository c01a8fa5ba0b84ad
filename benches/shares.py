"""Long counts in shares, so that they can go on after a stop and use two processes.

A share is a range of seeds. Its counts are a line of JSON in a file that the caller may name: a
share that stands there is not counted again. After each share a line on standard error says how far
the count is. Equal seeds give equal counts, however many processes there are.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

Work = Callable[[str, int, int], dict[str, int]]
"""Counts the seeds of a kind from the first to one before the second."""
SMALL = 1_250
"""So many seeds are a share, if nothing else is said."""


@dataclass(frozen=True)
class Share:
    """A range of seeds of one kind."""

    kind: str
    first: int
    behind: int

    @property
    def name(self) -> str:
        """What stands in the file."""
        return f"{self.kind} {self.first}-{self.behind}"


def shares_of(kinds: Sequence[str], first: int, behind: int, size: int = SMALL) -> list[Share]:
    """All shares of a range of seeds, for each kind."""
    return [
        Share(kind, at, min(at + size, behind))
        for kind in kinds
        for at in range(first, behind, size)
    ]


def counted(
    work: Work, shares: Sequence[Share], workers: int = 1, keep: Path | None = None
) -> dict[str, Counter[str]]:
    """Count all shares, and return the sums by kind. ``keep`` is the file of what was counted."""
    done = dict(_kept(keep))
    began = time.monotonic()
    for number, (share, counts) in enumerate(_results(work, shares, workers, done), 1):
        if keep is not None and share.name not in done:
            with keep.open("a", encoding="utf-8") as file:
                # A stop may have cut the last line, so each begins behind a line end.
                file.write("\n" + json.dumps({"share": share.name, "counts": counts}) + "\n")
        done[share.name] = counts
        words = ", ".join(f"{count:,} {name}" for name, count in counts.items())
        late = time.monotonic() - began
        print(f"{number} of {len(shares)}, {late:.0f} s: {share.name}: {words}",
              file=sys.stderr, flush=True)  # fmt: skip
    sums: dict[str, Counter[str]] = {share.kind: Counter() for share in shares}
    for share in shares:
        sums[share.kind].update(done[share.name])
    return sums


def _results(
    work: Work, shares: Sequence[Share], workers: int, done: dict[str, dict[str, int]]
) -> Iterator[tuple[Share, dict[str, int]]]:
    yield from ((share, done[share.name]) for share in shares if share.name in done)
    left = [share for share in shares if share.name not in done]
    if workers == 1:
        yield from ((share, work(share.kind, share.first, share.behind)) for share in left)
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=context) as pool:
        asked: dict[Future[dict[str, int]], Share] = {
            pool.submit(work, share.kind, share.first, share.behind): share for share in left
        }
        for future in as_completed(asked):
            yield asked[future], future.result()


def _kept(keep: Path | None) -> Iterator[tuple[str, dict[str, int]]]:
    """What was counted before. A last line that was cut is not taken."""
    for line in keep.read_text("utf-8").splitlines() if keep and keep.exists() else ():
        with suppress(ValueError):
            said = json.loads(line)
            yield said["share"], said["counts"]


@dataclass(frozen=True)
class Asked:
    """What the command line asks for: a range of seeds, processes, a file to go on from, and one
    kind alone if it is not empty.
    """

    first: int
    behind: int
    workers: int
    keep: Path | None
    kind: str = ""


def asked(usage: str, behind: int, kinds: Sequence[str] = ()) -> Asked:
    """Read the command line of one bench. ``behind`` is the usual end of the seeds, and ``kinds``
    are what it counts, if one of them can be counted alone.
    """
    parser = argparse.ArgumentParser(description=usage)
    parser.add_argument("--from", dest="first", type=int, default=0, metavar="SEED")
    parser.add_argument("--to", dest="behind", type=int, default=behind, metavar="SEED")
    parser.add_argument("--workers", type=int, default=2, help="processes (default 2)")
    parser.add_argument("--keep", type=Path, metavar="FILE", help="go on from this file")
    if kinds:
        parser.add_argument("--kind", choices=kinds, default="", help="this kind alone")
    return Asked(**vars(parser.parse_args()))
