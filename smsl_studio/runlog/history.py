"""What has been in a run: spans of states, operations and facts, and the edges that it took.

The fold writes it (``changes``); nothing else reads events for it, so that a recorded run shows
what the live one showed.
"""

from __future__ import annotations

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
    """Something that held from ``start`` to ``end`` (simulated s); ``end`` None: it still does."""

    start: float
    words: str
    end: float | None = None
    good: bool = True


class RunHistory:
    """What has been so far. Lanes are lists of spans in order of time; in ``operations`` those of
    several SBs may overlap. What happens more than once (a state is entered, an edge committed) has
    the number of events after which it first had, so that every moment of a long run is as near.
    """

    def __init__(self) -> None:
        self.states: dict[str, list[Span]] = {}
        self.operations: list[Span] = []
        self.facts: dict[FactKey, list[Span]] = {}
        self.entered: dict[str, dict[str, int]] = {}
        self.committed: dict[str, dict[Address, int]] = {}
        self.took: dict[str, list[tuple[int, float]]] = {}
        """By function: after how many events it had succeeded, and in how many simulated s."""
        self.functions: dict[str, str] = {}
        self._open: dict[str, Span] = {}
        """By address: the operations that are under way, of each SB one at most."""

    def enter(self, index: int, time: float, configuration: Mapping[str, str]) -> None:
        """SBs came into these states."""
        for branch, state in configuration.items():
            lane = self.states.setdefault(branch, [])
            if not lane or lane[-1].words != state:
                _next(lane, time, state)
                self.entered.setdefault(branch, {}).setdefault(state, index)

    def sense(self, time: float, key: FactKey, value: str | None) -> None:
        """A fact took another value; None: it is unknown."""
        words = "?" if value is None else value
        _next(self.facts.setdefault(key, []), time, words, value is not None)

    def begin(self, index: int, time: float, address: str, function: str) -> None:
        """An operation began. Those of a base and of its sub-SB are under way together."""
        branch = address.partition("/")[0]
        for other in [one for one in self._open if one.partition("/")[0] == branch]:
            self.end(index, time, other)
        self.functions[address] = function
        span = self._open[address] = Span(time, address)
        self.operations.append(span)

    def end(self, index: int, time: float, address: str, good: bool = True) -> None:
        """An operation ended, if it was under way."""
        span = self._open.pop(address, None)
        if span is None:
            return
        span.end, span.good = time, good
        function = self.functions.get(address, "")
        if good and function:
            self.took.setdefault(function, []).append((index, time - span.start))

    def end_all(self, index: int, time: float, good: bool) -> None:
        """Nothing is carried out any more."""
        for address in list(self._open):
            self.end(index, time, address, good)

    def commit(self, index: int, time: float, operations: Iterable[str]) -> None:
        """Edges were committed together."""
        for text in operations:
            self.end(index, time, text)
            address = Address.read(text)
            if address is not None:
                self.committed.setdefault(address.branch, {}).setdefault(address, index)

    def close(self, time: float) -> None:
        """Nothing more is told: what still holds is shown until then."""
        last = (lane[-1:] for lane in (*self.states.values(), *self.facts.values()))
        for span in chain(self.operations, *last):
            if span.end is None:
                span.end = time


@dataclass(frozen=True, slots=True)
class Story:
    """What had been in a run until a moment; ``history`` may go on behind it."""

    moment: RunMoment
    history: RunHistory

    def visited(self, branch: str) -> frozenset[str]:
        """The states of an SB that were active and are no more."""
        states = _until(self.moment.index, self.history.entered.get(branch, {}))
        return frozenset(states) - {self.moment.configuration.get(branch)}

    def trail(self, branch: str) -> tuple[Address, ...]:
        """The edges of an SB that were committed, in the order in which they first were."""
        return tuple(_until(self.moment.index, self.history.committed.get(branch, {})))

    def expected(self, operation: str) -> float | None:
        """How long an operation's function took before (the median, simulated s); None: never."""
        took = self.history.took.get(self.history.functions.get(operation, ""), ())
        before = takewhile(lambda one: one[0] <= self.moment.index, took)
        times = [seconds for _, seconds in before]
        return median(times) if times else None


def _until(index: int, first: Mapping[Key, int]) -> Iterable[Key]:
    """What had happened after so many events; ``first`` is in the order in which it did."""
    return (key for key, _ in takewhile(lambda one: one[1] <= index, first.items()))


def _next(lane: list[Span], time: float, words: str, good: bool = True) -> None:
    if lane and lane[-1].end is None:
        lane[-1].end = time
    lane.append(Span(time, words, good=good))
