"""Broken files for every importer of other programs' forms: 2,000 each, over all cores. And 1,000
random blueprints, written in each form that holds a whole one and read again.

``crashes`` counts what is neither a blueprint nor an error with a place. The memory is that of a
process that read them all.
"""

from __future__ import annotations

import os
import resource
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import smsl_studio as smsl
from benches.row import Row
from smsl_studio.errors import ReadError
from tests.exchange.again import WHOLE, random_blueprint, read_text, text_of
from tests.exchange.broken import NAMES, broken, put

MANY, BLUEPRINTS = 2_000, 1_000


class Tried(NamedTuple):
    """What became of the files of one importer."""

    name: str
    opened: int
    crashes: int
    slowest: float
    megabytes: float


def rows() -> Iterator[Row]:
    """Three rows for each importer, and one for each form that holds a whole blueprint."""
    for suffix in WHOLE:
        changed = 0
        for seed in range(BLUEPRINTS):
            blueprint = random_blueprint(seed)
            again, findings = read_text(text_of(blueprint, suffix), f"x{suffix}")
            changed += again != blueprint or bool(findings)
        work = f"{BLUEPRINTS:,} random blueprints to {suffix} and back"
        yield Row(work, changed, "changed", bound="0")
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn"), max_tasks_per_child=1) as pool:
        for one in pool.map(_tried, NAMES):
            told = f"{one.opened:,} opened, {MANY - one.opened:,} refused"
            work = f"{MANY:,} broken files {one.name}: {told}"
            yield Row(work, one.crashes, "crashes", bound="0")
            yield Row(f"the slowest {one.name}", one.slowest, "s", bound="below 2")
            yield Row(f"the memory for {one.name}", one.megabytes, "MB", bound="below 600")


def _tried(name: str) -> Tried:
    opened = crashes = 0
    slowest = 0.0
    with TemporaryDirectory() as folder:
        for number, raw in enumerate(broken(2, MANY, name)):
            file = put(raw, name, Path(folder) / str(number))
            start = time.process_time()
            try:
                smsl.digest(smsl.imported(file).blueprint)
                opened += 1
            except ReadError as error:
                crashes += error.place is None
            except Exception as error:
                crashes += 1
                print(name, number, repr(error))
            slowest = max(slowest, time.process_time() - start)
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return Tried(name, opened, crashes, slowest, used)
