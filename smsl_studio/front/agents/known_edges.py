"""What recorded runs have done: the operations that they committed, how long these took, and what
their sources measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.predicates.measure import measure_of
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import StudioError, UsageError
from smsl_studio.library.supervisor_view import SupervisorView
from smsl_studio.runlog.events import Committed, Event, Measured, OperationEnded, OperationStarted
from smsl_studio.runlog.grammar.log_reader import open_log, read_records

MOST = 1_000
"""The largest number of logs in a folder that are read."""


@dataclass(frozen=True)
class KnownRange:
    """The least and the largest number that recorded runs have of something."""

    low: float
    high: float

    def holds(self, number: float, room: float) -> bool:
        """Whether a number is in the range, or at most ``room`` outside of it."""
        return self.low - room <= number <= self.high + room

    def __str__(self) -> str:
        """Both ends, or the one number."""
        if self.low == self.high:
            return f"{self.low:.4g}"
        return f"{self.low:.4g} to {self.high:.4g}"


@dataclass(frozen=True)
class KnownEdges:
    """How often each operation was committed, by its address, in how many runs.

    ``durations`` has how long each operation took (s), and ``measures`` what each source has
    measured, by ``SB/digit/source``: a range for a number, three for a position.
    """

    operations: Counter[str]
    runs: int
    durations: Mapping[str, KnownRange]
    measures: Mapping[str, tuple[KnownRange, ...]]


@lru_cache(maxsize=4)
def known_edges(folder: str) -> KnownEdges:
    """Read all logs (``*.jsonl``) of a folder. A log that was changed after the run does not count.

    UsageError if there is no folder, or no log in it that counts.
    """
    place = Path(folder)
    if not place.is_dir():
        raise UsageError(f"{folder} is no folder", advice="Name a folder with logs of runs.")
    found = _Ranges()
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
        found.add(told.events)
    if not runs:
        raise UsageError(f"{folder} has no log that counts", advice="Record a run with --log.")
    return KnownEdges(found.operations, runs, found.durations, found.measures)


def unfamiliar(view: SupervisorView, known: KnownEdges, slack: float) -> str:
    """Return what a view has and no recorded run, in words; empty for nothing.

    Of durations only that of the last operation counts, so that a person is asked once about it.
    ``slack`` is the share of the longest duration by which one may be shorter or longer, and the
    share of the width of the range by which a measure may be outside of it.
    """
    runs = f"{known.runs} recorded runs" if known.runs != 1 else "1 recorded run"
    for name in view.operations:
        if name not in known.operations:
            return f"{name} stands in none of {known.runs} recorded runs"
    last = view.history[-1][0] if view.history else ""
    took, usual = view.durations.get(last), known.durations.get(last)
    if took is not None and usual is not None and not usual.holds(took, slack * usual.high):
        return f"{last} took {took:.4g} s; in {runs} it took {usual} s"
    for source, numbers in view.measures.items():
        ranges = known.measures.get(source, ())
        for number, one in zip(numbers, ranges, strict=False):
            if not one.holds(number, slack * (one.high - one.low)):
                return f"{source} measures {number:.4g}; in {runs} it measured {one}"
    return ""


class _Ranges:
    """Collects what the events of runs say."""

    def __init__(self) -> None:
        self.operations: Counter[str] = Counter()
        self.durations: dict[str, KnownRange] = {}
        self.measures: dict[str, tuple[KnownRange, ...]] = {}

    def add(self, events: Iterable[Event]) -> None:
        """Take the events of one run."""
        begun: dict[str, float] = {}
        for event in events:
            if isinstance(event, Committed):
                self.operations.update(event.operations)
            elif isinstance(event, OperationStarted):
                begun[event.address] = event.t
            elif isinstance(event, OperationEnded) and event.outcome == "returned":
                took = event.t - begun.get(event.address, event.t)
                self.durations[event.address] = _wider(self.durations.get(event.address), took)
            elif isinstance(event, Measured) and event.value is not None:
                self._measured(event, event.value)

    def _measured(self, event: Measured, value: str) -> None:
        measure = measure_of(value, None)
        if isinstance(measure, str):
            return
        numbers = measure if isinstance(measure, tuple) else (measure,)
        name = f"{Address(event.branch)}/{event.digit}/{event.source}"
        before = self.measures.get(name, ())
        if len(before) == len(numbers):
            pairs = zip(before, numbers, strict=True)
            self.measures[name] = tuple(_wider(old, new) for old, new in pairs)
        elif not before:
            self.measures[name] = tuple(KnownRange(one, one) for one in numbers)


def _wider(before: KnownRange | None, number: float) -> KnownRange:
    if before is None:
        return KnownRange(number, number)
    return KnownRange(min(before.low, number), max(before.high, number))
