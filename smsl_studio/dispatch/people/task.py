"""A task: a question to people while a run waits. Times are simulated seconds.

A task has no default answer. The end of its time is never a yes, and a late answer is refused. If
several persons must answer, nobody sees an answer before all are given.
"""

from __future__ import annotations

from dataclasses import dataclass

KINDS = ("operation", "confirm", "fact", "supervise", "start", "generate")
"""``operation``: a person carries it out. ``confirm``: people agree before an operation begins.
``fact``: a person tells a fact. ``supervise``: a person decides on the next operation. ``start``: a
person accepts the findings of inspection. ``generate``: a person lets an edge count that the
blueprint does not have.
"""


@dataclass(frozen=True, slots=True)
class Option:
    """One possible answer: its value in the record, and the words on its button.

    ``yes`` says that the run may go on with this answer. No option is chosen in advance.
    """

    value: str
    words: str
    yes: bool


@dataclass(frozen=True, slots=True)
class Answered:
    """The fact that a person has answered, with role and time, but without the answer."""

    by: str
    role: str
    at: float


@dataclass(frozen=True, slots=True)
class Task:
    """One open question.

    ``address`` is the operation (``SB/State/Operation``), the fact (``SB/digit``), or empty.
    ``roles`` has one role for each of the ``persons`` that must agree; an empty role means anybody.
    From the time ``escalates`` on, the role ``escalation`` may answer too.
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
        """The number of different persons who must give the same answer."""
        return len(self.roles)
