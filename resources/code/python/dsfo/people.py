"""Tasks: questions to people while a run waits. None has a default answer, and no time-out is a
yes.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from .elements import Blueprint, Edge, FactKey, fact_text, split_fact
from .errors import did_you_mean
from .events import event
from .live import LiveRun

WITHIN = 120.0
"""The seconds to answer a task if none are declared."""
HAIR = 1e-9
NOBODY = "nobody is there to answer"
ANSWERED, DISAGREED, TIMED_OUT, WITHDRAWN = "answered", "disagreed", "timed_out", "withdrawn"
OVER = {
    ANSWERED: "it was answered already",
    DISAGREED: "it is over: the answers differed",
    TIMED_OUT: "it is too late, the time ran out",
    WITHDRAWN: "it was withdrawn, the run has moved on",
}
_NAMELESS = ("aperson", "script")
_UNSEEN = frozenset("\u034f\u115f\u1160\u17b4\u17b5\u180b\u180c\u180d\u180f\u2800")


@dataclass(frozen=True)
class Option:
    """A possible answer: its value in the log, its words, and whether the run may go on with it."""

    value: str
    words: str
    yes: bool


CONFIRM = (Option("confirm", "Confirm", True), Option("refuse", "Do not begin", False))
DONE = (Option("done", "Done", True), Option("could_not", "Could not do it", False))
START = (Option("start", "Start", True), Option("refuse", "Do not start", False))
SUPERVISE = (
    Option("go_on", "Go on", True),
    Option("veto", "Skip it once", False),
    Option("prune", "Shut it out of this run", False),
    Option("pause", "Pause the run", False),
)


@dataclass(frozen=True)
class Question:
    """What is asked of whom. ``roles`` has one role for each person who must agree."""

    kind: str
    address: str
    words: str
    options: tuple[Option, ...]
    roles: tuple[str, ...] = ("",)
    within: float | None = None
    escalation: str = ""


@dataclass
class Task:
    """An open or closed question. ``said`` has the answer and the role of each person."""

    name: str
    question: Question
    opened: float
    escalated: bool = False
    said: dict[str, tuple[Option, str]] = field(default_factory=dict)
    outcome: str = ""

    @property
    def within(self) -> float:
        """The seconds to answer it."""
        return WITHIN if self.question.within is None else self.question.within

    @property
    def deadline(self) -> float:
        """When it ends, in simulated seconds."""
        return self.opened + self.within

    @property
    def answer(self) -> Option | None:
        """The answer on which all agree."""
        return next(iter(self.said.values()))[0] if self.outcome == ANSWERED else None

    @property
    def yes(self) -> bool:
        """Whether the run may go on."""
        return self.answer is not None and self.answer.yes

    @property
    def who(self) -> str:
        """Who has answered."""
        return " and ".join(self.said) or "nobody"

    @property
    def why(self) -> str:
        """Why it does not let the run go on."""
        asked = f'"{self.question.words}"'
        if self.answer is not None:
            return f'{self.who} answered "{self.answer.words}" to {asked}'
        if self.outcome == TIMED_OUT:
            some = f"only {self.who}" if self.said else "nobody"
            return f"{some} answered {asked} within {self.within:g} s"
        if self.outcome == DISAGREED:
            return f"{self.who} did not give the same answer to {asked}"
        return f"{asked} was withdrawn"


def no_words(closed: Sequence[Task]) -> str:
    """Return why some answers do not let the run go on, or the empty text."""
    return next((one.why for one in closed if not one.yes), "")


Then = Callable[[list[Task]], None]


class Desk:
    """Puts one group of questions to people, and calls back with the answers.

    It calls ``then`` when all are answered, or when one of them is not a yes. ``keeps`` says that
    people are asked about the facts of the procedure: such questions stay open whatever comes.
    """

    def __init__(self, run: LiveRun, someone: Callable[[], bool]) -> None:
        self.tasks: dict[str, Task] = {}
        self._run, self._someone = run, someone
        self._group: list[Task] = []
        self._then: Then | None = None
        self._keep = False

    @property
    def busy(self) -> bool:
        """Whether the run waits for people."""
        return self._then is not None

    @property
    def keeps(self) -> bool:
        """Whether people are asked about the facts of the procedure."""
        return self.busy and self._keep

    @property
    def open(self) -> list[Task]:
        """The open tasks, oldest first."""
        return [task for task in self.tasks.values() if not task.outcome]

    @property
    def nobody(self) -> str:
        """The sentence that nobody is there to answer the open question."""
        return " ".join([NOBODY, *(f'"{task.question.words}"' for task in self.open[:1])])

    def ask(self, questions: Sequence[Question], then: Then, keep: bool = False) -> str:
        """Put questions to people. Return why that is not possible, or the empty text."""
        if not self._someone():
            return f'{NOBODY} "{questions[0].words}"'
        self.withdraw()
        self._group = [self._opened(question) for question in questions]
        self._then, self._keep = then, keep
        return ""

    def _opened(self, question: Question) -> Task:
        task = Task(f"task-{len(self.tasks) + 1}", question, self._run.time)
        self.tasks[task.name] = task
        self._run.tell(
            "task_opened",
            task=task.name,
            kind=question.kind,
            address=question.address,
            question=question.words,
            options=[option.value for option in question.options],
            role=", ".join(role for role in question.roles if role),
            persons=len(question.roles),
            deadline=task.deadline,
        )
        return task

    def answer(self, text: str, option: str, role: str, by: str) -> str:
        """Take an answer to a task, named by its name or by its address. Return why it does not
        count, or the empty text.
        """
        self.pass_time()
        task = self._found(text)
        name = text if task is None else task.name
        refused = self._refusal(task, name, option, by, role)
        self._run.tell("task_answered", task=name, by=by, role=role, refused=refused)
        if task is None or refused:
            return refused
        question = task.question
        chosen = next(one for one in question.options if one.value == option)
        task.said[by] = chosen, role
        if len(task.said) == len(question.roles):
            same = len({one.value for one, _ in task.said.values()}) == 1
            self._close(task, ANSWERED if same else DISAGREED)
        return ""

    def _found(self, text: str) -> Task | None:
        if text in self.tasks:
            return self.tasks[text]
        found = [task for task in self.open if text in ("", task.question.address)]
        return found[0] if len(found) == 1 else None

    def pass_time(self) -> None:
        """Let time pass: at half time another role may answer, too; at the deadline a task ends."""
        now = self._run.time
        for task in self.open:
            if now >= task.opened + task.within / 2 - HAIR and not task.escalated:
                task.escalated = True
                role = task.question.escalation
                self._run.tell("task_escalated", task=task.name, role=role)
            if now >= task.deadline - HAIR:
                self._close(task, TIMED_OUT)

    def settled(self) -> bool:
        """Return whether the answers are complete. If so, ``then`` was called with them."""
        closed = [task for task in self._group if task.outcome]
        whole = len(closed) == len(self._group)
        if self._then is None or (not whole and all(task.yes for task in closed)):
            return False
        then, self._then, self._group = self._then, None, []
        self._withdraw_open()
        then(closed)
        return True

    def withdraw(self) -> None:
        """Withdraw all questions: the run has moved on. Nobody is called back."""
        if self._then is not None:
            self._then, self._group = None, []
            self._withdraw_open()

    def _withdraw_open(self) -> None:
        for task in self.open:
            self._close(task, WITHDRAWN)

    def _close(self, task: Task, outcome: str) -> None:
        task.outcome = outcome
        whole = len(task.said) == len(task.question.roles)
        answers = {by: one.value for by, (one, _) in task.said.items()} if whole else {}
        answer = task.answer.value if task.answer else ""
        said = {"outcome": outcome, "answer": answer, "answers": answers}
        self._run.hear([event("task_closed", self._run.time, task=task.name, **said)])
        fact = split_fact(task.question.address) if task.question.kind == "fact" else None
        if fact is not None and task.yes:
            self._run.hear(self._run.senses.answer(fact, answer, ", ".join(answers)))

    def _refusal(self, task: Task | None, name: str, option: str, by: str, role: str) -> str:
        """Return why an answer does not count, or the empty text."""
        if task is None:
            near = did_you_mean(name, [one.name for one in self.open])
            return f"there is no open task {name!r}" + (f". {near}" if near else "")
        if task.outcome:
            return OVER[task.outcome]
        question, who = task.question, same_name(by)
        if not who:
            return "an answer needs the name of a person"
        if len(question.roles) > 1 and who in _NAMELESS:
            many = len(question.roles)
            return f"{many} persons must be told apart, say the name of who answers"
        if any(same_name(one) == who for one in task.said):
            return f"{by} has answered already; another person must"
        if option not in [one.value for one in question.options]:
            known = ", ".join(one.value for one in question.options)
            return f"{option!r} is no answer to it, choose one of {known}"
        also = question.escalation if task.escalated else ""
        given = [said for _, said in task.said.values()]
        if not seated(question.roles, [*given, role], also):
            asked = ", ".join(one or "anybody" for one in question.roles)
            some = f"the role {role}" if same_name(role) else "a person without a role"
            return f"{some} may not answer it, it is asked of {asked}"
        return ""


def same_name(text: str) -> str:
    """Return the form that all spellings of one name share: case, space, accents and invisible
    characters do not matter.
    """
    plain = unicodedata.normalize("NFKC", text)
    seen = "".join(char for char in plain if not _unseen(char))
    return "".join(unicodedata.normalize("NFKC", seen.casefold()).split())


def _unseen(char: str) -> bool:
    if char in _UNSEEN or unicodedata.name(char, "").startswith("VARIATION SELECTOR"):
        return True
    return unicodedata.category(char) in ("Cf", "Cc") and not char.isspace()


def seated(wanted: Sequence[str], given: Sequence[str], escalation: str = "") -> bool:
    """Return whether everyone in ``given`` gets a seat among the roles ``wanted``. An empty role is
    a seat for anybody. The role ``escalation`` may take any seat.
    """
    also = same_name(escalation)
    left = [frozenset(range(len(wanted)))]
    for person in map(same_name, given):
        # Every set of free seats that some order of seating leaves.
        left = list(
            dict.fromkeys(
                free - {seat}
                for free in left
                for seat in free
                if same_name(wanted[seat]) in ("", person) or (also and person == also)
            )
        )
    return bool(left)


# the questions -----------------------------------------------------------------------------------


def operation_task(edge: Edge) -> Question:
    """Return the question for a person who carries out an operation."""
    terms = edge.terms
    words = terms.question or f"{title_of(edge)}: please carry it out"
    roles = terms.roles or ("",)
    within, also = terms.answer_within, terms.escalates_to
    return Question("operation", edge.address, words, DONE, roles, within, also)


def confirm_task(edge: Edge) -> Question:
    """Return the question for people who must agree before an operation begins."""
    terms, words = edge.terms, f"{title_of(edge)}: may it begin?"
    roles = terms.confirm or ("",)
    within, also = terms.answer_within, terms.escalates_to
    return Question("confirm", edge.address, words, CONFIRM, roles, within, also)


def supervise_task(edge: Edge) -> Question:
    """Return the question whether the next operation may begin."""
    return Question("supervise", edge.address, f"{title_of(edge)}: shall it begin?", SUPERVISE)


def start_task() -> Question:
    """Return the question whether the run may start despite what inspection found."""
    return Question("start", "", "Shall the run start?", START)


def fact_task(blueprint: Blueprint, fact: FactKey) -> Question:
    """Return the question for the value of a fact."""
    branch, flag = blueprint[fact[0]], blueprint.flag(fact)
    known = dict.fromkeys([*flag.values, *flag.meanings, *flag.failure])
    unsure = "cannot say"
    while unsure in known:
        unsure += "?"
    options = [Option(value, flag.meanings.get(value, value), True) for value in known]
    unit = f", in {flag.unit}" if flag.unit else ""
    words = flag.question or f"What is {branch.fact_name(fact[1])} of {branch.name}{unit}?"
    return Question(
        "fact",
        fact_text(fact),
        words,
        (*options, Option(unsure, "I cannot say", False)),
        flag.roles or ("",),
        flag.answer_within,
        flag.escalates_to,
    )


def title_of(edge: Edge) -> str:
    """Return the title of an operation, or its name."""
    return edge.terms.title or edge.name
