"""The events of a run, in simulated time.

An event has no wall time, host, path or process number, so equal runs print equal bytes. These
values stand in the log's header. ``t`` is simulated seconds. Addresses are texts. This file has the
events of motion and sensing, ``regulation`` those of people and supervisors. All are imported from
here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from smsl_studio.runlog.event import Event
from smsl_studio.runlog.regulation import (
    Commanded,
    CostsChanged,
    Disturbed,
    EdgeGenerated,
    FaultInjected,
    ForecastTold,
    GivenBack,
    RiskEstimated,
    RunReset,
    RunStopped,
    TakenOver,
    TaskAnswered,
    TaskClosed,
    TaskEscalated,
    TaskOpened,
)

__all__ = [
    "Commanded",
    "Committed",
    "CostsChanged",
    "Disturbed",
    "EdgeGenerated",
    "EdgeSwept",
    "Event",
    "FactChanged",
    "FaultInjected",
    "ForecastTold",
    "GivenBack",
    "GoalReached",
    "HazardMet",
    "Held",
    "LeftOut",
    "Measured",
    "Mismatch",
    "OperationEnded",
    "OperationPruned",
    "OperationRefused",
    "OperationRestored",
    "OperationRisky",
    "OperationStarted",
    "Paused",
    "Relocalised",
    "Resumed",
    "RiskEstimated",
    "RoutePlanned",
    "RunFinished",
    "RunReset",
    "RunStarted",
    "RunStopped",
    "StateChecked",
    "SubsBypassed",
    "SweepFinished",
    "TakenOver",
    "TaskAnswered",
    "TaskClosed",
    "TaskEscalated",
    "TaskOpened",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunStarted(Event):
    """The run begins. All start states have passed their state checks, which are told next."""

    event: ClassVar[str] = "run_started"
    sparse: ClassVar[tuple[str, ...]] = ("met", "robot")
    world: str
    seed: int
    start: Mapping[str, str]
    goals: tuple[str, ...]
    behaviour: str = ""
    """SHA-256 of the blueprint's behaviour. It identifies the blueprint."""
    met: tuple[str, ...] = ()
    """The typed conditions of the approval that were checked and are met."""
    sensed: tuple[str, ...] = ()
    """The facts (``SB/digit``) that a sensor or a person reports. All others are assumed. Logs of
    earlier versions do not have this list."""
    robot: str = ""
    """The robot of the world, if it is not the usual one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LeftOut(Event):
    """A hazard or a property of the file cannot be read, so the run begins without it."""

    event: ClassVar[str] = "left_out"
    address: str
    sentence: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RoutePlanned(Event):
    """A cheapest route to the goal was planned. ``operations`` are the addresses in order."""

    event: ClassVar[str] = "route_planned"
    goal: str
    operations: tuple[str, ...]
    cost: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SubsBypassed(Event):
    """An edge with ``subs: load`` is used. Its function sets the facts of these sub-SBs directly,
    and none of their operations is carried out.
    """

    event: ClassVar[str] = "subs_bypassed"
    address: str
    subs: tuple[str, ...]
    sentence: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationStarted(Event):
    """An edge is being carried out. ``function`` is empty if it has none."""

    event: ClassVar[str] = "operation_started"
    address: str
    target: str
    function: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationEnded(Event):
    """The function of an edge, or a person, has finished it. ``outcome`` is ``returned``,
    ``failed``, ``raised``, ``timed_out``, ``cancelled`` or ``lost``.
    """

    event: ClassVar[str] = "operation_ended"
    address: str
    outcome: str
    message: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateChecked(Event):
    """A state check on sensed facts. ``result`` is ``true``, ``false`` or ``unknown``.

    ``misses`` are the facts with another value, ``unknown`` those without a value.
    """

    event: ClassVar[str] = "state_checked"
    address: str
    result: str
    misses: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Committed(Event):
    """Edges were committed together. ``configuration`` has the new state of every SB that has
    moved.
    """

    event: ClassVar[str] = "committed"
    operations: tuple[str, ...]
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationRefused(Event):
    """A guard has refused an operation. Nothing has moved.

    ``code`` is ``hazard`` if a hazard refuses it, and then ``hazard`` is its name. Both are left
    out of all other refusals.
    """

    event: ClassVar[str] = "operation_refused"
    sparse: ClassVar[tuple[str, ...]] = ("code", "hazard")
    address: str
    reasons: tuple[str, ...]
    code: str = ""
    hazard: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationRisky(Event):
    """A failed operation is tagged risky. Routes avoid it until it is restored."""

    event: ClassVar[str] = "operation_risky"
    address: str
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationPruned(Event):
    """An edge was excluded on request, with a reason, until it is restored."""

    event: ClassVar[str] = "operation_pruned"
    address: str
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationRestored(Event):
    """A pruned, avoided or risky edge may be used again."""

    event: ClassVar[str] = "operation_restored"
    address: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FactChanged(Event):
    """A sensed fact has another value. None means unknown, with the reason."""

    event: ClassVar[str] = "fact_changed"
    branch: str
    digit: int
    value: str | None
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured(Event):
    """A source of a fact that predicates decide has measured something.

    ``value`` is the number in the unit of the source, or three for a position, as text that gives
    the same doubles again. None means no valid measure; ``quality`` and ``reason`` say why.
    ``taken`` is the time (s) on the clock of the source. A source is told when its fact changes,
    and else as often as the fact's ``log_rate`` says.
    """

    event: ClassVar[str] = "measured"
    sparse: ClassVar[tuple[str, ...]] = ("reason",)
    branch: str
    digit: int
    source: str
    value: str | None
    quality: str
    taken: float
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mismatch(Event):
    """Sensed facts and believed states differ, or an operation did not reach its target.

    ``facts`` says which facts differ, ``candidates`` are the configurations that fit the sensed
    facts.
    """

    event: ClassVar[str] = "mismatch"
    facts: tuple[str, ...]
    candidates: tuple[Mapping[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Relocalised(Event):
    """The scene was read again, and the run continues from this configuration."""

    event: ClassVar[str] = "relocalised"
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class HazardMet(Event):
    """The sensed facts of a hazard hold together: ``facts`` has each with its value."""

    event: ClassVar[str] = "hazard_met"
    name: str
    facts: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Held(Event):
    """The run holds until somebody decides. ``reason`` says why.

    ``kind`` is ``no_route`` if no permitted route leads to the goal. It is ``guard_lost`` if a
    critical fact, or one that a running operation requires, is false or unknown. It is
    ``goal_unconfirmed`` if the state check of a goal is not true, ``hazard`` if a hazard is met or
    refuses the next operation, and ``held`` otherwise.
    """

    event: ClassVar[str] = "held"
    reason: str
    details: tuple[str, ...] = ()
    kind: str = "held"


@dataclass(frozen=True, slots=True, kw_only=True)
class Paused(Event):
    """The run is paused. No operation goes on until it is resumed."""

    event: ClassVar[str] = "paused"


@dataclass(frozen=True, slots=True, kw_only=True)
class Resumed(Event):
    """The paused run goes on."""

    event: ClassVar[str] = "resumed"


@dataclass(frozen=True, slots=True, kw_only=True)
class GoalReached(Event):
    """One goal was reached."""

    event: ClassVar[str] = "goal_reached"
    goal: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFinished(Event):
    """The last event of a run.

    ``reason`` is ``goal_reached``, ``no_route``, ``held``, ``refused``, ``stopped`` or ``failed``.
    If the run needed an approval and has none, ``refusals`` says why: each has a code and a
    sentence.
    """

    event: ClassVar[str] = "run_finished"
    sparse: ClassVar[tuple[str, ...]] = ("refusals",)
    reason: str
    sentence: str
    operations: int
    configuration: Mapping[str, str]
    refusals: tuple[Mapping[str, str], ...] = ()


PROCEDURE = "procedure "
"""The function of an operation that runs another blueprint begins with this word."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Within(Event):
    """An event of the blueprint that an operation runs, one level down. ``told`` is its line."""

    event: ClassVar[str] = "within"
    operation: str
    told: str


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeSwept(Event):
    """One edge of a sweep was carried out. ``source`` and ``target`` are the results of their state
    checks (``true``, ``false`` or ``unknown``). ``hazard`` is the name of the first hazard that it
    meets on its way or at its end, and left out if there is none.
    """

    event: ClassVar[str] = "edge_swept"
    sparse: ClassVar[tuple[str, ...]] = ("hazard",)
    address: str
    passed: bool
    source: str
    target: str
    sentence: str = ""
    hazard: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepFinished(Event):
    """The last event of a sweep: the number of edges, how many passed, and which failed."""

    event: ClassVar[str] = "sweep_finished"
    edges: int
    passed: int
    failed: tuple[str, ...] = ()
