"""The engine of proofs beside Debian's Spin, both whole: a condition that never holds, and one that
can hold, at three sizes of four kinds of spaces.

Ours is the whole command ``check``. Spin's is ``spin -a``, ``gcc -O2 -DSAFETY -DNOREDUCE`` and
``pan``, breadth first (``-DBFS``) for the shortest run. The model for Spin is written from the
product steps (``benches/spin/promela.py``). Numbers of configurations and lengths of runs must be
equal. Beside them stands what our command takes for two states: its start, which is most of the
time and of the memory at the smallest sizes. Needs ``spin`` and ``gcc`` (Debian packages). Without
``--all`` only the smallest sizes run.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from benches.row import Row
from benches.spin.models import SpinModel, models
from benches.spin.sides import Work, ours, spins, starts

HOLDS, FAILS, SPACE = "at most 0.1x", "at most 0.25x", "at most 0.25x"


def rows() -> Iterator[Row]:
    """The smallest of each kind."""
    return _rows(1)


def all_rows() -> Iterator[Row]:
    """All sizes, some minutes."""
    return _rows(3)


def _rows(sizes: int) -> Iterator[Row]:
    for program in ("spin", "gcc"):
        if shutil.which(program) is None:
            raise SystemExit(f"{program} is not installed (apt install spin gcc)")
    with tempfile.TemporaryDirectory() as name:
        start = starts(Path(name))
    for _, kind in groupby(models(), key=lambda model: model.kind):
        for model in list(kind)[:sizes]:
            yield from _model(model, start)


def _model(model: SpinModel, start: Work) -> Iterator[Row]:
    count = 0
    for fails in (False, True):
        what = "a run that fails" if fails else "all of it"
        print(f"spin: {model.words}, {what}", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            own = ours(model, fails, folder)
            count = count or own.configurations
            other = spins(model, fails, folder, count + 1_000)
        wrong = _wrong(own, other, fails)
        if wrong:
            raise SystemExit(f"{model.words}: {wrong}")
        what = f"a shortest run of {own.steps:,} operations" if fails else "never"
        own_start = "our start alone"
        space = (("pan", other.megabytes), (own_start, start.megabytes))
        work = f"{model.words}, {count:,} configurations: {what}"
        sides = (
            ("Spin whole", other.seconds),
            ("pan alone", other.alone),
            (own_start, start.seconds),
        )
        yield Row(work, own.seconds, "CPU s", sides, FAILS if fails else HOLDS)
        yield Row(f"{work}, memory", own.megabytes, "MB", space, SPACE)


def _wrong(own: Work, other: Work, fails: bool) -> str:
    """Say in what the answers differ. The text is empty if they do not."""
    if fails:
        return "" if own.steps == other.steps else f"{own.steps} and {other.steps} operations"
    one, two = own.configurations, other.configurations
    return "" if one == two else f"{one:,} and {two:,} configurations"
