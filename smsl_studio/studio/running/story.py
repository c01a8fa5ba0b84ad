"""The story of a run as the widgets need it: spans and trails, told event by event.

It is derived from the one stream of run events and from nothing else, so that a replayed log shows
what the live run showed.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from statistics import median

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog import events as run


@dataclass
class Span:
    """Something that held from ``start`` to ``end`` (simulated s); ``end`` None: it still does."""

    start: float
    words: str
    end: float | None = None
    good: bool = True


@dataclass
class Story:
    """What has happened so far. Lanes are lists of spans in order of time; in ``operations`` those
    of several SBs may overlap.
    """

    time: float = 0.0
    finished: run.RunFinished | None = None
    states: dict[str, list[Span]] = field(default_factory=dict)
    operations: list[Span] = field(default_factory=list)
    facts: dict[tuple[str, int], list[Span]] = field(default_factory=dict)
    trail: dict[str, list[Address]] = field(default_factory=dict)
    risky: dict[str, str] = field(default_factory=dict)
    pruned: dict[str, str] = field(default_factory=dict)
    _open: dict[str, Span] = field(default_factory=dict)
    """By address: the operations that are under way, of each SB one at most."""
    _functions: dict[str, str] = field(default_factory=dict)
    _took: dict[str, list[float]] = field(default_factory=dict)

    def tell(self, events: Iterable[run.Event]) -> None:
        """Go on with the story."""
        for event in events:
            self.time = max(self.time, event.t)
            self._tell_one(event)

    def visited(self, branch: str) -> frozenset[str]:
        """The states of an SB that were active and are no more."""
        return frozenset(span.words for span in self.states.get(branch, ())[:-1])

    def expected(self, operation: str) -> float | None:
        """How long an operation's function took before (the median, simulated s); None: never."""
        took = self._took.get(self._functions.get(operation, ""))
        return median(took) if took else None

    def _tell_one(self, event: run.Event) -> None:
        match event:
            case run.RunStarted():
                for branch, state in event.start.items():
                    self.states[branch] = [Span(event.t, state)]
            case run.FactChanged():
                value = "?" if event.value is None else event.value
                lane = self.facts.setdefault((event.branch, event.digit), [])
                _next(lane, event.t, value, event.value is not None)
            case run.OperationStarted():
                self._start_operation(event)
            case run.OperationEnded() if event.outcome != "returned":
                self._end_operation(event.address, event.t, good=False)
            case run.Committed():
                self._commit(event)
            case run.Relocalised():
                self._enter(event.t, event.configuration)
            case run.OperationRisky():
                self.risky[event.address] = event.reason
                self._end_operation(event.address, event.t, good=False)
            case run.OperationPruned():
                self.pruned[event.address] = event.reason
            case run.OperationRestored():
                self.risky.pop(event.address, None)
                self.pruned.pop(event.address, None)
            case run.Held() | run.Mismatch():
                self._end_operations(event.t, good=False)
            case run.RunFinished():
                self.finished = event
                self._end_operations(event.t, good=event.reason == "goal_reached")
            case _:
                pass

    def _start_operation(self, event: run.OperationStarted) -> None:
        """An operation of a base and those of its sub-SB are under way together."""
        branch = event.address.partition("/")[0]
        for other in [one for one in self._open if one.partition("/")[0] == branch]:
            self._end_operation(other, event.t)
        self._functions[event.address] = event.function
        span = self._open[event.address] = Span(event.t, event.address)
        self.operations.append(span)

    def _end_operation(self, address: str, time: float, good: bool = True) -> None:
        span = self._open.pop(address, None)
        if span is None:
            return
        span.end, span.good = time, good
        function = self._functions.get(address, "")
        if good and function:
            self._took.setdefault(function, []).append(time - span.start)

    def _end_operations(self, time: float, good: bool) -> None:
        for address in list(self._open):
            self._end_operation(address, time, good)

    def _commit(self, event: run.Committed) -> None:
        for text in event.operations:
            self._end_operation(text, event.t)
            address = Address.read(text)
            if address is None:
                continue
            self.trail.setdefault(address.branch, []).append(address)
        self._enter(event.t, event.configuration)

    def _enter(self, time: float, configuration: Mapping[str, str]) -> None:
        for branch, state in configuration.items():
            lane = self.states.setdefault(branch, [])
            if not lane or lane[-1].words != state:
                _next(lane, time, state)


def _next(lane: list[Span], time: float, words: str, good: bool = True) -> None:
    if lane and lane[-1].end is None:
        lane[-1].end = time
    lane.append(Span(time, words, good=good))
