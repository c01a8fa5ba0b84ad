"""The ends of tasks, as lines that stay until they are dismissed. No widget."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from smsl_studio.dispatch.people.task import Task
from smsl_studio.runlog.events import Event, TaskAnswered, TaskClosed, TaskOpened

MOST = 2
"""The largest number of lines. The events of the run have all ends."""


@dataclass(frozen=True)
class TaskOutcome:
    """One line. ``kind`` is ``answered``, ``disagreed``, ``timed_out`` or ``withdrawn``."""

    task: str
    kind: str
    words: str
    late: tuple[str, ...] = ()
    """Sentences about answers that came after the end."""
    question: str = ""


class Outcomes:
    """The ends of tasks that nobody has dismissed yet, newest last."""

    def __init__(self) -> None:
        self.lines: tuple[TaskOutcome, ...] = ()
        self.refusals: dict[str, str] = {}
        """For each open task why the last answer did not count."""
        self._asked: dict[str, tuple[str, dict[str, str]]] = {}
        """For each task its question, and the words of its options."""

    def clear(self) -> None:
        """Forget everything, because another run begins."""
        self.lines = ()
        self.refusals.clear()
        self._asked.clear()

    def see(self, tasks: Iterable[Task]) -> None:
        """Keep the questions and options of open tasks, for their ends."""
        for task in tasks:
            options = {option.value: option.words for option in task.options}
            self._asked[task.name] = task.question, options
            self._asked_again(task.name, task.question)

    def tell(self, events: Iterable[Event]) -> None:
        """Take in the next events."""
        for event in events:
            if isinstance(event, TaskOpened):
                self._asked.setdefault(event.task, (event.question, {}))
                self._asked_again(event.task, event.question)
            elif isinstance(event, TaskClosed):
                self.refusals.pop(event.task, None)
                question = self._asked.get(event.task, ("", {}))[0]
                words = self._words(event)
                self._add(TaskOutcome(event.task, event.outcome, words, question=question))
            elif isinstance(event, TaskAnswered):
                self._answered(event)

    def dismiss(self, line: TaskOutcome) -> None:
        """Remove one line."""
        self.lines = tuple(one for one in self.lines if one != line)

    def _asked_again(self, task: str, question: str) -> None:
        """Remove the line that a question is not asked any more, because it is."""
        self.lines = tuple(
            one
            for one in self.lines
            if one.kind != "withdrawn" or one.question != question or one.task == task
        )

    def _add(self, line: TaskOutcome) -> None:
        self.lines = (*self.lines, line)[-MOST:]

    def _answered(self, event: TaskAnswered) -> None:
        if not event.refused:
            self.refusals.pop(event.task, None)
            return
        words = f"The answer of {event.by} does not count: {event.refused}."
        over = next((one for one in self.lines if one.task == event.task), None)
        if over is None:
            self.refusals[event.task] = words
            return
        later = replace(over, late=(*over.late, words))
        self.lines = tuple(later if one == over else one for one in self.lines)

    def _words(self, event: TaskClosed) -> str:
        question, options = self._asked.get(event.task, ("", {}))
        said = {by: options.get(value, value) for by, value in event.answers.items()}
        asked = f"{question} " if question else ""
        each = "; ".join(f"{by}: {words}" for by, words in said.items())
        if event.outcome == "answered":
            who = _listed(list(said))
            agreed = f"{who} agreed: " if len(said) > 1 else f"{who}: "
            return f"{asked}{agreed}{options.get(event.answer, event.answer)}."
        if event.outcome == "disagreed":
            return f"{asked}The answers differ. {each}. This is no yes."
        if event.outcome == "timed_out":
            who = _listed(list(said))
            only = f"Only {who} answered in time" if said else "Nobody answered in time"
            return f"{asked}{only}. This is no yes."
        return f"{asked}No longer asked: no answer is needed now."


def _listed(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]]) if len(names) > 1 else "".join(names)
