"""How often the forecasts of runs were right: in one run, and in recorded ones."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import StudioError
from smsl_studio.front.logs import replay
from smsl_studio.legible import one_line
from smsl_studio.runlog.events import Event, ForecastTold
from smsl_studio.runlog.regulation import COMPARISONS, RIGHT
from smsl_studio.stop import heed

MOST = 200
"""So many of the newest recordings are read."""
LARGEST = 64 * 2**20
"""A larger recording is left out (bytes)."""


@dataclass(frozen=True)
class ForecastCount:
    """One operation: how many of its forecasts were right, of how many, and the last that was
    wrong."""

    operation: str
    right: int
    count: int
    reason: str = ""


@dataclass(frozen=True)
class ForecastRecord:
    """The comparisons of forecasts with what came. ``outcomes`` has them in order: right or not.
    ``runs`` is how many runs they are from."""

    rows: tuple[ForecastCount, ...] = ()
    outcomes: tuple[bool, ...] = ()
    runs: int = 1

    @property
    def words(self) -> str:
        """All of it in one sentence; empty without a comparison."""
        if not self.outcomes:
            return ""
        where = "" if self.runs == 1 else f", {self.runs} runs"
        right, count = sum(self.outcomes), len(self.outcomes)
        return f"The world simulator was right in {right} of {count}{where}"

    @property
    def shares(self) -> tuple[float, ...]:
        """The share of right ones among all so far, after each comparison."""
        right, found = 0, []
        for number, one in enumerate(self.outcomes, 1):
            right += one
            found.append(right / number)
        return tuple(found)


def drift_of(events: Iterable[Event], runs: int = 1) -> ForecastRecord:
    """Return the comparisons among the events of runs. Operations that were wrong stand first."""
    told = [e for e in events if isinstance(e, ForecastTold) and e.verdict in COMPARISONS]
    rows: dict[str, ForecastCount] = {}
    for one in told:
        before = rows.get(one.address, ForecastCount(one.address, 0, 0))
        right = one.verdict == RIGHT
        reason = before.reason if right else one_line(one.reason)
        rows[one.address] = ForecastCount(
            one.address, before.right + right, before.count + 1, reason
        )
    ordered = sorted(rows.values(), key=lambda row: (row.right / row.count, row.operation))
    return ForecastRecord(tuple(ordered), tuple(one.verdict == RIGHT for one in told), runs)


def recorded_drift(folder: Path) -> ForecastRecord:
    """Return the comparisons in the newest recordings of a folder, the oldest first. What is no
    recording, is too large or cannot be read is left out. Stopped if whoever waits stops it."""
    logs = [one for one in folder.glob("*.jsonl") if one.is_file()] if folder.is_dir() else []
    newest = sorted(logs, key=lambda one: (one.stat().st_mtime_ns, one.name))[-MOST:]
    events: list[Event] = []
    runs = 0
    for log in newest:
        heed()
        if log.stat().st_size > LARGEST:
            continue
        try:
            found = [e for e in replay(log).events if isinstance(e, ForecastTold)]
        except StudioError:
            continue
        runs += bool(found)
        events += found
    return drift_of(events, runs)
