"""The player of a script: it gives the commands that are due before the next tick.

The moments of a script depend only on simulated time and on run events. So equal runs get equal
commands, in the window and without it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

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
    """An act whose moment is known: its time (simulated s), and the task that it answers.

    ``turn`` counts down the ticks from this time on; with 1 it comes at the next one.
    """

    time: float
    act: Act
    task: str = ""
    turn: int = 1


class ScriptPlayer:
    """Carries out one script in one run.

    Call ``before`` before every tick, and ``hear`` with the events of the tick. If the run waits
    and the script has no further commands, the run is no longer attended, unless the player
    ``stays`` because a person attends the run, too.
    """

    def __init__(self, script: Script, stays: bool = False) -> None:
        self._stays = stays
        self._moments = Moments()
        self._due: list[Due] = []
        self._done: set[Act] = set()
        self._acts: tuple[Act, ...] = ()
        for act in script.acts:
            self.add(act)
        self._asking: Act | None = None
        self._resuming = ""
        self._by_hand = False

    def add(self, act: Act) -> None:
        """Add an act. ``times`` counts from the begin of the run."""
        self._acts += (act,)
        self._moments.add(act)
        if act.trigger.kind == AT:
            self._due.append(Due(act.trigger.seconds, act, turn=act.trigger.turn))

    def plan(self, act: Act) -> None:
        """Add an act for the next time that its moment comes from now on."""
        trigger = act.trigger
        so_far = self._moments.counts[trigger.kind, trigger.address]
        self.add(replace(act, trigger=replace(trigger, times=so_far + 1)))

    def drop_all(self) -> None:
        """Forget every act that was not carried out yet."""
        self._acts = tuple(act for act in self._acts if act in self._done)
        self._moments.drop_all()
        self._due = []

    @property
    def left(self) -> tuple[Act, ...]:
        """The acts whose moments have not come, in the order of the script."""
        return tuple(act for act in self._acts if act not in self._done)

    def hear(self, events: Iterable[Event]) -> None:
        """Take in events: states that became active, operations that began, tasks that opened."""
        for event in events:
            for time, act, task in self._moments.met(event):
                self._due.append(Due(time, act, task, act.trigger.turn))
            self._due = [due for due in self._due if not self._moments.is_over(due.act, due.task)]

    def has_something(self, dispatcher: Dispatcher) -> bool:
        """Whether ``before`` has something to do now: a command, or to leave the run."""
        ready = self._ready(dispatcher)
        busy = self._asking or self._resuming or ready or self._come(dispatcher)
        return bool(busy or self._leaves(ready, dispatcher))

    def before(self, dispatcher: Dispatcher) -> None:
        """Give the commands that are due now."""
        come = self._come(dispatcher)
        ready = self._ready(dispatcher)
        for due in come:
            if due.turn > 1:
                self._due[self._due.index(due)] = replace(due, turn=due.turn - 1)
        if self._asking is not None:
            act, self._asking = self._asking, None
            dispatcher.take(_command(act))
            return
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
        nothing = not ready and not self._due and not self._stays
        return nothing and dispatcher.phase in WAITING

    def _come(self, dispatcher: Dispatcher) -> list[Due]:
        """Return the acts whose time has come, though perhaps not their turn."""
        now = dispatcher.time + HAIR
        return [due for due in self._due if due.time <= now]

    def _ready(self, dispatcher: Dispatcher) -> list[Due]:
        """Return the acts that are due. In a paused run time does not move, so the next act by
        time is due at once."""
        come = self._come(dispatcher)
        ready = [due for due in come if due.turn <= 1]
        if not come and dispatcher.phase == "paused" and not self._resuming:
            soonest = min((due.time for due in self._due), default=0.0)
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
