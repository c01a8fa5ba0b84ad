"""Who decided what in a run, after how long, and how often against an automatic supervisor.

It is read from the events alone. An automatic supervisor is known by what it does: it objects with
a reason that no command of a person has, or the run says that it says no.
"""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, zip_longest

from smsl_studio.runlog import events as run
from smsl_studio.runlog.causes import FACT
from smsl_studio.runlog.events import Event

ANSWER = "answer"
NO_DECISIONS = (ANSWER, "inject", "disturb", "full_map")
"""Commands that decide nothing about the procedure, or that are told by their task."""
LETS_GO = ("ask", "restore", "resume", "adopt")
GO_ON = "go_on"
TOLD_BY = (
    run.RiskEstimated,
    run.OperationStarted,
    run.OperationRefused,
    run.TaskOpened,
    run.TaskAnswered,
    run.TaskClosed,
    run.Commanded,
    run.Held,
)
FACT_TOLD = "fact told"
APPROVE, VETO = "approve", "veto"
SOMEBODY = "supervisor"
"""The name of a supervisor that the record does not name."""


@dataclass(frozen=True, slots=True)
class DecidedBy:
    """A person, script or agent. ``said`` has how often each decision was made, the first first.

    ``waits`` are the simulated seconds from a question, or from the begin of a hold, to each
    decision about it. ``against`` counts decisions that let an operation begin to which an agent
    had objected.
    """

    name: str
    automatic: bool
    said: Mapping[str, int]
    waits: tuple[float, ...] = ()
    against: int = 0

    @property
    def decided(self) -> str:
        """What was decided, in words: ``3 approve, 1 veto``."""
        return ", ".join(f"{count} {_plural(word, count)}" for word, count in self.said.items())

    @property
    def waited(self) -> str:
        """After how long, in words. Empty if nobody had asked."""
        if not self.waits:
            return ""
        middle, longest = statistics.median(self.waits), max(self.waits)
        return f"{middle:.1f} s" + (f", at most {longest:.1f} s" if len(self.waits) > 1 else "")


def _plural(word: str, count: int) -> str:
    return "facts told" if word == FACT_TOLD and count != 1 else word.replace("_", " ")


@dataclass(slots=True)
class _DecisionTally:
    said: Counter[str] = field(default_factory=Counter)
    waits: list[float] = field(default_factory=list)
    against: int = 0


def told_by(events: Iterable[Event]) -> Iterator[Event]:
    """Yield the events from which decisions are known, so that a long run need not keep all."""
    return (event for event in events if isinstance(event, TOLD_BY))


def deciders(events: Sequence[Event], supervisor: str = "") -> tuple[DecidedBy, ...]:
    """Return all who decided, in the order of their first decision. ``supervisor`` is the name in
    the header of the log; approvals of an automatic one are told by its estimates of the risk.
    """
    return _Decisions(events, supervisor or SOMEBODY).found()


class _Decisions:
    """One pass over the events of a run."""

    def __init__(self, events: Sequence[Event], supervisor: str) -> None:
        self._events, self._supervisor = events, supervisor
        self._agents = {*_objectors([*told_by(events)])}
        self._tallies: dict[str, _DecisionTally] = {}
        self._tasks: dict[str, run.TaskOpened] = {}
        self._answered: dict[tuple[str, str], float] = {}
        self._objected: set[str] = set()
        self._held: float | None = None
        self._closed: run.TaskClosed | None = None

    def found(self) -> tuple[DecidedBy, ...]:
        events = [*told_by(self._events)]
        for event, following in zip_longest(events, events[1:]):
            self._see(event, following)
        return tuple(
            DecidedBy(name, name in self._agents, dict(one.said), tuple(one.waits), one.against)
            for name, one in self._tallies.items()
        )

    def _of(self, name: str) -> _DecisionTally:
        return self._tallies.setdefault(name, _DecisionTally())

    def _see(self, event: Event, following: Event | None) -> None:
        if isinstance(event, run.RiskEstimated):
            self._estimated(event, following)
        elif isinstance(event, run.TaskOpened):
            self._tasks[event.task] = event
        elif isinstance(event, run.TaskAnswered) and not event.refused:
            self._answered[event.task, event.by] = event.t
        elif isinstance(event, run.TaskClosed):
            self._answers(event)
        elif isinstance(event, run.Commanded) and not event.refused:
            self._command(event)
        elif isinstance(event, run.Held):
            self._held = event.t

    def _estimated(self, event: run.RiskEstimated, following: Event | None) -> None:
        """Count what an agent said about an operation without a command of its own."""
        if isinstance(following, run.OperationRefused) and _says_no(following):
            name = following.reasons[0].partition(" says no")[0]
            self._of(name).said[VETO] += 1
            return
        objects = isinstance(following, run.Held) or (
            isinstance(following, run.Commanded) and following.by in self._agents
        )
        if not objects:
            self._agents.add(self._supervisor)
            self._of(self._supervisor).said[APPROVE] += 1

    def _answers(self, event: run.TaskClosed) -> None:
        self._closed, task = event, self._tasks.get(event.task)
        for name, answer in event.answers.items():
            tally = self._of(name)
            tally.said[FACT_TOLD if task is not None and task.kind == FACT else answer] += 1
            if task is not None:
                at = self._answered.get((event.task, name), event.t)
                tally.waits.append(max(at - task.t, 0.0))
                if answer == GO_ON and task.address in self._objected:
                    tally.against += 1
        if task is not None:
            self._objected.discard(task.address)

    def _command(self, event: run.Commanded) -> None:
        closed, self._closed = self._closed, None
        if event.command in NO_DECISIONS:
            return
        if closed is not None and closed.answer == event.command:
            return  # what the run does after an answer that was counted
        tally = self._of(event.by)
        tally.said[event.command] += 1
        if event.by in self._agents:
            self._objected.add(event.address)
            return
        if self._held is not None:
            tally.waits.append(max(event.t - self._held, 0.0))
            self._held = None
        lets_go = event.command in LETS_GO
        if lets_go and (event.address in self._objected or (not event.address and self._objected)):
            tally.against += 1
            self._objected.clear()


def _objectors(events: Sequence[Event]) -> Iterator[str]:
    """Yield who objects as only an automatic supervisor does."""
    for event, following in pairwise(events):
        if isinstance(event, run.Commanded) and not event.refused:
            with_reason = event.command in ("ask", "take_over", "pause") and event.reason
            if with_reason or (_says_no(following) and event.command in (VETO, "prune")):
                yield event.by
        elif isinstance(event, run.RiskEstimated) and _says_no(following):
            assert isinstance(following, run.OperationRefused)
            yield following.reasons[0].partition(" says no")[0]


def _says_no(event: Event | None) -> bool:
    return (
        isinstance(event, run.OperationRefused)
        and len(event.reasons) == 1
        and " says no" in event.reasons[0]
    )
