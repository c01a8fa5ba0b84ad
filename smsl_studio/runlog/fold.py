"""The fold of a run: the state of the run after each event, changed in place.

The cost of an event does not grow with the length of the run or its number of facts. ``changes``
says what each event changes. ``moment`` makes the frozen value that is shown.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from smsl_studio.blueprint.check import FactKey
from smsl_studio.runlog import events as run
from smsl_studio.runlog.history import RunHistory
from smsl_studio.runlog.moment import Entered, Phased, RunMoment, Sensed


@dataclass(slots=True)
class RunFold(Phased):
    """The state of a run, changed in place. ``RunMoment`` explains most fields.

    ``planned`` is the whole route that was planned last, and ``passed`` the number of its
    operations that have begun. ``started`` and ``own`` are dictionaries that serve as ordered sets.
    ``stack`` has the operations of ``own`` in order, and some that have ended since. ``history`` is
    None, or is written as well.
    """

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
        """Return a fold that goes on from a moment."""
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
        """Return the state of the run now, as a frozen value."""
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
        """The approximate number of values that ``moment`` copies."""
        left = len(self.planned) - self.passed
        maps = sum(len(getattr(self, name)) for name in _MAPS)
        return left + len(self.started) + len(self.own) + maps


_CONVERTED = ("route", "started", "own")
_MAPS = tuple(one.name for one in fields(RunMoment) if one.default_factory is dict)
_ALIKE = tuple(one.name for one in fields(RunMoment) if one.name not in (*_MAPS, *_CONVERTED))
"""The fields that a moment and a fold hold alike. A new field must stand in both classes, because a
frozen dataclass and one that changes cannot inherit from each other.
"""
