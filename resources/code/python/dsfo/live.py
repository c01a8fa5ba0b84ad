"""The data of one run: where it stands, what it senses, and the events of this tick."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from .checks import IN_TRANSIT, Check, Checking, Term, check_words, words_of
from .elements import Blueprint, Edge, FactKey, Hazard
from .events import Event, event
from .hierarchy import Hierarchy
from .joint import Action
from .levels import Levels
from .senses import Senses
from .world import Host

NOTHING: frozenset[FactKey] = frozenset()


class LiveRun:
    """What all parts of a run share.

    ``configuration`` is committed. ``pending`` has the SBs that have moved and are not committed.
    ``transit`` are the base digits in transit, ``moving`` where a running function leads.
    ``operations`` counts committed edges. ``told_hazards`` are met and were told.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        host: Host,
        levels: Levels,
        start: Mapping[str, str],
        seed: int,
    ) -> None:
        self.hierarchy, self.blueprint = hierarchy, hierarchy.blueprint
        self.host, self.levels = host, levels
        self.senses = Senses(self.blueprint, host, levels, seed)
        self.configuration = dict(start)
        self.pending: dict[str, str] = {}
        self.transit, self.moving = NOTHING, dict[str, str]()
        self.operations = 0
        self.critical = [key for key in _every(self.blueprint) if self.blueprint.flag(key).critical]
        self.hazards: tuple[Hazard, ...] = self.blueprint.hazards
        self.told_hazards: set[str] = set()
        self.events: list[Event] = []

    @property
    def time(self) -> float:
        """Simulated seconds."""
        return self.host.time

    @property
    def settle(self) -> float:
        """How long (s) the world settles before a state check decides."""
        return self.host.world.settle

    @property
    def believed(self) -> dict[str, str]:
        """The state of every SB, committed or pending."""
        return {**self.configuration, **self.pending}

    def tell(self, word: str, **values: Any) -> None:
        """Add an event of this instant."""
        self.events.append(event(word, self.time, **values))

    def hear(self, events: Sequence[Event]) -> None:
        """Add events that another part has made."""
        self.events += events

    def drain(self) -> list[Event]:
        """Return the waiting events and forget them."""
        events, self.events = self.events, []
        return events

    def look(self) -> None:
        """Read every sensor now."""
        self.hear(self.senses.look())

    # state checks --------------------------------------------------------------------------------

    def check(self, branch: str, state: str, transit: Collection[FactKey] = NOTHING) -> Check:
        """Return the check of a state on the scene. Terms that depend on digits in transit are
        left out.
        """
        believed = {**self.believed, branch: state}
        found = self.checking(believed, transit).of(branch, state)
        kept = tuple(term for term in found.terms if term.reason != IN_TRANSIT)
        return Check(branch, state, kept) if transit else found

    def checking(
        self, believed: Mapping[str, str], transit: Collection[FactKey] = NOTHING
    ) -> Checking:
        """Return state checks on the present scene."""
        return Checking(self.blueprint, self.senses.scene, believed, transit)

    def checks(self, configuration: Mapping[str, str]) -> list[Check]:
        """Return the checks of all SBs in a configuration."""
        return [
            self.checking(configuration).of(name, state) for name, state in configuration.items()
        ]

    def stands(self, configuration: Mapping[str, str]) -> bool:
        """Return whether every state check of a configuration is true."""
        return all(check.truth is True for check in self.checks(configuration))

    def broken(self) -> list[Term]:
        """Return the sensed facts that differ from the flags, without digits in transit (clause
        9).
        """
        believed = self.believed
        return [
            term
            for name, state in believed.items()
            for term in self.checking(believed, self.transit).of(name, state).misses
        ]

    def words(self, terms: Sequence[Term]) -> list[str]:
        """Return terms in words."""
        return [words_of(self.blueprint, term) for term in terms]

    def why_not(self, check: Check) -> str:
        """Return why a check is not true."""
        return check_words(self.blueprint, check)

    def tell_check(self, check: Check) -> None:
        """Tell a state check."""
        result = {True: "true", False: "false", None: "unknown"}[check.truth]
        misses, unknown = self.words(check.misses), self.words(check.unknown)
        said = {"result": result, "misses": misses, "unknown": unknown}
        self.tell("state_checked", address=check.address, **said)

    # changes -------------------------------------------------------------------------------------

    def cross(self, transit: frozenset[FactKey], moving: Mapping[str, str]) -> None:
        """Set the base digits in transit, and where a function leads that runs now."""
        self.transit, self.moving = transit, dict(moving)

    def commit(self, action: Action) -> None:
        """Let the edges of an action be true, and tell it."""
        self.configuration.update(action.committed)
        self.operations += len(action.commits)
        here = self.configuration
        self.pending = {name: s for name, s in self.pending.items() if here[name] != s}
        operations = [edge.address for edge in action.commits]
        self.tell("committed", operations=operations, configuration=dict(action.committed))

    def relocate(self, configuration: Mapping[str, str]) -> None:
        """Stand where the scene shows it."""
        self.configuration.update(configuration)

    def drop_pending(self) -> None:
        """Forget pending states and digits in transit. The committed configuration remains."""
        self.pending, self.transit, self.moving = {}, NOTHING, {}

    # effects -------------------------------------------------------------------------------------

    def touched(self, begun: Sequence[Action], still_open: Collection[str]) -> list[FactKey]:
        """Return the facts that some actions may have changed, of edges that are not committed."""
        found: set[FactKey] = set()
        for action in begun:
            for edge in action.begins:
                if edge.address in still_open:
                    found |= self._leaf_changes(edge.branch, edge.source, edge.target)
                    found |= self.declared_touches(edge) if edge.acts else set()
            if action.edge.load and action.edge.address in still_open:
                for name, state in {**action.moved, **action.committed}.items():
                    found |= self._leaf_changes(name, self.configuration[name], state)
        return sorted(found)

    def changed_by(self, action: Action) -> set[FactKey]:
        """Return the facts that an action should change, or declares that it may change."""
        found, believed = self.declared_touches(action.edge), self.believed
        for name, state in {**action.moved, **action.committed}.items():
            found |= differing(self.blueprint, name, believed[name], state)
        return found

    def moved_by(self, edge: Edge) -> set[str]:
        """Return the SBs that one edge moves: its own, and with ``load`` those that it sets."""
        subs = dict(self.hierarchy.subs[edge.branch])
        below = [self.hierarchy.tree(subs[d]) for d in (*edge.falls, *edge.rises) if edge.load]
        return {edge.branch}.union(*below)

    def declared_touches(self, edge: Edge) -> set[FactKey]:
        """Return the facts that an operation declares to touch besides those it changes."""
        return {(edge.branch, digit) for digit in edge.terms.touches}

    def _leaf_changes(self, branch: str, source: str, target: str) -> set[FactKey]:
        changed = differing(self.blueprint, branch, source, target)
        return {key for key in changed if not self.blueprint.flag(key).sub}


def differing(blueprint: Blueprint, branch: str, source: str, target: str) -> set[FactKey]:
    """Return the facts in which two states of an SB differ."""
    own = blueprint[branch]
    pairs = enumerate(zip(own.facts(source), own.facts(target), strict=True))
    return {(branch, digit) for digit, (before, after) in pairs if before != after}


def _every(blueprint: Blueprint) -> list[FactKey]:
    return [(branch.name, digit) for branch in blueprint for digit in range(len(branch.flags))]
