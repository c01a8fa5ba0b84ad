"""A moment of a run: how it stood after so many of its events, live or told again."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.blueprint.check import FactKey
from smsl_studio.runlog import events as run
from smsl_studio.runlog.phase import RunMode

_MOVES = ("ready", "running")
"""Before it has begun a run is in none of these."""


def waiting_words(questions: Sequence[str]) -> str:
    """What a run waits for, of which people are asked these; empty where they are asked nothing."""
    if not questions:
        return ""
    more = f" (and {len(questions) - 1} more)" if len(questions) > 1 else ""
    return f"Waiting for an answer{more}: {questions[0]}"


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


class Phased(RunMode):
    """What follows from how a run stands: its phase, why it stands so, and what is said of it."""

    __slots__ = ()
    held: run.Held | None
    finished: run.RunFinished | None
    begun: bool
    started: Collection[str]
    tasks: Mapping[str, run.TaskOpened]

    @property
    def phase(self) -> str:
        """The run state, in the words of a run that goes on; why it ended where it has."""
        if self.finished is not None:
            return self.finished.reason
        phase = self.phase_while(bool(self.started), bool(self.tasks))
        return phase if self.begun or phase not in _MOVES else "idle"

    @property
    def reason(self) -> str:
        """Why it ended, or of what kind a hold is; empty where it goes on."""
        if self.finished is not None:
            return self.finished.reason
        return self.held.kind if self.held is not None else ""

    @property
    def sentence(self) -> str:
        """Why it ended or holds, who has stopped it or taken it over, or what people are asked."""
        if self.finished is not None:
            return self.finished.sentence
        if self.stopped:
            return f"Stopped by {self.stopped}."
        if self.taken_over:
            return f"{self.taken_over} has taken over."
        why = self.held.reason if self.held is not None else ""
        asked = waiting_words([task.question for task in self.tasks.values()])
        return asked or why if self.phase == "waiting" else why or asked


@dataclass(frozen=True, slots=True)
class RunMoment(Phased):
    """How a run stood after its first ``index`` events. Addresses are text, times simulated s.

    ``started`` are the operations that have begun and not committed, ``own`` those of them whose
    function has not ended, ``running`` the one whose function runs or settles. ``held`` says why
    it cannot go on by itself, ``tasks`` what people are asked, ``asked`` all that they ever were.
    ``disturbed`` has the kinds of disturbances of each sensor. ``stopped`` and ``taken_over`` name
    who did it.
    """

    index: int = 0
    time: float = 0.0
    configuration: Mapping[str, str] = field(default_factory=dict)
    entered: Mapping[str, Entered] = field(default_factory=dict)
    facts: Mapping[FactKey, Sensed] = field(default_factory=dict)
    world: str = ""
    goals: tuple[str, ...] = ()
    route: tuple[str, ...] = ()
    started: tuple[str, ...] = ()
    own: tuple[str, ...] = ()
    running: str = ""
    running_since: float | None = None
    operations: int = 0
    pruned: Mapping[str, str] = field(default_factory=dict)
    risky: Mapping[str, str] = field(default_factory=dict)
    candidates: tuple[Mapping[str, str], ...] = ()
    tasks: Mapping[str, run.TaskOpened] = field(default_factory=dict)
    asked: Mapping[str, run.TaskOpened] = field(default_factory=dict)
    disturbed: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
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
