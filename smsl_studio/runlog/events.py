"""Run events: the one story of a run, in simulated time.

An event carries no wall time, host, path or process number (those stand in the log's header), so
that equal runs print equal bytes. ``t`` is simulated seconds. Addresses are written as text. Events
of motion and sensing stand here, those of people and supervisors in ``regulation``; both are
imported from this module.
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
    FaultInjected,
    GivenBack,
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
    "EdgeSwept",
    "Event",
    "FactChanged",
    "FaultInjected",
    "GivenBack",
    "GoalReached",
    "Held",
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
    """The run begins: every SB's start state was confirmed by its state check."""

    event: ClassVar[str] = "run_started"
    world: str
    seed: int
    start: Mapping[str, str]
    goals: tuple[str, ...]
    behaviour: str = ""
    """SHA-256 of the blueprint's behaviour: which drawing this run holds."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RoutePlanned(Event):
    """The cheapest way to the goal from here: addresses in the order they will be carried out."""

    event: ClassVar[str] = "route_planned"
    goal: str
    operations: tuple[str, ...]
    cost: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SubsBypassed(Event):
    """The run goes by an edge with ``subs: load``, or a person asked for one: its function sets the
    facts of these SBs by itself, and none of their operations is carried out."""

    event: ClassVar[str] = "subs_bypassed"
    address: str
    subs: tuple[str, ...]
    sentence: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationStarted(Event):
    """An edge is being carried out; ``function`` is empty where it runs none."""

    event: ClassVar[str] = "operation_started"
    address: str
    target: str
    function: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationEnded(Event):
    """The library function of an edge ended: returned, failed, raised, timed_out or cancelled."""

    event: ClassVar[str] = "operation_ended"
    address: str
    outcome: str
    message: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateChecked(Event):
    """A state check on sensed facts: true, false or unknown, with the facts that are not true."""

    event: ClassVar[str] = "state_checked"
    address: str
    result: str
    misses: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Committed(Event):
    """Edges that became true together, and every SB whose active state changed with them."""

    event: ClassVar[str] = "committed"
    operations: tuple[str, ...]
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationRefused(Event):
    """A guard said no; nothing moved."""

    event: ClassVar[str] = "operation_refused"
    address: str
    reasons: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationRisky(Event):
    """A failed operation is tagged risky; routing bypasses it until it is restored."""

    event: ClassVar[str] = "operation_risky"
    address: str
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OperationPruned(Event):
    """A person shut an edge out, with a reason, until it is restored."""

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
    """A sensed fact took another value; None is unknown, with the reason."""

    event: ClassVar[str] = "fact_changed"
    branch: str
    digit: int
    value: str | None
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mismatch(Event):
    """Integrity is broken: sensed facts and flags differ, or an outcome is not the target."""

    event: ClassVar[str] = "mismatch"
    facts: tuple[str, ...]
    candidates: tuple[Mapping[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Relocalised(Event):
    """The scene was read again and a configuration adopted."""

    event: ClassVar[str] = "relocalised"
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Held(Event):
    """The run holds and says why; nobody moves until someone decides.

    ``kind`` is ``no_route`` where nothing permitted leads to the goal, ``guard_lost`` where a
    critical fact or one that a running operation requires is false or unknown,
    ``goal_unconfirmed`` where the state check of a goal is not true, else ``held``.
    """

    event: ClassVar[str] = "held"
    reason: str
    details: tuple[str, ...] = ()
    kind: str = "held"


@dataclass(frozen=True, slots=True, kw_only=True)
class Paused(Event):
    """The run is paused: no operation goes on until it is resumed."""

    event: ClassVar[str] = "paused"


@dataclass(frozen=True, slots=True, kw_only=True)
class Resumed(Event):
    """The paused run goes on."""

    event: ClassVar[str] = "resumed"


@dataclass(frozen=True, slots=True, kw_only=True)
class GoalReached(Event):
    """One goal is reached."""

    event: ClassVar[str] = "goal_reached"
    goal: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFinished(Event):
    """The last event. ``reason``: goal_reached, no_route, held, refused, stopped or failed."""

    event: ClassVar[str] = "run_finished"
    reason: str
    sentence: str
    operations: int
    configuration: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeSwept(Event):
    """One edge of a sweep: started in its source state, run, source and target checked."""

    event: ClassVar[str] = "edge_swept"
    address: str
    passed: bool
    source: str
    target: str
    sentence: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepFinished(Event):
    """The last event of a sweep: how many edges were run, how many passed, which failed."""

    event: ClassVar[str] = "sweep_finished"
    edges: int
    passed: int
    failed: tuple[str, ...] = ()
