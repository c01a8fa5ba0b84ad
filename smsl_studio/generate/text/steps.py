"""What the PM answers: the steps of a procedure as data.

The models are the schema of the answers. Whoever answers, each text has a bound, each list has a
bound, and a key that is not known does not fit.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from smsl_studio.generate.text.expert_text import LONGEST_QUOTE, Citation

MOST_STEPS = 400
"""The largest number of steps of a procedure, with all their parts."""
MOST_IN_A_LIST = 120
"""The largest number of steps that follow each other. Each is a fact of one State Branch."""
DEEPEST = 5
"""So many levels of steps may stand below each other."""
Words = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=300)]
Short = Annotated[str, StringConstraints(strip_whitespace=True, max_length=300)]
Seconds = Annotated[float, Field(gt=0, le=1e6)]


class _PartOfAnswer(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Source(_PartOfAnswer):
    """Where the words stand: a file of the texts, the line from 1, in a PDF on its page."""

    file: Words
    line: Annotated[int, Field(ge=1, le=10**6)]
    words: Annotated[str, StringConstraints(min_length=1, max_length=LONGEST_QUOTE)]
    page: Annotated[int, Field(ge=0, le=10**5)] = 0

    @property
    def citation(self) -> Citation:
        """The same as a value of the texts."""
        return Citation(self.file, self.line, self.words, self.page)

    @classmethod
    def of(cls, one: Citation) -> Source:
        """Return a citation as a part of an answer."""
        return cls(file=one.file, line=one.line, words=one.words, page=one.page)


Risk = Literal["", "low", "medium", "high"]
_RISKS: dict[str, Risk] = {"low": "low", "medium": "medium", "high": "high"}


_MARK = re.compile(r"\d{1,3}(\.\d{1,3})*")


def mark_of(text: str) -> str:
    """Return the number of a step, empty if a text is none."""
    return text if _MARK.fullmatch(text) else ""


def risk_of(text: str) -> Risk:
    """Return a risk by its word, empty for another word."""
    return _RISKS.get(text.strip().lower(), "")


class Remedy(_PartOfAnswer):
    """What goes wrong, and what is done then. ``back`` says where the procedure goes on: behind the
    step (``on``), before it (``again``), at its beginning (``start``), or before the step with a
    mark such as ``2.1``."""

    when: Words
    do: Words
    back: Annotated[str, StringConstraints(pattern=r"^(on|again|start|\d{1,3}(\.\d{1,3})*)$")] = (
        "again"
    )
    who: Short = ""
    sources: Annotated[tuple[Source, ...], Field(max_length=10)] = ()


class TextStep(_PartOfAnswer):
    """One step. ``until`` is what must be seen before it is done. ``wait`` says that nothing is
    done but waiting. Times are in seconds."""

    do: Words
    mark: Annotated[str, StringConstraints(pattern=r"^(\d{1,3}(\.\d{1,3})*)?$")] = ""
    who: Short = ""
    """The role of the person, ``robot``, or empty where the text names nobody."""
    confirm: Annotated[tuple[Words, ...], Field(max_length=10)] = ()
    until: Short = ""
    wait: bool = False
    takes: Seconds | None = None
    within: Seconds | None = None
    risk: Risk = ""
    remedies: Annotated[tuple[Remedy, ...], Field(max_length=12)] = ()
    sources: Annotated[tuple[Source, ...], Field(max_length=10)] = ()
    steps: Annotated[tuple[TextStep, ...], Field(max_length=MOST_IN_A_LIST)] = ()


class Caution(_PartOfAnswer):
    """Something that the text forbids or explains. It is no step."""

    words: Words
    sources: Annotated[tuple[Source, ...], Field(max_length=10)] = ()


class TextProcedure(_PartOfAnswer):
    """The answer of the PM: the steps in their order, and what else the text says."""

    title: Words
    language: Literal["en", "de"] = "en"
    steps: Annotated[tuple[TextStep, ...], Field(min_length=1, max_length=MOST_IN_A_LIST)]
    cautions: Annotated[tuple[Caution, ...], Field(max_length=200)] = ()


def every_step(steps: tuple[TextStep, ...]) -> Iterator[TextStep]:
    """Yield all steps in the order of the text, each before its parts."""
    for step in steps:
        yield step
        yield from every_step(step.steps)


def depth_of(steps: tuple[TextStep, ...]) -> int:
    """Return how many levels of steps stand below each other."""
    return 1 + max((depth_of(step.steps) for step in steps), default=0) if steps else 0


def faults_of(procedure: TextProcedure) -> list[str]:
    """Return what the schema cannot say: too many steps, too deep."""
    found = []
    many = sum(1 for _ in every_step(procedure.steps))
    if many > MOST_STEPS:
        found.append(f"there are {many:,} steps, and at most {MOST_STEPS} are read")
    if depth_of(procedure.steps) > DEEPEST:
        found.append(f"steps stand more than {DEEPEST} levels below each other")
    return found
