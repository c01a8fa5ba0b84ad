"""Events of regulation: what people, supervisors and scripts do to a run, and what they are asked.

``by`` names who did it: a person, an agent, a script; never empty.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

from smsl_studio.runlog.event import Event


@dataclass(frozen=True, slots=True, kw_only=True)
class Commanded(Event):
    """Somebody commanded something; ``refused`` says why it was not done, empty where it was.

    ``command`` is a word of ``dispatch``: pause, veto, full_map ... ``value`` and ``reason`` are
    what was said with it.
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
    """A person took over: automation is locked out, the dispatcher only observes."""

    event: ClassVar[str] = "taken_over"
    by: str


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenBack(Event):
    """The person gave back; the configuration that was located and accepted."""

    event: ClassVar[str] = "given_back"
    by: str
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunStopped(Event):
    """A controlled stop: braked and latched. In a run that nobody attends it is also the end."""

    event: ClassVar[str] = "stopped"
    by: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RunReset(Event):
    """The stop is unlatched to paused; ``unknown`` are the facts (``SB/digit``) that the stopped
    operation may have touched, unknown until they are sensed anew."""

    event: ClassVar[str] = "reset"
    by: str
    unknown: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskOpened(Event):
    """People are asked something. ``deadline`` is simulated s; ``persons`` how many must agree."""

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
    """Half the time has passed: another role is asked as well."""

    event: ClassVar[str] = "task_escalated"
    task: str
    role: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskAnswered(Event):
    """One person answered; the answer itself stays hidden until all are in (``task_closed``).

    ``refused`` says why it does not count: too late, already answered, no such option.
    """

    event: ClassVar[str] = "task_answered"
    task: str
    by: str
    role: str
    refused: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskClosed(Event):
    """A task is over: ``answered`` (all agree), ``disagreed``, ``timed_out`` or ``withdrawn``.

    ``answers`` maps each person to what they said; ``answer`` is what all said, else empty.
    """

    event: ClassVar[str] = "task_closed"
    task: str
    outcome: str
    answer: str = ""
    answers: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Disturbed(Event):
    """Sensors are disturbed from now on; ``kind`` none ends it (see ``monitor.disturbance``)."""

    event: ClassVar[str] = "disturbed"
    target: str
    kind: str
    parameters: Mapping[str, str]
    sensors: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultInjected(Event):
    """Something goes wrong in the world on purpose, by the name its plugin gave it."""

    event: ClassVar[str] = "fault_injected"
    fault: str
    parameters: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class CostsChanged(Event):
    """Edges have another price now, by a person or by cost functions; only those that changed.

    ``faults`` are cost functions that failed: what is declared of their edges stands."""

    event: ClassVar[str] = "costs_changed"
    costs: Mapping[str, float]
    faults: tuple[str, ...] = ()
