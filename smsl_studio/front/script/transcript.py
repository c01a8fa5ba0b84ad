"""The transcript of a run: what people did in it by hand, as the lines of a script.

If the script supervises an equal run, it gives the same commands at the same ticks. So the run has
the same events.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import floor
from typing import Any

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.front.script.moments import Moments
from smsl_studio.front.script.script import AT, DURING
from smsl_studio.front.script.words import apart, said_as
from smsl_studio.runlog.events import Event, TaskOpened

Json = Any
FINEST = 1e6
"""Times are written in millionths of a second, rounded down, so that no act comes a tick late."""


class Transcript:
    """Writes down the commands of one run. The loop of the run calls it around every tick.

    ``lines`` are those of the script so far. It may be read from any thread.
    """

    def __init__(self) -> None:
        self.lines: tuple[Mapping[str, Json], ...] = ()
        self._moments = Moments()
        self._tasks: dict[str, TaskOpened] = {}
        self._time = -1.0
        self._ticks = 0
        self._began: dict[str, int] = {}
        self._given: tuple[Command, ...] = ()
        self._moment: Mapping[str, Json] = {}

    def before(self, dispatcher: Dispatcher) -> None:
        """Note what the next tick carries out, and when this is."""
        if dispatcher.time != self._time:
            self._time, self._ticks, self._began = dispatcher.time, 0, {}
        self._given = dispatcher.waiting
        self._moment = self._now() if self._given else {}

    def after(self, dispatcher: Dispatcher, events: Iterable[Event], whole: bool = True) -> None:
        """Write down what the tick has carried out. ``whole`` is False if it was called off."""
        waiting = {id(command) for command in dispatcher.waiting}
        for command in self._given:
            if id(command) not in waiting:
                self.lines += ({**self._moment, **self._said(command)},)
        self._ticks += whole
        self.hear(events)

    def hear(self, events: Iterable[Event]) -> None:
        """Take in events: operations that began or ended, and tasks that were opened."""
        for event in events:
            before = len(self._moments.going)
            for _ in self._moments.met(event):
                pass
            if isinstance(event, TaskOpened):
                self._tasks[event.task] = event
            if len(self._moments.going) > before:
                self._began[next(reversed(self._moments.going))] = self._ticks

    def _now(self) -> Mapping[str, Json]:
        """Return the moment of the next tick: in the middle of an operation, or a time."""
        address = next(reversed(self._moments.going), "")
        turn = self._ticks + 1 - self._began.get(address, 0)
        found: dict[str, Json] = {AT: _rounded(self._time)}
        if address:
            found = {DURING: address}
            times = self._moments.counts[DURING, address]
            after = _rounded(self._time - self._moments.going[address])
            found |= {"times": times} if times > 1 else {}
            found |= {"after": after} if after else {}
        return found | ({"turn": turn} if turn > 1 else {})

    def _said(self, command: Command) -> Mapping[str, Json]:
        word, given = said_as(command)
        task = self._tasks.get(str(command.said.get("task", "")))
        about = {} if task is None else {"kind": task.kind, "address": task.address}
        about = {key: value for key, value in about.items() if value}
        return {"do": word, **about, **apart(word, given), "by": command.by}


def _rounded(seconds: float) -> float:
    return floor(seconds * FINEST + 1e-4) / FINEST
