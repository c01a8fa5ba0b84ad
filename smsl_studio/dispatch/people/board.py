"""The board of open tasks. It keeps who has answered what, in simulated time.

::

    open ──all answered the same──▶ answered
      ├────all answered, they differ──▶ disagreed
      ├────the deadline passed──▶ timed_out      (another role may answer from half time on)
      └────the run moved on──▶ withdrawn

Answers are hidden until all are given. An outcome never changes. Only ``answered`` has an answer,
and no option is chosen in advance. The board has no clock: callers give the time (simulated
seconds), and get events.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.person_names import NAMELESS, same_name
from smsl_studio.dispatch.people.seats import seated
from smsl_studio.dispatch.people.task import Answered, Option, Task
from smsl_studio.errors import did_you_mean
from smsl_studio.runlog.events import (
    Event,
    TaskAnswered,
    TaskClosed,
    TaskEscalated,
    TaskOpened,
)

WITHIN = 120.0
"""The simulated seconds to answer a task if none are declared."""

HAIR = 1e-9
ANSWERED, DISAGREED, TIMED_OUT, WITHDRAWN = "answered", "disagreed", "timed_out", "withdrawn"
OVER = {
    ANSWERED: "it was answered already",
    DISAGREED: "it is over: the answers differed",
    TIMED_OUT: "it is too late, the time ran out",
    WITHDRAWN: "it was withdrawn, the run has moved on",
}


@dataclass(frozen=True, slots=True)
class Question:
    """The content of a task. ``within`` (simulated s) None means ``WITHIN``. ``Task`` explains the
    others.
    """

    kind: str
    address: str
    question: str
    options: tuple[Option, ...]
    roles: tuple[str, ...] = ("",)
    detail: str = ""
    within: float | None = None
    escalation: str = ""


@dataclass(frozen=True, slots=True)
class Closed:
    """The end of a task. ``answer`` is the option that all chose, and None for every other
    outcome.
    """

    task: Task
    outcome: str
    answer: Option | None = None

    @property
    def yes(self) -> bool:
        """Whether the run may go on: all have given the same answer, and it is a yes."""
        return self.outcome == ANSWERED and self.answer is not None and self.answer.yes


class TaskBoard:
    """All tasks of one run. Times must not go back. Every method returns its events."""

    def __init__(self) -> None:
        self._open: dict[str, Task] = {}
        self._said: dict[str, dict[str, Option]] = {}
        self._closed: dict[str, Closed] = {}
        self._count = 0

    @property
    def tasks(self) -> tuple[Task, ...]:
        """The open tasks, oldest first. They do not contain answers."""
        return tuple(self._open.values())

    def closed(self, name: str) -> Closed | None:
        """Return the end of a task. None if it is open, or if there is no such task."""
        return self._closed.get(name)

    def open(self, question: Question, now: float) -> tuple[Task, tuple[Event, ...]]:
        """Open a task with a name that is new in this run."""
        self._count += 1
        within = WITHIN if question.within is None else question.within
        task = Task(
            name=f"task-{self._count}",
            kind=question.kind,
            address=question.address,
            question=question.question,
            detail=question.detail,
            options=question.options,
            roles=question.roles or ("",),
            opened=now,
            escalates=now + within / 2,
            deadline=now + within,
            escalation=question.escalation,
        )
        self._open[task.name], self._said[task.name] = task, {}
        opened = TaskOpened(
            t=now,
            task=task.name,
            kind=task.kind,
            address=task.address,
            question=task.question,
            options=tuple(option.value for option in task.options),
            role=", ".join(role for role in task.roles if role),
            persons=task.persons,
            deadline=task.deadline,
        )
        return task, (opened,)

    def find(self, text: str) -> str:
        """Return the name of a task. ``text`` is its name, or the address of the only open task
        about it; an empty text means the only open task. Otherwise the result is the text itself.
        """
        if text in self._open or text in self._closed:
            return text
        found = [one.name for one in self._open.values() if text in ("", one.address)]
        return found[0] if len(found) == 1 else text

    def answer(
        self, name: str, option: str, *, by: str, role: str = "", now: float
    ) -> tuple[Event, ...]:
        """Take an answer. An answer that does not count is told with the reason, and changes
        nothing.
        """
        events = self.tick(now)
        name = self.find(name)
        refused = self._refusal(name, option, by, role)
        told = TaskAnswered(t=now, task=name, by=by, role=role, refused=refused)
        if refused:
            return (*events, told)
        task = self._open[name]
        chosen = next(one for one in task.options if one.value == option)
        self._said[name][by] = chosen
        task = replace(task, answered=(*task.answered, Answered(by, role, now)))
        self._open[name] = task
        if len(task.answered) < task.persons:
            return (*events, told)
        agreed = len({one.value for one in self._said[name].values()}) == 1
        closed = self._close(name, ANSWERED if agreed else DISAGREED, now)
        return (*events, told, closed)

    def tick(self, now: float) -> tuple[Event, ...]:
        """Let time pass. At half time another role may answer too, and at the deadline the task
        ends.
        """
        events: list[Event] = []
        for name, task in list(self._open.items()):
            if now >= task.escalates - HAIR and not task.escalated:
                self._open[name] = replace(task, escalated=True)
                events.append(TaskEscalated(t=now, task=name, role=task.escalation))
            if now >= task.deadline - HAIR:
                events.append(self._close(name, TIMED_OUT, now))
        return tuple(events)

    def withdraw(self, now: float, names: Sequence[str] | None = None) -> tuple[Event, ...]:
        """Withdraw some open tasks, or all of them, because the run needs no answer any more."""
        chosen = [name for name in self._open if names is None or name in names]
        return tuple(self._close(name, WITHDRAWN, now) for name in chosen)

    def _refusal(self, name: str, option: str, by: str, role: str) -> str:
        """Return why an answer does not count, or the empty text."""
        over = self._closed.get(name)
        if over is not None:
            return OVER[over.outcome]
        task = self._open.get(name)
        if task is None:
            words = did_you_mean(name, self._open)
            return f"there is no open task {name!r}" + (f". {words}" if words else "")
        who = same_name(by)
        if not who:
            return "an answer needs the name of a person"
        if task.persons > 1 and who in NAMELESS:
            return f"{task.persons} persons must be told apart, say the name of who answers"
        if any(same_name(one.by) == who for one in task.answered):
            return f"{by} has answered already; another person must"
        if option not in (one.value for one in task.options):
            known = ", ".join(one.value for one in task.options)
            return f"{option!r} is no answer to it, choose one of {known}"
        also = task.escalation if task.escalated else ""
        given = [one.role for one in task.answered]
        if not seated(task.roles, [*given, role], also):
            return f"{_role_words(role)} may not answer it, it is asked of {_asked(task)}"
        return ""

    def _close(self, name: str, outcome: str, now: float) -> TaskClosed:
        task, said = self._open.pop(name), self._said.pop(name)
        agreed = next(iter(said.values())) if outcome == ANSWERED else None
        # otherwise those who are asked next could see the answers
        told = said if len(said) == task.persons else {}
        self._closed[name] = Closed(task, outcome, agreed)
        return TaskClosed(
            t=now,
            task=name,
            outcome=outcome,
            answer=agreed.value if agreed else "",
            answers={by: option.value for by, option in told.items()},
        )


def _role_words(role: str) -> str:
    return f"the role {role}" if same_name(role) else "a person without a role"


def _asked(task: Task) -> str:
    """Return whose answers are still needed, in words."""
    names = [role or "anybody" for role in task.roles]
    if task.escalation:
        when = "" if task.escalated else f" (from {task.escalates:g} s on)"
        names.append(f"{task.escalation}{when}")
    return ", ".join(names)
