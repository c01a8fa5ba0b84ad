"""Events of regulation: what people, supervisors and scripts do to a run, and what people are
asked.

``by`` names who did it: a person, an agent or a script. It is never empty.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

from smsl_studio.runlog.event import Event

AGREES, DIFFERS, NONE = "agrees", "differs", "none"
RIGHT, WRONG = "right", "wrong"
FORECASTS, COMPARISONS = (AGREES, DIFFERS, NONE), (RIGHT, WRONG)
"""What a forecast says about the declared facts (``none``: there is no forecast), and what the
facts say about it afterwards."""
UNKNOWN = "?"
"""The value of a fact that will be unknown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RiskEstimated(Event):
    """The risk of a proposed operation, from 0 to 1, and the reasons for it. A supervisor that goes
    by it decides next.
    """

    event: ClassVar[str] = "risk_estimated"
    address: str
    risk: float
    reasons: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ForecastTold(Event):
    """A simulated world has carried out a proposed operation, or it is known whether it was right.

    Before the operation ``verdict`` is ``agrees`` or ``differs`` (from what the blueprint
    declares), or ``none`` without a forecast, and ``facts`` has the facts (``SB/digit``) that will
    change; ``?`` is an unknown one. After the operation it is ``right`` or ``wrong``. ``reason``
    says what differs, or why there is no forecast.
    """

    event: ClassVar[str] = "forecast"
    address: str
    verdict: str
    facts: Mapping[str, str] = field(default_factory=dict)
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeGenerated(Event):
    """A person has allowed an edge that the blueprint does not have. It counts from here to the end
    of this run.

    ``provider`` has proposed it, and ``proposal`` is the SHA-256 of its answer. ``function`` is
    what the library binds to it. ``facts`` are the facts (``SB/digit``) that it changes, with their
    new values. ``by`` is the person.
    """

    event: ClassVar[str] = "edge_generated"
    address: str
    target: str
    function: str
    facts: Mapping[str, str]
    by: str
    provider: str
    proposal: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Commanded(Event):
    """Somebody has given a command. ``refused`` says why it was not carried out, and is empty if it
    was.

    ``command`` is a word of the table in ``dispatch``, such as ``pause`` or ``full_map``. ``value``
    and ``reason`` were given with it.
    """

    event: ClassVar[str] = "commanded"
    command: str
    by: str
    address: str = ""
    value: str = ""
    reason: str = ""
    refused: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TakenOver(Event):
    """A person has taken over. Automation is locked out, and the dispatcher only observes."""

    event: ClassVar[str] = "taken_over"
    by: str


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenBack(Event):
    """The person has given the run back, in a configuration that was found in the scene and
    accepted.
    """

    event: ClassVar[str] = "given_back"
    by: str
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunStopped(Event):
    """A controlled stop: the world is braked and the stop is latched. A run without attendance ends
    too.
    """

    event: ClassVar[str] = "stopped"
    by: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RunReset(Event):
    """The stop is released, and the run is paused.

    ``unknown`` are the facts (``SB/digit``) that the stopped operation may have changed. They are
    unknown until they are sensed again.
    """

    event: ClassVar[str] = "reset"
    by: str
    unknown: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskOpened(Event):
    """People are asked a question. ``deadline`` is simulated seconds, ``persons`` how many must
    agree.
    """

    event: ClassVar[str] = "task_opened"
    task: str
    kind: str
    address: str
    question: str
    options: tuple[str, ...]
    role: str
    persons: int
    deadline: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskEscalated(Event):
    """Half of the time has passed, so another role is asked too."""

    event: ClassVar[str] = "task_escalated"
    task: str
    role: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskAnswered(Event):
    """One person has answered. The answer is hidden until all answers are given (``task_closed``).

    ``refused`` says why the answer does not count, such as: too late, already answered, no such
    option.
    """

    event: ClassVar[str] = "task_answered"
    task: str
    by: str
    role: str
    refused: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskClosed(Event):
    """A task is over. ``outcome`` is ``answered`` (all agree), ``disagreed``, ``timed_out`` or
    ``withdrawn``.

    ``answers`` has the answer of each person. ``answer`` is the common answer, empty if they do not
    agree.
    """

    event: ClassVar[str] = "task_closed"
    task: str
    outcome: str
    answer: str = ""
    answers: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Disturbed(Event):
    """Sensors are disturbed from now on. The kind ``none`` ends it (see
    ``monitor.disturbance``).
    """

    event: ClassVar[str] = "disturbed"
    target: str
    kind: str
    parameters: Mapping[str, str]
    sensors: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultInjected(Event):
    """A fault was caused in the world on purpose. ``fault`` is the name that its plugin
    registered.
    """

    event: ClassVar[str] = "fault_injected"
    fault: str
    parameters: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class CostsChanged(Event):
    """Edges have new costs, set by a person or by cost functions. ``costs`` has only the changed
    ones.

    ``faults`` are the cost functions that failed. The declared costs of their edges remain.
    ``closed`` are the edges that a guard of the plugin closes from now on, with the reason, and
    those that it opens again, with an empty one. It is left out where there are none.
    """

    event: ClassVar[str] = "costs_changed"
    sparse: ClassVar[tuple[str, ...]] = ("closed",)
    costs: Mapping[str, float]
    faults: tuple[str, ...] = ()
    closed: Mapping[str, str] = field(default_factory=dict)
