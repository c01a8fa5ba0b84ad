"""What recorded runs have done: the operations that they committed."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import StudioError, UsageError
from smsl_studio.runlog.events import Committed
from smsl_studio.runlog.grammar.log_reader import open_log, read_records

MOST = 1_000
"""The largest number of logs in a folder that are read."""


@dataclass(frozen=True)
class KnownEdges:
    """How often each operation was committed, by its address, in how many runs."""

    operations: Counter[str]
    runs: int


@lru_cache(maxsize=4)
def known_edges(folder: str) -> KnownEdges:
    """Read all logs (``*.jsonl``) of a folder. A log that was changed after the run does not count.

    UsageError if there is no folder, or no log in it that counts.
    """
    place = Path(folder)
    if not place.is_dir():
        raise UsageError(f"{folder} is no folder", advice="Name a folder with logs of runs.")
    found: Counter[str] = Counter()
    runs = 0
    for path in sorted(place.glob("*.jsonl"))[:MOST]:
        try:
            with open_log(path) as stream:
                told = read_records(stream, str(path), COMMANDS)
        except StudioError:
            continue
        if told.doubt is not None:
            continue
        runs += 1
        for event in told.events:
            if isinstance(event, Committed):
                found.update(event.operations)
    if not runs:
        raise UsageError(f"{folder} has no log that counts", advice="Record a run with --log.")
    return KnownEdges(found, runs)
