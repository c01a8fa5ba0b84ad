"""The fold of a run: its state after each event, changed in place.

An event costs the same however long the run is, and however many facts it has. ``changes`` has
what each event changes; ``moment`` is the frozen value that is shown.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.check import FactKey
from smsl_studio.runlog import events as run
from smsl_studio.runlog.history import RunHistory
from smsl_studio.runlog.moment import Entered, Phased, RunMoment, Sensed


@dataclass(slots=True)
class RunFold(Phased):
    """The fields of ``RunMoment``, which explains them. ``planned`` is the whole route that was
    planned last, ``passed`` how many of its operations have begun; ``started`` and ``own`` are
    sets that keep their order. ``stack`` has those of ``own`` in their order, and some that have
    ended since. ``history`` is written along where there is one."""

    index: int = 0
    time: float = 0.0
    configuration: dict[str, str] = field(default_factory=dict)
    entered: dict[str, Entered] = field(default_factory=dict)
    facts: dict[FactKey, Sensed] = field(default_factory=dict)
    world: str = ""
    goals: tuple[str, ...] = ()
    planned: tuple[str, ...] = ()
    passed: int = 0
    started: dict[str, None] = field(default_factory=dict)
    own: dict[str, None] = field(default_factory=dict)
    stack: list[str] = field(default_factory=list)
    running: str = ""
    running_since: float | None = None
    operations: int = 0
    pruned: dict[str, str] = field(default_factory=dict)
    risky: dict[str, str] = field(default_factory=dict)
    candidates: tuple[Mapping[str, str], ...] = ()
    tasks: dict[str, run.TaskOpened] = field(default_factory=dict)
    asked: dict[str, run.TaskOpened] = field(default_factory=dict)
    disturbed: dict[str, tuple[str, ...]] = field(default_factory=dict)
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
    history: RunHistory | None = None

    @staticmethod
    def of(told: RunMoment) -> RunFold:
        """A fold that goes on from a moment."""
        values: dict[str, Any] = {name: getattr(told, name) for name in _ALIKE}
        copies: dict[str, Any] = {name: dict(getattr(told, name)) for name in _MAPS}
        return RunFold(
            **values,
            **copies,
            planned=told.route,
            started=dict.fromkeys(told.started),
            own=dict.fromkeys(told.own),
            stack=list(told.own),
        )

    def moment(self) -> RunMoment:
        """The state of the run now, as a frozen value."""
        values: dict[str, Any] = {name: getattr(self, name) for name in _ALIKE}
        copies: dict[str, Any] = {name: dict(getattr(self, name)) for name in _MAPS}
        return RunMoment(
            **values,
            **copies,
            route=self.planned[self.passed :],
            started=tuple(self.started),
            own=tuple(self.own),
        )

    @property
    def size(self) -> int:
        """How many values ``moment`` copies, about."""
        left = len(self.planned) - self.passed
        maps = sum(len(getattr(self, name)) for name in _MAPS)
        return left + len(self.started) + len(self.own) + maps


_MAPS = ("configuration", "entered", "facts", "pruned", "risky", "tasks", "asked", "disturbed")
_ALIKE = (
    "index", "time", "world", "goals", "running", "running_since", "operations", "candidates",
    "full_map", "by_hand", "once", "paused", "frozen", "held", "stopped", "taken_over", "finished",
    "begun",
)  # fmt: skip
