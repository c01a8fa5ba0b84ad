"""The content of the card of an open task. Pure functions, no widget."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from string import ascii_uppercase

from smsl_studio.blueprint.person_names import same_name
from smsl_studio.dispatch.people.seats import seated
from smsl_studio.dispatch.people.task import Answered, Task
from smsl_studio.dispatch.supervision.table import COMMANDS

HAIR = 1e-6
"""The tolerance of times (s). They are sums of ticks, so half of 120 s may be slightly more than
60.
"""
PLACES = ("First person", "Second person", "Third person", "Fourth person", "Fifth person")
NUMBERS = ("no", "one", "two", "three", "four", "five")
TAKEN = frozenset(row.key for row in COMMANDS.values() if len(row.key) == 1)
"""The keys of commands, such as veto or prune. They keep this meaning while a card is shown."""
YOURS, A_DECISION, YOURS_IS_IN = (
    "Your decision is needed",
    "A decision is needed",
    "Your answer is in",
)


@dataclass(frozen=True)
class OptionView:
    """One possible answer: its value in the record, its words, and its letter on the keyboard."""

    value: str
    words: str
    letter: str


@dataclass(frozen=True)
class PersonView:
    """One person who must answer: the role or place, the name, the words for it, whether the person
    has answered, and whether it is the person at this window.
    """

    place: str
    name: str
    words: str
    answered: bool
    you: bool


@dataclass(frozen=True)
class CardView:
    """The content of a card.

    ``share`` of the time is left. ``escalation`` is the share at which another role is asked too, 0
    for none. ``objection`` says why the chosen person must not answer, and is empty otherwise.
    """

    task: str
    heading: str
    left: str
    share: float
    escalation: float
    question: str
    detail: str
    options: tuple[OptionView, ...]
    persons: tuple[PersonView, ...]
    sentence: str
    objection: str


def card_view(task: Task, time: float, name: str, role: str) -> CardView:
    """Return the card of a task at a simulated time (s). ``name`` is the person who would answer,
    empty if nobody is chosen.
    """
    whole = max(task.deadline - task.opened, 1e-9)
    objection = _objection(task, name, role)
    words = tuple(option.words for option in task.options)
    return CardView(
        task=task.name,
        heading=_heading(task, name, role),
        left=clock(task.deadline - time),
        share=min(max((task.deadline - time) / whole, 0.0), 1.0),
        escalation=(task.deadline - task.escalates) / whole if task.escalation else 0.0,
        question=task.question,
        detail=task.detail,
        options=tuple(
            OptionView(option.value, option.words, letter)
            for option, letter in zip(task.options, letters(words), strict=True)
        ),
        persons=_persons(task, name, role),
        sentence=_sentence(task),
        objection=objection,
    )


def clock(seconds: float) -> str:
    """Return a simulated time such as ``1:42``. It is rounded up, so that 0:00 means no time
    left.
    """
    whole = max(ceil(seconds - HAIR), 0)
    return f"{whole // 60}:{whole % 60:02}"


def may_answer(task: Task, name: str, role: str) -> bool:
    """Return whether an answer of this person would count."""
    return bool(same_name(name)) and not _objection(task, name, role)


def _objection(task: Task, name: str, role: str) -> str:
    if not name:
        return ""
    if _has_answered(task, name):
        return f"{name} has answered. Another person must answer as well."
    given = [one.role for one in task.answered]
    if seated(task.roles, [*given, role], task.escalation if task.escalated else ""):
        return ""
    who = f"{name} is {_article(role)} {role}" if role else f"{name} has no role"
    return f"It is asked of {_wanted(task)}; {who}."


def _heading(task: Task, name: str, role: str) -> str:
    if name and _has_answered(task, name):
        return YOURS_IS_IN
    return YOURS if not name or may_answer(task, name, role) else A_DECISION


def _has_answered(task: Task, name: str) -> bool:
    return any(same_name(one.by) == same_name(name) for one in task.answered)


def _persons(task: Task, name: str, role: str) -> tuple[PersonView, ...]:
    """Return the places of those who have answered, and the places that are open."""
    seats: list[Answered | None] = [None] * task.persons
    for one in task.answered:
        seats[_seat(task, seats, one.role)] = one
    mine = may_answer(task, name, role)
    found = []
    for at, taken in enumerate(seats):
        place = task.roles[at] or (PLACES[at] if task.persons > 1 else "Anybody")
        if taken is not None:
            you = same_name(taken.by) == same_name(name)
            who = f"{taken.by}, you" if you else taken.by
            found.append(PersonView(capital_word(place), who, _when(taken), True, you))
            continue
        you = mine and _seat(task, seats, role) == at
        mine = mine and not you
        who = f"{name}, you" if you else ""
        found.append(PersonView(capital_word(place), who, "not yet answered", False, you))
    return tuple(found)


def _seat(task: Task, seats: Sequence[Answered | None], role: str) -> int:
    """Return the place that an answer takes: one of its role, else one for anybody, else the first
    open one.
    """
    free = [at for at, taken in enumerate(seats) if taken is None]
    for wanted in (same_name(role), ""):
        for at in free:
            if same_name(task.roles[at]) == wanted:
                return at
    return free[0] if free else 0


def _when(answered: Answered) -> str:
    return f"answered at {answered.at:.1f} s"


def _sentence(task: Task) -> str:
    parts = []
    if task.persons > 1:
        both = task.persons == 2
        all_ = "Both" if both else f"All {_number(task.persons)}"
        parts.append(f"{all_} answers stay hidden until {'both' if both else 'all'} are in.")
    holds = "at 0:00 the run holds"
    if task.escalation and task.escalated:
        parts.append(f"The {task.escalation} is asked as well; {holds}.")
    elif task.escalation:
        at = clock(task.deadline - task.escalates)
        parts.append(f"At {at} the {task.escalation} is asked as well; {holds}.")
    else:
        parts.append(f"{capital_word(holds)}.")
    return " ".join([*parts, "Silence is never a yes."])


def _wanted(task: Task) -> str:
    """Return whose answers are asked for, such as ``a surgeon and anybody``."""
    names = [f"{_article(role)} {role}" if role else "anybody" for role in task.roles]
    if task.escalated and task.escalation:
        names.append(f"{_article(task.escalation)} {task.escalation}")
    unlike = list(dict.fromkeys(names))
    return " and ".join([", ".join(unlike[:-1]), unlike[-1]] if len(unlike) > 1 else unlike)


def _article(word: str) -> str:
    return "an" if word[:1].casefold() in set("aeiou") else "a"


def _number(count: int) -> str:
    return NUMBERS[count] if count < len(NUMBERS) else str(count)


def capital_word(words: str) -> str:
    """Return the words with a capital first letter."""
    return words[:1].upper() + words[1:]


def letters(words: Sequence[str]) -> tuple[str, ...]:
    """Return a letter for each text: a free first letter of a word, else a free letter in the text,
    else any free letter. Empty if no letter is free.
    """
    given: list[str] = []
    for text in words:
        upper = text.upper()
        first = [word[0] for word in upper.split()]
        free = (
            one
            for one in (*first, *upper, *ascii_uppercase)
            if one in ascii_uppercase and one not in TAKEN and one not in given
        )
        given.append(next(free, ""))
    return tuple(given)
