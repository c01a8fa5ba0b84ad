"""A moment of a run: its state after some of its events, live or recorded."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.blueprint.check import FactKey
from smsl_studio.runlog import events as run
from smsl_studio.runlog.phase import RunMode

_MOVES = ("ready", "running")
"""A run that has not begun is in none of these phases, but ``idle``."""


def waiting_words(questions: Sequence[str]) -> str:
    """Return the sentence of a run that waits for answers to these questions, empty if there are
    none.
    """
    if not questions:
        return ""
    more = f" (and {len(questions) - 1} more)" if len(questions) > 1 else ""
    return f"Waiting for an answer{more}: {questions[0]}"


@dataclass(frozen=True, slots=True)
class Sensed:
    """The last sensed value of a fact. ``value`` None means unknown, and ``reason`` says why."""

    value: str | None
    reason: str
    since: float


@dataclass(frozen=True, slots=True)
class Entered:
    """When an SB entered its state (simulated s), and by which operation (empty if by none)."""

    since: float
    by: str = ""


class Phased(RunMode):
    """The phase of a run and the words for it, which follow from the other fields."""

    __slots__ = ()
    held: run.Held | None
    finished: run.RunFinished | None
    begun: bool
    started: Collection[str]
    tasks: Mapping[str, run.TaskOpened]

    @property
    def phase(self) -> str:
        """The phase of a run that goes on, one of ``RUN_STATES``. The reason of its end if it has
        ended.
        """
        if self.finished is not None:
            return self.finished.reason
        phase = self.phase_while(bool(self.started), bool(self.tasks))
        return phase if self.begun or phase not in _MOVES else "idle"

    @property
    def reason(self) -> str:
        """The reason of the end, or the kind of a hold. Empty if the run goes on."""
        if self.finished is not None:
            return self.finished.reason
        return self.held.kind if self.held is not None else ""

    @property
    def sentence(self) -> str:
        """Why the run ended or holds, who has stopped it or taken it over, or what people are
        asked.
        """
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
    """The state of a run after its first ``index`` events. Addresses are texts, times simulated
    seconds.

    ``started`` are the operations that have begun and are not committed. ``own`` are those whose
    function has not ended, and ``running`` is the newest of them. ``held`` says why the run cannot
    go on by itself. ``tasks`` are the open questions to people, ``asked`` all questions so far.
    ``disturbed`` has the kinds of disturbance of each sensor. ``stopped`` and ``taken_over`` name
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
