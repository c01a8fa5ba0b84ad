"""What one run holds: its blueprint, host, senses, configuration, and what happened this tick."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from types import MappingProxyType

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import (
    IN_TRANSIT,
    CheckResult,
    FactKey,
    Scene,
    Term,
    as_expected,
    state_check,
)
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.senses import Senses
from smsl_studio.dispatch.people.bound import with_people
from smsl_studio.dispatch.people.rules import leveled_rules
from smsl_studio.host.protocol import Happened, Host, OpenedWorld
from smsl_studio.runlog.events import Event

NOWHERE: Mapping[str, str] = MappingProxyType({})


class LiveRun:
    """The facts of a run that all its parts share; verbs are elsewhere.

    ``configuration`` is committed. ``pending`` are the SBs that stand elsewhere, not committed;
    ``transit`` are the base digits in transit. Flags are computed, never stored. ``since`` is when
    each SB entered its state (simulated s), ``previous`` the edge that led there, where one did.
    ``levels`` say who acts and who senses; ``bound`` is what carries out each edge under them,
    ``people_act`` the SBs in which people carry out or confirm anything; ``people_say`` is whether
    any fact is theirs to say. ``critical`` has, for each SB that has any, the digits that are
    marked as critical. ``history`` is what became of edges, for cost functions.
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
        self.configuration = dict(start)
        self.pending: dict[str, str] = {}
        self.transit: frozenset[FactKey] = frozenset()
        self.operations = 0
        self.critical = critical_facts(self.blueprint)
        self.since = dict.fromkeys(start, self.senses.time)
        self.previous: dict[str, Address] = {}
        self.history: list[Happened] = []
        self.events: list[Event] = []

    @property
    def time(self) -> float:
        """The time of the run in simulated seconds."""
        return self.senses.time

    @property
    def believed(self) -> dict[str, str]:
        """Where every SB stands, committed or pending."""
        return {**self.configuration, **self.pending}

    def by_person(self, edge: Edge) -> bool:
        """Whether a person carries out what an edge's own function would do."""
        if edge.branch not in self.people_act or not edge.function:
            return False
        return self.levels.operation(edge.address) == HUMAN

    def emit(self, *events: Event) -> None:
        """Something happened."""
        self.events += events

    @property
    def mark(self) -> int:
        """How many events wait to be told."""
        return len(self.events)

    def tell_before(self, mark: int, event: Event) -> None:
        """Tell an event before all that came since a mark."""
        self.events.insert(mark, event)

    def drain(self) -> tuple[Event, ...]:
        """The events that wait to be told; they do so no longer."""
        events, self.events = tuple(self.events), []
        return events

    def look(self) -> None:
        """Read every sensor now."""
        self.events.extend(self.senses.look())

    def check(
        self, branch: str, state: str, transit: Collection[FactKey] = frozenset()
    ) -> CheckResult:
        """The state check of a state on the scene, without what hangs on digits in transit."""
        scene = self.senses.scene
        expected = as_expected(self.blueprint.branches[branch], state, scene, state)
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
        """The state check of every SB as it stands in a configuration, on the scene of now."""
        scene = scene or self.senses.scene
        return tuple(
            state_check(self.blueprint, name, state, scene, configuration)
            for name, state in configuration.items()
        )

    def broken(self) -> tuple[Term, ...]:
        """Integrity (clause 9): the sensed facts that differ from the flags, transit left out."""
        believed = self.believed if self.pending else self.configuration
        branches, scene = self.blueprint.branches, self.senses.scene
        found: list[Term] = []
        for name, state in believed.items():
            if as_expected(branches[name], state, scene, state) is None:
                transit = self.transit
                check = state_check(self.blueprint, name, state, scene, believed, transit=transit)
                found.extend(check.misses)
        return tuple(found)

    def relocate(self, configuration: Mapping[str, str]) -> None:
        """SBs stand where the scene has them; no edge of this run led there."""
        for name, state in configuration.items():
            if self.configuration[name] != state:
                self.configuration[name] = state
                self.since[name] = self.time
                self.previous.pop(name, None)

    def cross(self, transit: frozenset[FactKey], moved: Mapping[str, str] = NOWHERE) -> None:
        """Base digits are in transit from now on, and SBs stand elsewhere, not committed."""
        self.pending.update(moved)
        self.transit = transit

    def blame(self, edge: Edge) -> None:
        """An edge failed; cost functions hear of it."""
        self.history.append((str(edge), "failed"))

    def drop_pending(self) -> None:
        """Forget what was in transit; the committed configuration stands."""
        self.pending, self.transit = {}, frozenset()

    def commit(self, committed: Mapping[str, str], edges: Iterable[Edge]) -> None:
        """SBs take the states that became true together with these edges."""
        self.configuration.update(committed)
        now = self.time
        for name in committed:
            self.since[name] = now
            self.previous.pop(name, None)
        for edge in edges:
            self.operations += 1
            self.since[edge.branch], self.previous[edge.branch] = now, edge.address
            self.history.append((str(edge), "committed"))
        self.pending = {
            name: state for name, state in self.pending.items() if self.configuration[name] != state
        }


def critical_facts(blueprint: Blueprint) -> dict[str, tuple[int, ...]]:
    """For each SB that has any, the digits that ``_facts`` marks as critical."""
    found = {
        branch.name: tuple(d for d in range(branch.num_facts) if _is_critical(branch, d))
        for branch in blueprint
        if "_facts" in branch.fields
    }
    return {name: digits for name, digits in found.items() if digits}


def _is_critical(branch: StateBranch, digit: int) -> bool:
    note = branch.fact_note(digit)
    return note is not None and note.critical
