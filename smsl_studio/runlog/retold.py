"""The state of a recorded run at one moment, as far as its events tell it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from smsl_studio.runlog import events as run

FactKey = tuple[str, int]


@dataclass(frozen=True, slots=True)
class Sensed:
    """A fact as it was sensed last; ``value`` None is unknown, with the reason."""

    value: str | None
    reason: str
    since: float


@dataclass(frozen=True, slots=True)
class Entered:
    """When an SB came into its state (simulated s), and by which operation (empty: by none)."""

    since: float
    by: str = ""


class Phased:
    """What follows from how a run stands: its run state, and the sentence that belongs to it."""

    __slots__ = ()
    by_hand: bool
    once: bool
    paused: bool
    frozen: bool
    held: run.Held | None
    stopped: str
    taken_over: str
    finished: run.RunFinished | None
    begun: bool
    started: Collection[str]
    tasks: Mapping[str, run.TaskOpened]

    @property
    def phase(self) -> str:
        """The run state, in the words of a run that goes on; why it ended where it has."""
        if self.finished is not None:
            return self.finished.reason
        if not self.begun:
            return "idle"
        if self.stopped or self.taken_over:
            return "stopped" if self.stopped else "taken_over"
        if self.tasks and not self.frozen:
            return "waiting"
        if self.started and not self.frozen:
            return "running"
        if self.held is not None:
            return "no_route" if self.held.kind == "no_route" else "fault_hold"
        if self.paused or self.frozen:
            return "paused"
        return "ready" if self.by_hand and not self.once else "running"

    @property
    def sentence(self) -> str:
        """Why it ended or holds, or who has stopped it or taken it over."""
        if self.finished is not None:
            return self.finished.sentence
        if self.stopped:
            return f"Stopped by {self.stopped}."
        if self.taken_over:
            return f"{self.taken_over} has taken over."
        return self.held.reason if self.held is not None else ""


@dataclass(frozen=True, slots=True)
class Retold(Phased):
    """How a run stood after its first ``index`` events. Addresses are text, times simulated s.

    ``started`` are the operations that have begun and not committed, ``own`` those of them whose
    function has not ended, ``running`` the one whose function runs or settles. ``held`` says why
    it cannot go on by itself, ``tasks`` what people are asked. ``stopped`` and ``taken_over`` name
    who did it.
    """

    index: int = 0
    time: float = 0.0
    configuration: Mapping[str, str] = field(default_factory=dict)
    entered: Mapping[str, Entered] = field(default_factory=dict)
    facts: Mapping[FactKey, Sensed] = field(default_factory=dict)
    goals: tuple[str, ...] = ()
    route: tuple[str, ...] = ()
    started: tuple[str, ...] = ()
    own: tuple[str, ...] = ()
    running: str = ""
    running_since: float | None = None
    check: run.StateChecked | None = None
    operations: int = 0
    pruned: Mapping[str, str] = field(default_factory=dict)
    risky: Mapping[str, str] = field(default_factory=dict)
    candidates: tuple[Mapping[str, str], ...] = ()
    tasks: Mapping[str, run.TaskOpened] = field(default_factory=dict)
    disturbed: Mapping[str, str] = field(default_factory=dict)
    faults: tuple[str, ...] = ()
    full_map: bool = False
    by_hand: bool = False
    once: bool = False
    paused: bool = False
    frozen: bool = False
    held: run.Held | None = None
    stopped: str = ""
    taken_over: str = ""
    finished: run.RunFinished | None = None
    begun: bool = False
