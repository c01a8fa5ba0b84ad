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
    passes when its task is closed.
    """

    def __init__(self, acts: Iterable[Act]) -> None:
        self._acts = [act for act in acts if act.trigger.kind in (WHEN, DURING, ASKED)]
        self._counts: Counter[Act] = Counter()
        self._configuration: dict[str, str] = {}
        self._going: set[str] = set()
        self._open: set[str] = set()

    def met(self, event: Event) -> Iterator[Met]:
        """Yield the acts whose moments come with an event."""
        match event:
            case run.RunStarted():
                yield from self._arrived(event, event.start)
            case run.Committed():
                self._going.difference_update(event.operations)
                yield from self._arrived(event, event.configuration)
            case run.Relocalised():
                self._going.clear()
                known = self._configuration.items()
                yield from self._arrived(event, dict(event.configuration.items() - known))
            case run.OperationStarted():
                self._going.add(event.address)
                yield from self._of(DURING, event.address, event.t)
            case run.OperationEnded():
                self._going.discard(event.address)
            case run.Held() | run.Mismatch() | run.RunStopped() | run.TakenOver():
                self._going.clear()
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
            return act.trigger.address not in self._going
        return bool(task) and task not in self._open

    def _arrived(self, event: Event, states: Mapping[str, str]) -> Iterator[Met]:
        self._configuration.update(states)
        for branch, state in states.items():
            yield from self._of(WHEN, str(Address(branch, state)), event.t)

    def _of(self, kind: str, address: str, time: float) -> Iterator[Met]:
        for act in self._acts:
            trigger = act.trigger
            if (trigger.kind, trigger.address) == (kind, address) and self._counts_now(act):
                yield time + trigger.seconds, act, ""

    def _asked(self, event: run.TaskOpened) -> Iterator[Met]:
        for act in self._acts:
            kind, address = act.given.get("kind"), act.given.get("address")
            fits = kind in (None, event.kind) and address in (None, event.address)
            if act.trigger.kind == ASKED and fits and self._counts_now(act):
                yield event.t + act.trigger.seconds, act, event.task

    def _counts_now(self, act: Act) -> bool:
        self._counts[act] += 1
        return act.trigger.times in (EVERY, self._counts[act])
