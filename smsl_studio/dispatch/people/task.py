"""A task: what people are asked while a run waits. Times are simulated seconds.

A task has no default answer. Time that runs out is never a yes; an answer that comes late is
refused. Where several persons must answer, nobody sees an answer before all are in.
"""

from __future__ import annotations

from dataclasses import dataclass

KINDS = ("operation", "confirm", "fact", "supervise", "start")
"""``operation``: a person carries it out. ``confirm``: people agree before an operation begins.
``fact``: a person says what a fact is. ``supervise``: a person decides on the next operation.
``start``: a person accepts what inspection found."""


@dataclass(frozen=True, slots=True)
class Option:
    """One answer that may be given: its value in the record, and what the button says.

    ``yes`` says that the run may go on with it; no option is chosen beforehand.
    """

    value: str
    words: str
    yes: bool


@dataclass(frozen=True, slots=True)
class Answered:
    """That somebody has answered, not what."""

    by: str
    role: str
    at: float


@dataclass(frozen=True, slots=True)
class Task:
    """One open question.

    ``address`` is the operation (``SB/State/Operation``), the fact (``SB/digit``) or empty.
    ``roles`` says whose task it is, one role for each of the ``persons`` that must agree (an empty
    role is anybody's). From ``escalates`` on ``escalation`` may answer as well.
    """

    name: str
    kind: str
    address: str
    question: str
    detail: str
    options: tuple[Option, ...]
    roles: tuple[str, ...]
    opened: float
    escalates: float
    deadline: float
    escalation: str = ""
    escalated: bool = False
    answered: tuple[Answered, ...] = ()

    @property
    def persons(self) -> int:
        """How many different persons must answer the same."""
        return len(self.roles)
