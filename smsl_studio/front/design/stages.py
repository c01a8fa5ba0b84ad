"""The nine stages of the design cycle, and what is known about each: who made it, its digest, its
verdict, and whether it is still about the stages before it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

GENERATIVE, DETERMINISTIC, SITE, PEOPLE = "generative", "deterministic", "site", "people"
"""The kinds of stages (paper): what people and models know; what follows from the blueprint; what
also depends on the place; and what people decide."""
PERSON: Final = "person"
RULES: Final = "rules"
PHYSICS: Final = "physics"
MODEL: Final = "model"
"""The kinds of makers. ``rules`` are programs without a model, such as the reader of texts."""
GOOD, BAD, WARNING, UNKNOWN, PLAIN = "good", "bad", "warning", "unknown", "plain"
"""The marks of a verdict."""
EMPTY, INCOMPLETE, OUTDATED, UNINSPECTED, SETTLED = (
    "empty", "incomplete", "outdated", "uninspected", "settled",
)  # fmt: skip
"""How a stage stands."""
TEXT, FSM, BRANCHES, HFSM, CODE, HARDWARE, TESTING, INSPECTION, APPROVAL = range(1, 10)
"""The numbers of the stages."""


class StageWords(NamedTuple):
    """A stage of the paper: its name, its kind, and the stages of which it is made."""

    name: str
    kind: str
    made_of: tuple[int, ...] = ()


WORDS: dict[int, StageWords] = {
    TEXT: StageWords("Consultation", GENERATIVE),
    FSM: StageWords("FSM design", GENERATIVE, (TEXT,)),
    BRANCHES: StageWords("SB identification", GENERATIVE, (FSM,)),
    HFSM: StageWords("hFSM design", GENERATIVE, (FSM, BRANCHES)),
    CODE: StageWords("Implementation", DETERMINISTIC, (HFSM,)),
    HARDWARE: StageWords("Hardware integration", SITE, (HFSM,)),
    TESTING: StageWords("System testing", SITE, (HFSM, HARDWARE)),
    INSPECTION: StageWords("Inspection", DETERMINISTIC, (HFSM,)),
    APPROVAL: StageWords("Approval", PEOPLE, (HFSM,)),
}


@dataclass(frozen=True)
class StageMaker:
    """Who made a stage: the kind, and the words for people."""

    kind: str
    words: str


@dataclass(frozen=True)
class StageVerdict:
    """What is known about the content of a stage, with its mark."""

    words: str
    mark: str = PLAIN


@dataclass(frozen=True)
class DesignStage:
    """One stage. Without a ``maker`` it was not begun.

    ``digest`` is the SHA-256 of its content, and ``when`` the time at which its file was written
    (s since 1970; for people only, nothing is concluded from it). ``own`` are the earlier stages
    that are not those any more of which it was made, ``changed`` also those that changed below
    them. ``lacks`` says what is missing and why. ``is_generated`` says that a program or a model
    made it, and that no record covers it.
    """

    number: int
    maker: StageMaker | None = None
    digest: str = ""
    when: float | None = None
    verdict: StageVerdict = StageVerdict("")
    own: tuple[int, ...] = ()
    changed: tuple[int, ...] = ()
    lacks: str = ""
    is_generated: bool = False

    @property
    def name(self) -> str:
        """Its name in the paper."""
        return WORDS[self.number].name

    @property
    def kind(self) -> str:
        """Whether it is generative, deterministic, depends on the site, or is with people."""
        return WORDS[self.number].kind

    @property
    def standing(self) -> str:
        """How it stands. What is missing counts before what is out of date."""
        if self.lacks:
            return INCOMPLETE
        if self.maker is None:
            return EMPTY
        if self.changed:
            return OUTDATED
        return UNINSPECTED if self.is_generated else SETTLED

    @property
    def foot(self) -> str:
        """How it stands, in words."""
        standing = self.standing
        if standing == OUTDATED:
            return f"{stages_said(self.changed)} changed"
        return self.lacks if standing == INCOMPLETE else _FEET[standing]


_FEET = {EMPTY: "Not begun", UNINSPECTED: "Generated, not inspected", SETTLED: "Settled"}


@dataclass(frozen=True)
class NextStep:
    """What is to be done next at a stage, and who does it. If it concerns one element, which."""

    number: int
    what: str
    who: str
    address: str = ""

    @property
    def name(self) -> str:
        """The name of the stage."""
        return WORDS[self.number].name


def stages_said(numbers: Sequence[int]) -> str:
    """Return some stages in words: ``Stage 2``, ``Stages 2 and 3``, ``Stages 4, 5 and 6``."""
    told = [str(number) for number in numbers]
    if len(told) == 1:
        return f"Stage {told[0]}"
    return f"Stages {', '.join(told[:-1])} and {told[-1]}"
