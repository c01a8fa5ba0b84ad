"""Who caused the events of a run. A command or an answer comes before its effects, at the same
simulated time.
"""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import fact_text
from smsl_studio.runlog import events as run
from smsl_studio.runlog.command_word import CommandWord, CommandWords
from smsl_studio.runlog.events import Event

FACT, OPERATION = "fact", "operation"
"""The kinds of tasks whose answers have effects that are told by another event."""


class Causes:
    """Finds who caused each event of a run. It must get all events once, in order.

    ``commands`` are the commands that the run may contain, ``asked`` its tasks (see ``RunMoment``).
    """

    def __init__(self, commands: CommandWords, asked: Mapping[str, run.TaskOpened]) -> None:
        self._words = _explaining(commands)
        self._asked = asked
        self._time = 0.0
        self._by: dict[str, str] = {}
        """Who gave each command at this time."""
        self._said: dict[str, str] = {}
        """Who has answered each question for a fact at this time."""
        self._did: dict[str, str] = {}
        """Who has answered that an operation was carried out, until the end of the operation is
        told.
        """

    def of(self, event: Event) -> str:
        """Return who caused an event, or the empty text if no command or answer did."""
        if event.t != self._time:
            self._time, self._by, self._said = event.t, {}, {}
        match event:
            case run.Commanded():
                if not event.refused:
                    self._by[event.command] = event.by
                return event.by
            case run.TaskClosed() if event.outcome == "answered":
                self._answered(event)
            case run.FactChanged() if self._said and event.value is not None:
                people = self._said.get(fact_text(event.branch, event.digit), "")
                if people:
                    return people
            case run.OperationEnded() if event.address in self._did:
                return self._did.pop(event.address)
        found = (self._by[word] for word in self._words.get(event.event, ()) if word in self._by)
        return next(found, "")

    def _answered(self, event: run.TaskClosed) -> None:
        task = self._asked.get(event.task)
        if task is not None and task.kind == FACT:
            self._said[task.address] = ", ".join(event.answers)
        elif task is not None and task.kind == OPERATION:
            self._did[task.address] = ", ".join(event.answers)


def _explaining(commands: CommandWords) -> Mapping[str, tuple[str, ...]]:
    """Return the commands that explain each event. Those that must cause it come first."""
    found: dict[str, list[CommandWord]] = {}
    for one in commands.values():
        for event in one.explains:
            found.setdefault(event, []).append(one)
    return {
        event: tuple(one.word for one in sorted(some, key=lambda one: one.owes != event))
        for event, some in found.items()
    }
