"""The data of one run: its blueprint, host, senses, configuration, and the events of this tick."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Collection, Mapping, MutableMapping
from dataclasses import replace
from types import MappingProxyType
from typing import cast

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import (
    IN_TRANSIT,
    CheckResult,
    FactKey,
    Scene,
    Term,
    checks_of,
    state_check,
)
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.hazards import GuardHazard
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.senses import Senses
from smsl_studio.dispatch.people.bound import with_people
from smsl_studio.dispatch.people.rules import leveled_rules
from smsl_studio.host.protocol import Bound, Happened, Host, OpenedWorld, Telling
from smsl_studio.runlog.events import Event

NOWHERE: Mapping[str, str] = MappingProxyType({})


class LiveRun:
    """The data that all parts of a run share. Actions are in other modules.

    ``configuration`` is committed. ``pending`` has the SBs that have moved and are not committed.
    ``transit`` are the base digits in transit, and ``moving`` the SBs that the running function
    moves. Flags are computed and never stored. ``since`` is
    the simulated time (s) when each SB entered its state, and ``previous`` the edge that led there,
    if any. ``levels`` say who acts and who senses. ``bound`` has the function or person for each
    edge. ``people_act`` are the SBs in which people carry out or confirm operations. ``people_say``
    says whether people may tell any fact. ``critical`` has the critical digits of each SB that has
    any. ``guarded`` says whether there are any, or an operation requires facts. ``history`` has the
    results of edges, for cost functions. ``hazards`` are those that guard the run, and
    ``told_hazards`` the names of those that are met and were told. ``left_out`` are annotations
    that cannot be read, as addresses with sentences. ``approved`` says that a policy guards the
    run and is met, ``met`` which typed conditions are met. ``robot`` was asked for. In an
    ``unconfirmed`` run nobody is asked to confirm operations, because it only foresees them.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        host: Host,
        opened: OpenedWorld,
        start: Mapping[str, str],
        levels: Levels | None = None,
    ) -> None:
        self.hierarchy = hierarchy
        self.blueprint = hierarchy.blueprint
        self.host = host
        self.opened = opened
        self.levels = levels or Levels(self.blueprint)
        acting = (branch.name for branch in self.blueprint if self.levels.people_do(branch.name))
        self.people_act = frozenset(acting)
        self.bound = with_people(opened.bound, self.blueprint, self.levels)
        rules = leveled_rules(self.blueprint, opened, self.levels)
        self.people_say = any(rule.people for rule in rules.values())
        self.senses = Senses(host, opened, rules)
        self._checks = {branch.name: checks_of(branch) for branch in self.blueprint}
        self.configuration = dict(start)
        self.pending: dict[str, str] = {}
        self.transit: frozenset[FactKey] = frozenset()
        self.moving: Mapping[str, str] = NOWHERE
        self.operations = 0
        self.critical = critical_facts(self.blueprint)
        self.guarded = bool(self.critical) or any(
            note.requires for branch in self.blueprint for note in branch.notes.operations.values()
        )
        self.hazards: tuple[GuardHazard, ...] = ()
        self.told_hazards: set[str] = set()
        self.left_out: tuple[tuple[str, str], ...] = ()
        self.approved = False
        self.met: tuple[str, ...] = ()
        self.robot = ""
        self.unconfirmed = False
        self.since = dict.fromkeys(start, self.senses.time)
        self.previous: dict[str, Address] = {}
        self.history: list[Happened] = []
        self.durations: dict[str, float] = {}
        """How long the function of each operation took the last time that it returned (s)."""
        self.events: list[Event] = []
        self.below = host if isinstance(host, Telling) else None
        """The host, if it carries out procedures and tells their events."""
        if self.below is not None:
            self.below.hear(lambda event: self.tell(event))
        self.tell: Callable[[Event], None] = self.events.append
        """Add one event that waits to be told. It is ``emit`` without a call of Python."""

    def guard_against(self, hazards: Collection[GuardHazard]) -> None:
        """Let hazards guard the run."""
        self.hazards = tuple(hazards)
        self.guarded = self.guarded or bool(hazards)

    def extend(
        self, hierarchy: Hierarchy, edge: Address, bound: Bound, guarded: bool = False
    ) -> None:
        """Go on with a blueprint that has one more edge, and what carries this edge out. The States
        and the facts are the same as before.
        """
        self.hierarchy, self.blueprint = hierarchy, hierarchy.blueprint
        self.levels = self.levels.of(self.blueprint)
        opened = self.opened
        own = ChainMap({edge: bound}, cast("MutableMapping[Address, Bound]", opened.bound))
        self.opened = replace(opened, bound=own, guarded=opened.guarded or guarded)
        self.bound = with_people(own, self.blueprint, self.levels)

    @property
    def time(self) -> float:
        """The simulated time (s)."""
        return self.senses.time

    @property
    def believed(self) -> dict[str, str]:
        """The state of every SB, committed or pending."""
        return {**self.configuration, **self.pending}

    def by_person(self, edge: Edge) -> bool:
        """Return whether a person carries out the edge instead of its function."""
        if edge.branch not in self.people_act or not edge.function:
            return False
        return self.levels.operation(edge.address) == HUMAN

    def emit(self, *events: Event) -> None:
        """Add events to those of this tick."""
        self.events += events

    @property
    def mark(self) -> int:
        """The number of waiting events."""
        return len(self.events)

    def tell_before(self, mark: int, event: Event) -> None:
        """Insert an event before all events that came after a mark."""
        self.events.insert(mark, event)

    def drain(self) -> tuple[Event, ...]:
        """Return the waiting events and forget them."""
        events = tuple(self.events)
        self.events.clear()
        return events

    def look(self) -> None:
        """Read every sensor now."""
        changes = self.senses.look()
        if changes:
            self.events.extend(changes)

    def check(
        self, branch: str, state: str, transit: Collection[FactKey] = frozenset()
    ) -> CheckResult:
        """Return the state check of a state on the scene. Terms that depend on digits in transit
        are left out.
        """
        scene = self.senses.scene
        expected = self._checks[branch].expected(state, scene.readings, state)
        if expected is not None:
            return expected
        believed = {**self.configuration, **self.pending, branch: state}
        result = state_check(self.blueprint, branch, state, scene, believed, transit=transit)
        if not transit:
            return result
        kept = tuple(term for term in result.terms if term.reason != IN_TRANSIT)
        return CheckResult(branch, state, kept)

    def checks(
        self, configuration: Mapping[str, str], scene: Scene | None = None
    ) -> tuple[CheckResult, ...]:
        """Return the state checks of all SBs in a configuration, on ``scene`` or the current
        scene.
        """
        scene = scene or self.senses.scene
        return tuple(
            state_check(self.blueprint, name, state, scene, configuration)
            for name, state in configuration.items()
        )

    def broken(self) -> tuple[Term, ...]:
        """Return the sensed facts that differ from the flags (integrity, clause 9). Digits in
        transit are left out.
        """
        believed = self.believed if self.pending else self.configuration
        scene = self.senses.scene
        readings, found = scene.readings, list[Term]()
        for name, state in believed.items():
            if self._checks[name].expected(state, readings, state) is None:
                transit = self.transit
                check = state_check(self.blueprint, name, state, scene, believed, transit=transit)
                found.extend(check.misses)
        return tuple(found) if found else ()

    def relocate(self, configuration: Mapping[str, str]) -> None:
        """Set the states that the scene shows. No edge of this run led there."""
        for name, state in configuration.items():
            if self.configuration[name] != state:
                self.configuration[name] = state
                self.since[name] = self.time
                self.previous.pop(name, None)

    def cross(
        self,
        transit: frozenset[FactKey],
        moved: Mapping[str, str] = NOWHERE,
        moving: Mapping[str, str] = NOWHERE,
    ) -> None:
        """Set the base digits in transit, the SBs that have moved and are not committed, and those
        that a function moves now.
        """
        if moved:
            self.pending.update(moved)
        self.transit, self.moving = transit, moving

    def blame(self, edge: Edge) -> None:
        """Note that an edge has failed, for cost functions."""
        self.history.append((str(edge), "failed"))

    def drop_pending(self) -> None:
        """Forget pending states and digits in transit. The committed configuration remains."""
        self.pending, self.transit, self.moving = {}, frozenset(), NOWHERE

    def commit(self, committed: Mapping[str, str], edges: Collection[Edge]) -> None:
        """Set the states that were committed together with these edges."""
        since, previous, now = self.since, self.previous, self.senses.time
        self.configuration.update(committed)
        for name in committed:
            since[name] = now
            previous.pop(name, None)
        for edge in edges:
            since[edge.branch], previous[edge.branch] = now, edge.address
            self.history.append((edge.text, "committed"))
        self.operations += len(edges)
        pending = self.pending
        if pending == committed:  # where one SB moves alone
            self.pending = {}
            return
        for name, state in tuple(pending.items()):
            if self.configuration[name] == state:
                del pending[name]


def critical_facts(blueprint: Blueprint) -> dict[str, tuple[int, ...]]:
    """Return the digits that ``_facts`` marks as critical, for each SB that has any."""
    found = {
        branch.name: tuple(d for d in range(branch.num_facts) if _is_critical(branch, d))
        for branch in blueprint
        if "_facts" in branch.fields
    }
    return {name: digits for name, digits in found.items() if digits}


def _is_critical(branch: StateBranch, digit: int) -> bool:
    note = branch.fact_note(digit)
    return note is not None and note.critical
