"""What people were asked and said in a run: so that an account says it in words, and by whom."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import fact_text
from smsl_studio.runlog import events as run
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.names import HeaderNames

FACT, OPERATION = "fact", "operation"


class TaskAnswers:
    """The tasks of a run so far. Each event is looked at once, in order."""

    def __init__(self) -> None:
        self._tasks: dict[str, run.TaskOpened] = {}
        self._said: dict[str, tuple[float, str]] = {}
        self._did: dict[str, str] = {}

    def see(self, event: Event) -> None:
        """Keep what is asked, and who has said or done what."""
        if isinstance(event, run.TaskOpened):
            self._tasks[event.task] = event
        elif isinstance(event, run.TaskClosed) and event.outcome == "answered":
            task = self._tasks.get(event.task)
            if task is not None and task.kind == FACT:
                self._said[task.address] = event.t, ", ".join(event.answers)
            elif task is not None and task.kind == OPERATION:
                self._did[task.address] = ", ".join(event.answers)

    def by(self, event: Event) -> str:
        """The persons whose word a reading is, or who did what has ended; else empty."""
        if isinstance(event, run.FactChanged) and event.value is not None:
            time, people = self._said.get(fact_text(event.branch, event.digit), (None, ""))
            return people if time == event.t else ""
        if isinstance(event, run.OperationEnded):
            return self._did.pop(event.address, "")
        return ""

    def worded(self, event: Event, names: HeaderNames) -> Event:
        """The same event with the question beside the name of its task, and values in words."""
        if isinstance(event, run.TaskOpened):
            options = tuple(self._value(event, one, names) for one in event.options)
            return replace(event, options=options)
        if isinstance(event, run.Commanded) and event.command == "answer":
            return replace(event, value=self._task(event.value))
        if isinstance(event, run.TaskClosed):
            task = self._tasks.get(event.task)
            answers: Mapping[str, str] = {
                by: self._value(task, one, names) for by, one in event.answers.items()
            }
            answer = self._value(task, event.answer, names)
            return replace(event, task=self._task(event.task), answer=answer, answers=answers)
        if isinstance(event, run.TaskAnswered | run.TaskEscalated):
            return replace(event, task=self._task(event.task))
        return event

    def _task(self, name: str) -> str:
        asked = self._tasks.get(name)
        return f'{name} "{asked.question}"' if asked is not None and asked.question else name

    def _value(self, task: run.TaskOpened | None, value: str, names: HeaderNames) -> str:
        return names.value(task.address, value) if task is not None and task.kind == FACT else value
