"""The words of an account for questions to people and their answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.runlog import events as run
from smsl_studio.runlog.causes import FACT
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.names import HeaderNames


def worded(event: Event, asked: Mapping[str, run.TaskOpened], names: HeaderNames) -> Event:
    """Return the event with the question beside the name of its task, and with values in words.

    ``asked`` has the tasks of the run (see ``RunMoment``).
    """
    if isinstance(event, run.TaskOpened):
        options = tuple(_value(event, one, names) for one in event.options)
        return replace(event, options=options)
    if isinstance(event, run.Commanded) and event.command == "answer":
        return replace(event, value=_task(asked, event.value))
    if isinstance(event, run.TaskClosed):
        task = asked.get(event.task)
        answers = {by: _value(task, one, names) for by, one in event.answers.items()}
        answer = _value(task, event.answer, names)
        return replace(event, task=_task(asked, event.task), answer=answer, answers=answers)
    if isinstance(event, run.TaskAnswered | run.TaskEscalated):
        return replace(event, task=_task(asked, event.task))
    return event


def _task(asked: Mapping[str, run.TaskOpened], name: str) -> str:
    task = asked.get(name)
    return f'{name} "{task.question}"' if task is not None and task.question else name


def _value(task: run.TaskOpened | None, value: str, names: HeaderNames) -> str:
    return names.value(task.address, value) if task is not None and task.kind == FACT else value
