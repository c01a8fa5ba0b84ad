"""The player of a script: it gives the commands that are due before the next tick.

The moments of a script depend only on simulated time and on run events. So equal runs get equal
commands, in the window and without it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.front.script.moments import Moments
from smsl_studio.front.script.script import AT, EVERY, Act, Script
from smsl_studio.front.script.words import WORDS
from smsl_studio.runlog.events import Event

HAIR = 1e-9
WAITING = ("ready", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")
"""Run states in which nothing moves before the next command."""


@dataclass(frozen=True, slots=True)
class Due:
    """An act whose moment is known: its time (simulated s), and the task that it answers."""

    time: float
    act: Act
    task: str = ""


class ScriptPlayer:
    """Carries out one script in one run.

    Call ``before`` before every tick, and ``hear`` with the events of the tick. If the run waits
    and the script has no further commands, the run is no longer attended.
    """

    def __init__(self, script: Script) -> None:
        self._moments = Moments(script.acts)
        self._due = [Due(act.trigger.seconds, act) for act in script.acts if act.trigger.kind == AT]
        self._done: set[Act] = set()
        self._acts = script.acts
        self._asking: Act | None = None
        self._resuming = ""
        self._by_hand = False

    @property
    def left(self) -> tuple[Act, ...]:
        """The acts whose moments have not come, in the order of the script."""
        return tuple(act for act in self._acts if act not in self._done)

    def hear(self, events: Iterable[Event]) -> None:
        """Take in events: states that became active, operations that began, tasks that opened."""
        for event in events:
            for time, act, task in self._moments.met(event):
                self._due.append(Due(time, act, task))
            self._due = [due for due in self._due if not self._moments.is_over(due.act, due.task)]

    def has_something(self, dispatcher: Dispatcher) -> bool:
        """Whether ``before`` has something to do now: a command, or to leave the run."""
        ready = self._ready(dispatcher)
        return bool(self._asking or self._resuming or ready or self._leaves(ready, dispatcher))

    def before(self, dispatcher: Dispatcher) -> None:
        """Give the commands that are due now."""
        if self._asking is not None:
            act, self._asking = self._asking, None
            dispatcher.take(_command(act))
            return
        ready = self._ready(dispatcher)
        if any(due.act.do == "pause" for due in ready):
            self._resuming = ""
        if self._resuming and not ready and dispatcher.phase != "running":
            by, self._resuming = self._resuming, ""
            if dispatcher.phase == "paused":
                dispatcher.resume(by=by)
                return
        for due in ready:
            self._due.remove(due)
            self._carry_out(due, dispatcher)
        if self._leaves(ready, dispatcher):
            dispatcher.leave()

    def _leaves(self, ready: list[Due], dispatcher: Dispatcher) -> bool:
        return not ready and not self._due and dispatcher.phase in WAITING

    def _ready(self, dispatcher: Dispatcher) -> list[Due]:
        """Return the acts that are due. In a paused run time does not move, so the next act by
        time is due at once."""
        now = dispatcher.time
        ready = [due for due in self._due if due.time <= now + HAIR]
        if not ready and dispatcher.phase == "paused" and not self._resuming:
            soonest = min((due.time for due in self._due), default=now)
            ready = [due for due in self._due if due.time <= soonest]
        return sorted(ready, key=lambda due: (due.time, due.act.place.line))

    def _carry_out(self, due: Due, dispatcher: Dispatcher) -> None:
        act = due.act
        if act.do == "answer":
            task = due.task or _open_task(act, dispatcher)
            if not task:
                return
            said = {key: act.given[key] for key in ("option", "role") if key in act.given}
            dispatcher.take(WORDS[act.do].command(said, act.by, task=task))
        elif act.do == "ask" and not self._by_hand and _follows_its_route(dispatcher):
            # The run would choose the next operation itself, so it is paused one tick before.
            dispatcher.pause(by=act.by)
            self._asking, self._resuming = act, act.by
        else:
            self._by_hand = act.do == "by_hand" or (self._by_hand and act.do != "automatic")
            dispatcher.take(_command(act))
        self._done.add(act)


def _follows_its_route(dispatcher: Dispatcher) -> bool:
    return dispatcher.phase == "running" and dispatcher.status.carrying is None


def _command(act: Act) -> Command:
    """Return the command of a line of a script."""
    word = WORDS[act.do]
    if act.do == "ask":
        return word.command(act.given, act.by, every_time=act.trigger.times == EVERY)
    return word.command(act.given, act.by)


def _open_task(act: Act, dispatcher: Dispatcher) -> str:
    """Return the name of the open task that fits an answer. The text is empty if there is none."""
    kind, address = act.given.get("kind"), act.given.get("address")
    for task in dispatcher.status.tasks:
        if kind in (None, task.kind) and address in (None, task.address):
            return task.name
    return ""
