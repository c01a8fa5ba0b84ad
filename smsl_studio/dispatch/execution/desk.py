"""The desk: it puts the run's questions to people, and calls back with the answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from smsl_studio.blueprint.address import split_fact
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.people.board import (
    ANSWERED,
    DISAGREED,
    TIMED_OUT,
    Closed,
    Question,
    TaskBoard,
)
from smsl_studio.dispatch.people.task import Task
from smsl_studio.runlog.events import Event, TaskAnswered, TaskClosed
from smsl_studio.runlog.moment import waiting_words

NOBODY = "nobody is there to answer"
Then = Callable[[tuple[Closed, ...]], None]
"""The function that is called with the closed tasks: all of them, or those up to the first answer
that stops the run.
"""


class Desk:
    """Keeps one group of questions that are asked together.

    ``someone`` says whether anybody is there to answer. The desk decides nothing. It calls ``then``
    with the closed tasks when all are closed, or when one of them is not a yes. In this case the
    others are withdrawn, because their answers could change nothing.
    ``busy`` says whether the run waits for people.
    """

    def __init__(self, run: LiveRun, someone: Callable[[], bool]) -> None:
        self._run = run
        self._someone = someone
        self._board = TaskBoard()
        self._names: tuple[str, ...] = ()
        self._then: Then | None = None
        self.busy = False
        self._keeps = False

    @property
    def keeps(self) -> bool:
        """Whether people are asked about the facts of the procedure. Such questions stay open
        whatever commands come about edges, and the scene is not judged until they are answered.
        """
        return self.busy and self._keeps

    @property
    def tasks(self) -> tuple[Task, ...]:
        """The open tasks, oldest first."""
        return self._board.tasks

    @property
    def sentence(self) -> str:
        """The sentence about what the run waits for, empty if it does not wait for people."""
        return waiting_words([task.question for task in self._board.tasks])

    @property
    def nobody(self) -> str:
        """The sentence that nobody is there to answer the open question."""
        return " ".join((NOBODY, *(_quoted(task.question) for task in self._board.tasks[:1])))

    def ask(self, questions: Sequence[Question], then: Then, keep: bool = False) -> str:
        """Put questions to people. Return why this is not possible, or the empty text. ``keep``
        says that they are about the facts of the procedure, not about its next step.
        """
        if not self._someone():
            return f"{NOBODY} {_quoted(questions[0].question)}"
        self.withdraw()
        names = []
        for question in questions:
            task, events = self._board.open(question, self._run.time)
            self._run.emit(*events)
            names.append(task.name)
        self._names, self._then, self._keeps = tuple(names), then, keep
        self.busy = True
        return ""

    def answer(self, task: str, option: str, role: str, by: str) -> str:
        """Take somebody's answer. Return why it does not count, or the empty text."""
        now = self._run.time
        events = self._board.answer(task, option, by=by, role=role, now=now)
        self._tell(events)
        return next(one.refused for one in events if isinstance(one, TaskAnswered))

    def pass_time(self) -> None:
        """Let time pass: other roles may be asked, and deadlines may end."""
        self._tell(self._board.tick(self._run.time))

    def settled(self) -> bool:
        """Return whether the answers are complete. If so, the function ``then`` was called with
        them.
        """
        closed = [one for name in self._names if (one := self._board.closed(name)) is not None]
        if self._then is None or (
            len(closed) < len(self._names) and all(one.yes for one in closed)
        ):
            return False
        then, self._then, self._names, self.busy = self._then, None, (), False
        self._run.emit(*self._board.withdraw(self._run.time))
        then(tuple(closed))
        return True

    def withdraw(self) -> None:
        """Withdraw all questions, because the run has moved on. Nobody is called back."""
        if self._then is None:  # without a group of questions no task is open
            return
        self._then, self._names, self.busy = None, (), False
        self._run.emit(*self._board.withdraw(self._run.time))

    def _tell(self, events: Sequence[Event]) -> None:
        self._run.emit(*events)
        for event in events:
            if isinstance(event, TaskClosed):
                self._learn(event)

    def _learn(self, event: TaskClosed) -> None:
        """Take in a fact that people have told. It counts at once, even while others are still
        asked.
        """
        closed = self._board.closed(event.task)
        if closed is None or closed.task.kind != "fact" or not closed.yes or not closed.answer:
            return
        fact = split_fact(closed.task.address)
        assert fact is not None, "a fact's task has its address"
        who = ", ".join(event.answers)
        self._run.emit(*self._run.senses.answer(*fact, closed.answer.value, who))


def no_words(closed: Sequence[Closed]) -> str:
    """Return why the answers do not let the run go on, or the empty text."""
    return next((_why(one) for one in closed if not one.yes), "")


def who_words(closed: Closed) -> str:
    """Return the names of those who have answered a task."""
    return " and ".join(one.by for one in closed.task.answered) or "nobody"


def _why(closed: Closed) -> str:
    task = closed.task
    question, who = _quoted(task.question), who_words(closed)
    if closed.outcome == ANSWERED and closed.answer is not None:
        return f"{who} answered {_quoted(closed.answer.words)} to {question}"
    if closed.outcome == TIMED_OUT:
        some = f"only {who}" if task.answered else "nobody"
        return f"{some} answered {question} within {task.deadline - task.opened:g} s"
    if closed.outcome == DISAGREED:
        return f"{who} did not give the same answer to {question}"
    return f"{question} was withdrawn"


def _quoted(words: str) -> str:
    return f'"{words}"'
