"""Procedures in a run: an operation that runs another blueprint to its goal, one level down.

``NestedHost`` wraps the host of a run. For the run it is an operation like any other. Within it a
dispatcher of its own runs the procedure on the same world: it plans, checks states, watches the
hazards of the procedure, and tells its events, each in a ``Within``. The goal decides.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import BoundProcedure, Procedures, is_exact
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.terms import RunTerms
from smsl_studio.errors import RunRefused
from smsl_studio.host.protocol import (
    RETURNED,
    RUNNING,
    Bound,
    Extending,
    Happened,
    Host,
    OpenedWorld,
    Outcome,
    Priced,
    Tick,
)
from smsl_studio.monitor.sample import Sample
from smsl_studio.runlog.events import PROCEDURE, Event, Mismatch, RunFinished, Within
from smsl_studio.world.engines import TABLE

LONGEST = 3600.0
"""The time limit (simulated s) of a procedure, if none is written."""
PATIENCE = 10_000
"""So many steps of a procedure may take no time in one tick. More are a fault of Studio."""


class NestedHost:
    """A host that carries out procedures as operations. All other calls go to the host inside.

    ``attended`` says whether somebody decides when a procedure holds. ``seed`` is that of the run.
    """

    def __init__(
        self, inner: Host, blueprint: Blueprint, procedures: Procedures, attended: bool, seed: int
    ) -> None:
        self.inner = inner
        self._blueprint, self._procedures = blueprint, procedures
        self._attended, self._seed = attended, seed
        self._tell: Callable[[Event], None] = _nothing
        self._level: ProcedureRun | None = None
        self._opened: OpenedWorld | None = None
        self._own = frozenset(blueprint.branches)

    # what the run above is told -----------------------------------------------------------------

    def hear(self, tell: Callable[[Event], None]) -> None:
        """Tell the events of procedures to ``tell`` from now on."""
        self._tell = tell

    @property
    def holding(self) -> str:
        """Why the procedure that runs holds and waits for a person. Empty if none does."""
        return self._level.holding if self._level is not None else ""

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Build the world. In the table world the facts of procedures begin at their INITIAL."""
        self._level = None
        below: dict[str, str] = {}
        for part in self._procedures.parts:
            below |= start_configuration(Hierarchy(part), {})
        opened = self.inner.open({**start, **below})
        self._opened = opened
        bound = {edge: one for edge, one in opened.bound.items() if edge.branch in self._own}
        for edge, procedure in self._procedures.bound.items():
            bound[edge] = self._bound(edge, procedure)
        return replace(_slice(opened, self._blueprint), bound=bound)

    def _bound(self, edge: Address, procedure: BoundProcedure) -> Bound:
        branch = self._blueprint[edge.branch]
        note = branch.operation_note(edge.state, edge.operation)
        return Bound(
            f"{PROCEDURE}{procedure.name}",
            is_exact(branch, edge),
            note.stop or "hold",
            note.timeout or LONGEST,
            note.resumes is not False,
        )

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor of the run's own facts once."""
        return _of(self._own, self.inner.sense())

    def begin(self, edge: Address) -> None:
        """Start an operation. A procedure starts where the sensed facts show that it stands."""
        procedure = self._procedures.bound.get(edge)
        if procedure is None:
            self.inner.begin(edge)
            return
        assert self._opened is not None
        self._level = ProcedureRun(self, edge, procedure, self._opened)
        self._level.open(self._attended, self._seed)

    def tick(self) -> Tick:
        """Advance the world by one tick, and the procedure with it."""
        level = self._level
        if level is None:
            tick = self.inner.tick()
            return tick._replace(samples=_of(self._own, tick.samples))
        tick, ended = level.tick()
        samples = _of(self._own, tick.samples)
        if ended is None:
            return Tick(tick.time, RUNNING, samples)
        self._level = None
        if ended.reason != "goal_reached":
            return Tick(tick.time, Outcome.FAILED, samples, ended.sentence)
        assert self._opened is not None
        if self._opened.world == TABLE:  # its function writes down what the procedure has done
            self.inner.begin(level.edge)
            return Tick(tick.time, RUNNING, samples)
        return Tick(tick.time, RETURNED, samples, ended.sentence)

    def cancel(self, mode: str) -> None:
        """End what runs. A procedure ends where it is."""
        level, self._level = self._level, None
        if level is not None:
            level.break_off()
        self.inner.cancel(mode)

    def told(self, edge: Address, events: Sequence[Event]) -> None:
        """Tell events of a procedure to the run above."""
        for event in events:
            self._tell(Within(t=event.t, operation=str(edge), told=event.line()))

    # what goes to the host inside ---------------------------------------------------------------

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb a sensor, or all sensors of one fact."""
        return self.inner.disturb(target, kind, **parameters)

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Cause a fault of the world."""
        self.inner.inject(fault, **parameters)

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions and the guards about the run's own edges."""
        priced = self.inner.costs(scene, happened)
        costs = {edge: one for edge, one in priced.costs.items() if edge.branch in self._own}
        closed = {edge: one for edge, one in priced.closed.items() if edge.branch in self._own}
        return replace(priced, costs=costs, closed=closed)

    def suppose(self, edge: Address) -> None:
        """Make the guard of an edge agree."""
        self.inner.suppose(edge)

    def extend(self, edge: Address, target: str) -> tuple[Bound | None, bool]:
        """Let the host inside bind one more edge, if it can."""
        inner = self.inner
        return inner.extend(edge, target) if isinstance(inner, Extending) else (None, False)

    def poses(self) -> tuple[float, ...]:
        """Return the newest poses of the world."""
        return self.inner.poses()

    def status(self) -> Mapping[str, str]:
        """Return the world's short status texts for people."""
        return self.inner.status()

    def check(self) -> None:
        """Raise HostError if the host inside is gone."""
        self.inner.check()

    def close(self) -> None:
        """End everything. A second call does nothing."""
        self._level = None
        self.inner.close()


class ProcedureRun:
    """One procedure that is carried out: its dispatcher, on the world of the run above."""

    def __init__(
        self, host: NestedHost, edge: Address, procedure: BoundProcedure, opened: OpenedWorld
    ) -> None:
        self.edge = edge
        self._host, self._procedure = host, procedure
        self._view = _PartHost(host.inner, procedure.blueprint, opened)
        self._run: Dispatcher | None = None
        self._end: RunFinished | None = None
        self._fitting = 0
        """The number of configurations that fitted the scene at the last mismatch."""

    @property
    def holding(self) -> str:
        """Why the procedure holds. Empty if it does not."""
        run = self._run
        if run is None or run.phase != "fault_hold" or self._end is not None:
            return ""
        return run.standing.sentence or "the procedure holds"

    def open(self, attended: bool, seed: int) -> None:
        """Begin where the sensed facts show that the procedure stands."""
        part, goal = self._procedure.blueprint, self._procedure.goal
        start = located(part, self._view.sense())
        terms = RunTerms(start=start or {}, goals=(goal,), seed=seed, attended=attended)
        self._run = Dispatcher(part, self._view, terms, someone=lambda: False)
        self._hear(self._run.open())

    def tick(self) -> tuple[Tick, RunFinished | None]:
        """Advance the world by one tick. Return it, and the end of the procedure if it has come."""
        run = self._run
        assert run is not None
        if self.holding:  # the run above goes on, so a person has seen the hold and resumed it
            if self._fitting == 1:
                run.adopt()
            run.resume()
        self._view.last = None
        for _ in range(PATIENCE):
            if self._view.last is not None or run.finished:
                break
            self._hear(run.tick())
            if self.holding and self._view.last is None:
                break
        tick = self._view.last or self._view.tick()
        return tick, self._end

    def break_off(self) -> None:
        """End the procedure where it is."""
        if self._run is not None and self._end is None:
            self._hear(self._run.break_off())

    def _hear(self, events: tuple[Event, ...]) -> None:
        self._host.told(self.edge, events)
        for event in events:
            if isinstance(event, Mismatch):
                self._fitting = len(event.candidates)
            elif isinstance(event, RunFinished):
                self._end = event


class _PartHost:
    """The world of the run above, as a procedure sees it: its own edges, facts and sensors."""

    def __init__(self, inner: Host, part: Blueprint, opened: OpenedWorld) -> None:
        self._inner, self._part, self._opened = inner, part, opened
        self._own = frozenset(part.branches)
        self.last: Tick | None = None
        """The last tick of the world, until the run above has taken it."""

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Return what the world has for the procedure. Nothing is built or moved."""
        return replace(_slice(self._opened, self._part), remote=None, priced=False, guarded=False)

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor of the procedure's facts once."""
        return _of(self._own, self._inner.sense())

    def begin(self, edge: Address) -> None:
        """Start an operation of the procedure."""
        self._inner.begin(edge)

    def tick(self) -> Tick:
        """Advance the world by one tick."""
        self.last = tick = self._inner.tick()
        return tick._replace(samples=_of(self._own, tick.samples))

    def cancel(self, mode: str) -> None:
        """End the operation of the procedure."""
        self._inner.cancel(mode)

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb a sensor. Only the run above is asked to do this."""
        return self._inner.disturb(target, kind, **parameters)

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Cause a fault of the world. Only the run above is asked to do this."""
        self._inner.inject(fault, **parameters)

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Return nothing: the world prices the edges of the run above alone."""
        return Priced()

    def suppose(self, edge: Address) -> None:
        """Do nothing: a procedure supposes nothing."""

    def poses(self) -> tuple[float, ...]:
        """Return the newest poses of the world."""
        return self._inner.poses()

    def status(self) -> Mapping[str, str]:
        """Return the world's short status texts for people."""
        return self._inner.status()

    def check(self) -> None:
        """Raise HostError if the host is gone."""
        self._inner.check()

    def close(self) -> None:
        """Do nothing: the run above closes the world."""


def located(part: Blueprint, samples: Sequence[Sample]) -> dict[str, str] | None:
    """Return the configuration of a procedure that fits what is sensed: INITIAL if it fits, else
    the only one with its sub-SBs at a start. None if there is none, or several.
    """
    sensed: dict[FactKey, str | None] = {one.fact: one.value for one in samples}
    hierarchy = Hierarchy(part)
    initial = start_configuration(hierarchy, {})
    if _fits(part, initial, sensed):
        return initial
    found = initial
    for root in hierarchy.roots:
        fitting = list(_fitting(hierarchy, root, found, sensed))
        if len(fitting) != 1:
            return None
        found = {**found, **fitting[0]}
    return found if _fits(part, found, sensed) else None


def _fitting(
    hierarchy: Hierarchy, root: str, usual: Mapping[str, str], sensed: Mapping[FactKey, str | None]
) -> Iterator[dict[str, str]]:
    part = hierarchy.blueprint
    for state in part[root].table:
        try:
            whole = start_configuration(hierarchy, {root: state})
        except RunRefused:
            continue
        changed = {name: at for name, at in whole.items() if name == root or usual[name] != at}
        if all(_agrees(part, name, at, sensed) for name, at in changed.items()):
            yield changed


def _fits(
    part: Blueprint, configuration: Mapping[str, str], sensed: Mapping[FactKey, str | None]
) -> bool:
    return all(_agrees(part, name, state, sensed) for name, state in configuration.items())


def _agrees(part: Blueprint, name: str, state: str, sensed: Mapping[FactKey, str | None]) -> bool:
    branch = part[name]
    facts = branch.facts(state)
    return all(
        sensed.get((name, digit), value) == value
        for digit, value in enumerate(facts)
        if digit not in branch.subs
    )


def _slice(opened: OpenedWorld, part: Blueprint) -> OpenedWorld:
    """Return what an opened world has for one of its blueprints."""
    names = part.branches
    return replace(
        opened,
        bound={edge: one for edge, one in opened.bound.items() if edge.branch in names},
        sensors=tuple(one for one in opened.sensors if one.branch in names),
        rules={key: one for key, one in opened.rules.items() if key[0] in names},
    )


def _of(names: frozenset[str], samples: tuple[Sample, ...]) -> tuple[Sample, ...]:
    return tuple(one for one in samples if one.fact[0] in names)


def _nothing(event: Event) -> None:
    """Tell nobody."""
