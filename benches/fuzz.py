"""Broken files for the three readers: 20,000, or with ``--all`` 200,000, over all cores.

Each is read, recovered, salvaged, taken as a blueprint and written back; ``tests/smsl/fuzzing.py``
tells what must hold. ``crashes`` counts invalid answers: a traceback, a fault without a place,
bytes that are not restored.
"""

from __future__ import annotations

import os
import traceback
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import PurePath

from benches.row import Row
from tests.smsl.fuzzing import files, look, sources

SHARE, ALL, PART = 20_000, 200_000, 500


@dataclass
class Count:
    """The results of some files with one suffix."""

    files: int = 0
    accepted: int = 0
    crashes: int = 0
    slowest: float = 0.0
    crash: str = ""

    def add(self, other: Count) -> None:
        """Add the results of other files."""
        self.files += other.files
        self.accepted += other.accepted
        self.crashes += other.crashes
        self.slowest = max(self.slowest, other.slowest)
        self.crash = self.crash or other.crash


def rows() -> Iterator[Row]:
    """A tenth of all files."""
    return _rows(SHARE)


def all_rows() -> Iterator[Row]:
    """Every file that is promised."""
    return _rows(ALL)


def _rows(count: int) -> Iterator[Row]:
    found: dict[str, Count] = {}
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        for part in pool.map(_part, range(1000, 1000 + count // PART)):
            for suffix, one in part.items():
                found.setdefault(suffix, Count()).add(one)
    for suffix, one in sorted(found.items()):
        kind = suffix or "without suffix"
        told = f"{one.accepted:,} opened, {one.files - one.accepted:,} rejected"
        yield Row(f"{one.files:,} broken files {kind}: {told}", one.crashes, "crashes", bound="0")
        yield Row(f"the slowest {kind}, for each 100 KB", one.slowest, "s", bound="below 1")
        if one.crash:
            print(one.crash)


def _part(seed: int) -> dict[str, Count]:
    """Read the files of one seed."""
    sources()
    found: dict[str, Count] = {}
    for raw, file in files(seed, PART):
        count = found.setdefault(PurePath(file).suffix, Count())
        count.files += 1
        try:
            answer = look(raw, file)
        except Exception:
            count.crashes += 1
            count.crash = f"seed {seed}, {file}\n{traceback.format_exc()}"
            continue
        count.accepted += answer.accepted
        count.slowest = max(count.slowest, answer.seconds)
    return found
