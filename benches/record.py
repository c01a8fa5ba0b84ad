"""The log of a run: 10,000 changed logs, kill -9 of its writer, and the cost of the chain.

``tests/runlog/logs.py`` has the ways in which a log is changed, cut, reordered or encoded anew.
``accepted`` counts changed logs that verify. A writer is killed after a random number of events
that it has acknowledged; ``lost`` counts acknowledged events that are missing in its log.
"""

from __future__ import annotations

import io
import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from random import Random

from benches.row import Row, median_ms
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.events import FactChanged
from smsl_studio.runlog.grammar.log_reader import verify
from smsl_studio.runlog.log import RunLog
from tests.runlog.killed import kill_a_writer
from tests.runlog.logs import OTHER, is_verified, tampered, write_log

CHANGED, KILLS, ALL_KILLS = 10_000, 100, 1_000
LINES = 10_000


def rows() -> Iterator[Row]:
    """All changed logs, and a tenth of the kills."""
    return _rows(KILLS)


def all_rows() -> Iterator[Row]:
    """Every kill."""
    return _rows(ALL_KILLS)


def _rows(kills: int) -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        yield _changed(folder)
        random = Random(1)
        lost = sum(kill_a_writer(folder / f"killed-{n}", random).lost for n in range(kills))
        yield Row(f"{kills:,} kills of a writer", lost, "lost events", bound="0")
        yield from _costs(folder)


def _changed(folder: Path) -> Row:
    raw, other = write_log(folder / "one"), write_log(folder / "two", OTHER, seed=4)
    random = Random(1)
    accepted = [how for how, log in (tampered(raw, other, random) for _ in range(CHANGED))
                if is_verified(log)]  # fmt: skip
    return Row(f"{CHANGED:,} changed logs: {', '.join(accepted) or 'none verifies'}",
               len(accepted), "accepted", bound="0")  # fmt: skip


def _costs(folder: Path) -> Iterator[Row]:
    events = [FactChanged(t=n / 100, branch="SB", digit=n, value="1") for n in range(LINES)]
    path = folder / "long"

    def write() -> None:
        path.unlink(missing_ok=True)
        with RunLog(path, {}) as log:
            log.write(events)
            log.finish()

    def plainly() -> None:
        with path.open("wb", buffering=0) as file:
            for event in events:
                file.write(event.line().encode() + b"\n")

    plain = ("without a chain", median_ms(plainly))
    yield Row(f"write {LINES:,} events", median_ms(write), "ms", (plain,))
    raw = path.read_bytes()
    loads = ("json.loads a line", median_ms(lambda: [json.loads(x) for x in raw.splitlines()]))
    checked = median_ms(lambda: verify(io.BytesIO(raw), "log", COMMANDS))
    yield Row(f"verify {LINES:,} events", checked, "ms", (loads,))
