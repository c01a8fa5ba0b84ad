"""The history of a run: spans of states, operations and facts, and the edges that were committed.

Only the fold writes it (``changes``). So a recorded run shows the same as the live run did.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import chain, takewhile
from statistics import median
from typing import TypeVar

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.runlog.moment import RunMoment

Key = TypeVar("Key")


@dataclass(slots=True)
class Span:
    """Something that lasted from ``start`` to ``end`` (simulated s). ``end`` is None if it still
    lasts.
    """

    start: float
    words: str
    end: float | None = None
    good: bool = True


MEASURES, RECORDED = 4096, 100_000
"""The largest number of measures of a source that a history keeps: more than 30 s of any, and for a
recorded run, which is shown at any moment, 1,000 s at the highest rate."""
Measures = deque[tuple[float, str | None, str]]
"""For each measure its time (simulated s), its text or None, and why there is none."""


class RunHistory:
    """The history of a run up to now.

    A lane is a list of spans in order of time. In ``operations``, spans of several SBs may overlap.
    ``entered`` and ``committed`` keep, for each state and each edge, after how many events it
    happened first. So any moment of a long run is found quickly.
    """

    def __init__(self, measures: int = MEASURES) -> None:
        self._most = measures
        self.states: dict[str, list[Span]] = {}
        self.operations: list[Span] = []
        self.facts: dict[FactKey, list[Span]] = {}
        self.entered: dict[str, dict[str, int]] = {}
        self.committed: dict[str, dict[Address, int]] = {}
        self.took: dict[str, list[tuple[int, float]]] = {}
        """For each function: after how many events it succeeded, and how long it took (simulated
        s).
        """
        self.measures: dict[tuple[FactKey, str], Measures] = {}
        """The newest measures of each source of a fact, in order of time."""
        self.functions: dict[str, str] = {}
        self._open: dict[str, Span] = {}
        """The operations that are under way, by address. Each SB has one at most."""

    def enter(self, index: int, time: float, configuration: Mapping[str, str]) -> None:
        """Note that SBs have entered these states."""
        for branch, state in configuration.items():
            lane = self.states.setdefault(branch, [])
            if not lane or lane[-1].words != state:
                _next(lane, time, state)
                self.entered.setdefault(branch, {}).setdefault(state, index)

    def sense(self, time: float, key: FactKey, value: str | None) -> None:
        """Note the new value of a fact. None means unknown."""
        words = "?" if value is None else value
        _next(self.facts.setdefault(key, []), time, words, value is not None)

    def measure(
        self, time: float, source: tuple[FactKey, str], value: str | None, reason: str
    ) -> None:
        """Note what a source of a fact has measured."""
        kept = self.measures.get(source)
        if kept is None:
            kept = self.measures[source] = deque(maxlen=self._most)
        kept.append((time, value, reason))

    def begin(self, index: int, time: float, address: str, function: str) -> None:
        """Note that an operation has begun. Operations of a base and of its sub-SB may be under way
        together.
        """
        branch = address.partition("/")[0]
        for other in [one for one in self._open if one.partition("/")[0] == branch]:
            self.end(index, time, other)
        self.functions[address] = function
        span = self._open[address] = Span(time, address)
        self.operations.append(span)

    def end(self, index: int, time: float, address: str, good: bool = True) -> None:
        """Note that an operation has ended, if it was under way."""
        span = self._open.pop(address, None)
        if span is None:
            return
        span.end, span.good = time, good
        function = self.functions.get(address, "")
        if good and function:
            self.took.setdefault(function, []).append((index, time - span.start))

    def end_all(self, index: int, time: float, good: bool) -> None:
        """Note that nothing is carried out any more."""
        for address in list(self._open):
            self.end(index, time, address, good)

    def commit(self, index: int, time: float, operations: Iterable[str]) -> None:
        """Note that edges were committed together."""
        for text in operations:
            self.end(index, time, text)
            address = Address.read(text)
            if address is not None:
                self.committed.setdefault(address.branch, {}).setdefault(address, index)

    def close(self, time: float) -> None:
        """End all open spans at this time, because no more events will come."""
        last = (lane[-1:] for lane in (*self.states.values(), *self.facts.values()))
        for span in chain(self.operations, *last):
            if span.end is None:
                span.end = time


@dataclass(frozen=True, slots=True)
class Story:
    """The history of a run up to a moment. ``history`` may have later events, which do not
    count.
    """

    moment: RunMoment
    history: RunHistory

    def visited(self, branch: str) -> frozenset[str]:
        """Return the states of an SB that were active before and are not now."""
        states = _until(self.moment.index, self.history.entered.get(branch, {}))
        return frozenset(states) - {self.moment.configuration.get(branch)}

    def trail(self, branch: str) -> tuple[Address, ...]:
        """Return the edges of an SB that were committed, in the order of their first commits."""
        return tuple(_until(self.moment.index, self.history.committed.get(branch, {})))

    def expected(self, operation: str) -> float | None:
        """Return the median time (simulated s) of an operation's function so far, None if it never
        succeeded.
        """
        took = self.history.took.get(self.history.functions.get(operation, ""), ())
        before = takewhile(lambda one: one[0] <= self.moment.index, took)
        times = [seconds for _, seconds in before]
        return median(times) if times else None


def _until(index: int, first: Mapping[Key, int]) -> Iterable[Key]:
    """Yield what had happened after ``index`` events. ``first`` is in order of time."""
    return (key for key, _ in takewhile(lambda one: one[1] <= index, first.items()))


def _next(lane: list[Span], time: float, words: str, good: bool = True) -> None:
    if lane and lane[-1].end is None:
        lane[-1].end = time
    lane.append(Span(time, words, good=good))
