"""Carrying a script out: what is due is commanded before the next tick, whoever calls the ticks.

The moments of a script hang on simulated time and on run events alone, so that equal runs are acted
on equally, headless and in the window.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.script.moments import Moments
from smsl_studio.front.script.script import AT, EVERY, Act, Script
from smsl_studio.runlog.events import Event

HAIR = 1e-9
WAITING = ("ready", "paused", "waiting", "no_route", "taken_over", "fault_hold", "stopped")
"""Run states in which nothing moves before somebody says something."""


@dataclass(frozen=True, slots=True)
class Due:
    """An act whose moment is known: simulated s, and the task that it answers, if it does."""

    time: float
    act: Act
    task: str = ""


class ScriptPlayer:
    """One run under one script. Call ``before`` ahead of every tick, and ``hear`` with what the
    tick told. Where the script has nothing more to say to a run that waits, nobody attends it."""

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
        """The acts that never came, in the order of the script."""
        return tuple(act for act in self._acts if act not in self._done)

    def hear(self, events: Iterable[Event]) -> None:
        """What happened: states that became active, operations that began, tasks that opened."""
        for event in events:
            for time, act, task in self._moments.met(event):
                self._due.append(Due(time, act, task))
            self._due = [due for due in self._due if not self._moments.is_over(due.act, due.task)]

    def has_something(self, dispatcher: Dispatcher) -> bool:
        """Whether it will say something before the next tick, though nothing moves: a command, or
        that it leaves."""
        ready = self._ready(dispatcher)
        return bool(self._asking or self._resuming or ready or self._leaves(ready, dispatcher))

    def before(self, dispatcher: Dispatcher) -> None:
        """Command what is due now."""
        if self._asking is not None:
            act, self._asking = self._asking, None
            _ask(dispatcher, act)
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
        """What is due. While simulated time stands still, the next act by time comes at once."""
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
            role = str(act.given.get("role", ""))
            dispatcher.answer(task, act.given["option"], role, by=act.by)
        elif act.do == "ask" and not self._by_hand and _follows_its_route(dispatcher):
            # A route that is followed goes on by itself unless it is paused a tick before.
            dispatcher.pause(by=act.by)
            self._asking, self._resuming = act, act.by
        else:
            self._by_hand = act.do == "by_hand" or (self._by_hand and act.do != "automatic")
            _COMMANDS[act.do](dispatcher, act)
        self._done.add(act)


def _follows_its_route(dispatcher: Dispatcher) -> bool:
    return dispatcher.phase == "running" and dispatcher.status.carrying is None


def _open_task(act: Act, dispatcher: Dispatcher) -> str:
    """The task that is open now and fits an answer; the empty text where none is."""
    kind, address = act.given.get("kind"), act.given.get("address")
    for task in dispatcher.status.tasks:
        if kind in (None, task.kind) and address in (None, task.address):
            return task.name
    return ""


def _address(act: Act) -> Address:
    return Address(*Address.split(act.given["address"]))


def _ask(dispatcher: Dispatcher, act: Act) -> None:
    dispatcher.ask(_address(act), by=act.by, every_time=act.trigger.times == EVERY)


def _veto(dispatcher: Dispatcher, act: Act) -> None:
    dispatcher.veto(_address(act) if "address" in act.given else None, by=act.by)


def _others(act: Act, *own: str) -> Mapping[str, float | str]:
    return {name: value for name, value in act.given.items() if name not in own}


def _disturb(dispatcher: Dispatcher, act: Act) -> None:
    target, kind = act.given["target"], act.given["kind"]
    dispatcher.disturb(target, kind, by=act.by, **_others(act, "target", "kind"))


_COMMANDS: Mapping[str, Callable[[Dispatcher, Act], None]] = MappingProxyType(
    {
        "ask": _ask,
        "pause": lambda d, act: d.pause(by=act.by),
        "resume": lambda d, act: d.resume(by=act.by),
        "step": lambda d, act: d.step(by=act.by),
        "by_hand": lambda d, act: d.set_automatic(False, by=act.by),
        "automatic": lambda d, act: d.set_automatic(True, by=act.by),
        "veto": _veto,
        "prune": lambda d, act: d.prune(_address(act), act.given["reason"], by=act.by),
        "restore": lambda d, act: d.restore(_address(act), by=act.by),
        "set_cost": lambda d, act: d.set_cost(_address(act), act.given["cost"], by=act.by),
        "take_over": lambda d, act: d.take_over(by=act.by),
        "give_back": lambda d, act: d.give_back(by=act.by),
        "accept": lambda d, act: d.accept(by=act.by),
        "adopt": lambda d, act: d.adopt(by=act.by),
        "stop": lambda d, act: d.stop(by=act.by),
        "reset": lambda d, act: d.reset(by=act.by),
        "end": lambda d, act: d.end(by=act.by),
        "full_map": lambda d, act: d.full_map(act.given["on"], by=act.by),
        "disturb": _disturb,
        "inject": lambda d, act: d.inject(act.given["fault"], by=act.by, **_others(act, "fault")),
    }
)
