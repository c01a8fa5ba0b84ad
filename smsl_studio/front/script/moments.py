"""The moments of acts that depend on events of the run: states, operations, tasks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.front.script.script import ASKED, DURING, EVERY, WHEN, Act
from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event

Met = tuple[float, Act, str]
"""The time of an act (simulated s), the act, and the task that it answers."""


class Moments:
    """Follows the events of a run and finds the acts whose moments have come.

    The moment of an act with ``during`` passes when its operation ends. The moment of an answer
    passes when its task is closed. ``counts`` says how often each state was entered and each
    operation has begun. ``going`` has the begin (simulated s) of the operations that are under way,
    the latest one last.
    """

    def __init__(self, acts: Iterable[Act] = ()) -> None:
        self._acts: list[Act] = []
        for act in acts:
            self.add(act)
        self.counts: Counter[tuple[str, str]] = Counter()
        self.going: dict[str, float] = {}
        self._tasks: Counter[Act] = Counter()
        self._configuration: dict[str, str] = {}
        self._open: set[str] = set()

    def add(self, act: Act) -> None:
        """Wait for the moment of one more act."""
        if act.trigger.kind in (WHEN, DURING, ASKED):
            self._acts.append(act)

    def drop_all(self) -> None:
        """Wait for no moment any more."""
        self._acts = []

    def met(self, event: Event) -> Iterator[Met]:
        """Yield the acts whose moments come with an event."""
        match event:
            case run.RunStarted():
                yield from self._arrived(event, event.start)
            case run.Committed():
                for address in event.operations:
                    self.going.pop(address, None)
                yield from self._arrived(event, event.configuration)
            case run.Relocalised():
                self.going.clear()
                known = self._configuration.items()
                yield from self._arrived(event, dict(event.configuration.items() - known))
            case run.OperationStarted():
                self.going.pop(event.address, None)
                self.going[event.address] = event.t
                yield from self._of(DURING, event.address, event.t)
            case run.OperationEnded():
                self.going.pop(event.address, None)
            case run.Held() | run.Mismatch() | run.RunStopped() | run.TakenOver():
                self.going.clear()
            case run.TaskOpened():
                self._open.add(event.task)
                yield from self._asked(event)
            case run.TaskClosed():
                self._open.discard(event.task)
            case _:
                pass

    def is_over(self, act: Act, task: str) -> bool:
        """Whether the moment of an act has come and has passed already."""
        if act.trigger.kind == DURING:
            return act.trigger.address not in self.going
        return bool(task) and task not in self._open

    def _arrived(self, event: Event, states: Mapping[str, str]) -> Iterator[Met]:
        self._configuration.update(states)
        for branch, state in states.items():
            yield from self._of(WHEN, str(Address(branch, state)), event.t)

    def _of(self, kind: str, address: str, time: float) -> Iterator[Met]:
        self.counts[kind, address] += 1
        known = (EVERY, self.counts[kind, address])
        for act in self._acts:
            trigger = act.trigger
            if (trigger.kind, trigger.address) == (kind, address) and trigger.times in known:
                yield time + trigger.seconds, act, ""

    def _asked(self, event: run.TaskOpened) -> Iterator[Met]:
        for act in self._acts:
            kind, address = act.given.get("kind"), act.given.get("address")
            fits = kind in (None, event.kind) and address in (None, event.address)
            if act.trigger.kind == ASKED and fits:
                self._tasks[act] += 1
                if act.trigger.times in (EVERY, self._tasks[act]):
                    yield event.t + act.trigger.seconds, act, event.task
