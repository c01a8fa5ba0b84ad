"""The player of a script: it gives the commands that are due before the next tick.

Moments depend on simulated time and events alone, so equal runs get equal commands.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from .dispatcher import Dispatcher
from .elements import address
from .events import Event
from .script import ASKED, AT, DURING, EVERY, WHEN, Act, Script

HAIR = 1e-9
WAITING = ("ready", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")
"""Run states in which nothing moves before the next command."""


@dataclass
class Due:
    """An act whose moment is known, and the task that it answers. ``turn`` counts down ticks."""

    time: float
    act: Act
    task: str
    turn: int


class Moments:
    """Follows the events of a run, and finds the acts whose moments have come."""

    def __init__(self, acts: Iterable[Act]) -> None:
        self._acts = [act for act in acts if act.kind != AT]
        self._counts: Counter[tuple[str, str]] = Counter()
        self._asked: Counter[int] = Counter()
        self._going: set[str] = set()
        self._open: set[str] = set()
        self._configuration: dict[str, str] = {}

    def met(self, event: Event) -> Iterator[tuple[Act, str]]:
        """Yield the acts whose moments come with an event, and the tasks that they answer."""
        word = event["event"]
        if word == "run_started":
            yield from self._arrived(event["start"])
        elif word == "committed":
            self._going.difference_update(event["operations"])
            yield from self._arrived(event["configuration"])
        elif word == "relocalised":
            self._going.clear()
            here = event["configuration"]
            yield from self._arrived(
                {b: s for b, s in here.items() if self._configuration.get(b) != s}
            )
        elif word == "operation_started":
            self._going.add(event["address"])
            yield from self._of(DURING, event["address"])
        elif word == "operation_ended":
            self._going.discard(event["address"])
        elif word in ("held", "mismatch", "stopped", "taken_over"):
            self._going.clear()
        elif word == "task_opened":
            self._open.add(event["task"])
            yield from self._asked_by(event)
        elif word == "task_closed":
            self._open.discard(event["task"])

    def is_over(self, due: Due) -> bool:
        """Return whether the moment of an act has come and has passed already."""
        if due.act.kind == DURING:
            return due.act.address not in self._going
        return bool(due.task) and due.task not in self._open

    def _arrived(self, states: Mapping[str, str]) -> Iterator[tuple[Act, str]]:
        self._configuration.update(states)
        for branch, state in states.items():
            yield from self._of(WHEN, address(branch, state))

    def _of(self, kind: str, named: str) -> Iterator[tuple[Act, str]]:
        self._counts[kind, named] += 1
        for act in self._acts:
            many = act.times in (EVERY, self._counts[kind, named])
            if (act.kind, act.address) == (kind, named) and many:
                yield act, ""

    def _asked_by(self, event: Event) -> Iterator[tuple[Act, str]]:
        for act in self._acts:
            if act.kind == ASKED and _fits(act, event["kind"], event["address"]):
                self._asked[act.line] += 1
                if act.times in (EVERY, self._asked[act.line]):
                    yield act, event["task"]


class Player:
    """Plays one script in one run. Call ``before`` before every tick, ``hear`` with its events."""

    def __init__(self, script: Script) -> None:
        self._moments = Moments(script.acts)
        self._due = [Due(act.seconds, act, "", act.turn) for act in script.acts if act.kind == AT]
        self._left = dict.fromkeys(act.line for act in script.acts)
        self._acts = {act.line: act for act in script.acts}
        self._asking: Act | None = None
        self._resuming, self._by_hand = "", False

    @property
    def left(self) -> list[Act]:
        """The acts whose moments never came."""
        return [self._acts[line] for line in self._left]

    def hear(self, events: Iterable[Event]) -> None:
        """Take in events: states that became active, operations that began, tasks that opened."""
        for event in events:
            for act, task in self._moments.met(event):
                self._due.append(Due(event["t"] + act.seconds, act, task, act.turn))
            self._due = [due for due in self._due if not self._moments.is_over(due)]

    def before(self, dispatcher: Dispatcher) -> None:
        """Give the commands that are due now."""
        come, ready = self._come(dispatcher), self._ready(dispatcher)
        for due in come:
            if due.turn > 1:
                self._due[_index(self._due, due)] = replace(due, turn=due.turn - 1)
        if self._asking is not None:
            act, self._asking = self._asking, None
            _give(dispatcher, act)
            return
        if any(due.act.do == "pause" for due in ready):
            self._resuming = ""
        if self._resuming and not ready and dispatcher.phase != "running":
            by, self._resuming = self._resuming, ""
            if dispatcher.phase == "paused":
                dispatcher.command("resume", by)
                return
        for due in ready:
            del self._due[_index(self._due, due)]
            self._carry_out(due, dispatcher)
        if not ready and not self._due and dispatcher.phase in WAITING:
            dispatcher.leave()

    def _come(self, dispatcher: Dispatcher) -> list[Due]:
        now = dispatcher.time + HAIR
        return [due for due in self._due if due.time <= now]

    def _ready(self, dispatcher: Dispatcher) -> list[Due]:
        """Return the acts that are due. In a paused run time stands still, so the next act by time
        is due at once.
        """
        come = self._come(dispatcher)
        ready = [due for due in come if due.turn <= 1]
        if not come and dispatcher.phase == "paused" and not self._resuming:
            soonest = min((due.time for due in self._due), default=0.0)
            ready = [due for due in self._due if due.time <= soonest]
        return sorted(ready, key=lambda due: (due.time, due.act.line))

    def _carry_out(self, due: Due, dispatcher: Dispatcher) -> None:
        act = due.act
        if act.do == "answer":
            task = due.task or _open_task(act, dispatcher)
            if not task:
                return
            said = {key: act.given[key] for key in ("option", "role") if key in act.given}
            dispatcher.command("answer", act.by, task=task, **said)
        elif act.do == "ask" and not self._by_hand and _follows_its_route(dispatcher):
            # The run would choose the next operation itself, so it is paused one tick before.
            dispatcher.command("pause", act.by)
            self._asking, self._resuming = act, act.by
        else:
            self._by_hand = act.do == "by_hand" or (self._by_hand and act.do != "automatic")
            _give(dispatcher, act)
        self._left.pop(act.line, None)


def _index(every: list[Due], one: Due) -> int:
    return next(index for index, other in enumerate(every) if other is one)


def _fits(act: Act, kind: str, about: str) -> bool:
    given = act.given
    return given.get("kind") in (None, kind) and given.get("address") in (None, about)


def _follows_its_route(dispatcher: Dispatcher) -> bool:
    return dispatcher.phase == "running" and not dispatcher.carrying


def _give(dispatcher: Dispatcher, act: Act) -> None:
    said: dict[str, Any] = dict(act.given)
    word = act.do
    if word in ("by_hand", "automatic"):
        word, said = "set_automatic", {"automatic": word == "automatic"}
    if word == "ask":
        said["every_time"] = act.times == EVERY and act.kind != AT
    dispatcher.command(word, act.by, **said)


def _open_task(act: Act, dispatcher: Dispatcher) -> str:
    return next(
        (
            one.name
            for one in dispatcher.tasks
            if _fits(act, one.question.kind, one.question.address)
        ),
        "",
    )
