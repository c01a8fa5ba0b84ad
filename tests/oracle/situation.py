"""The state of a run while its record is read: what is believed, sensed, pruned and under way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from tests.oracle.carriage import carry, put_below
from tests.oracle.drawing import Drawing
from tests.oracle.scene import Scene
from tests.oracle.search import Carriage
from tests.oracle.standing import Configuration, goals_of
from tests.oracle.terms import Terms

Json = Any
TICK = 0.05
HAIR = 1e-6
LONGEST = 20.0
"""Seconds after which an operation without a declared timeout is out of time."""


@dataclass
class Step:
    """One joint step that is under way: what was asked for, what should come, what has come.

    ``plans`` are several where an edge was vetoed: whether a step goes around it depends on who
    asked for the step.
    """

    edge: str
    plans: list[Carriage]
    asked: bool
    began: float
    started: list[str] = field(default_factory=list)
    begun: list[str] = field(default_factory=list)
    acted: list[str] = field(default_factory=list)
    """The edges whose functions began, or that people were asked to carry out, in order."""
    commits: list[frozenset[str]] = field(default_factory=list)
    pending: Configuration = field(default_factory=dict)
    running: str = ""
    running_since: float = 0.0
    cut_off: str = ""
    ended: dict[str, tuple[str, float]] = field(default_factory=dict)
    over: bool = False
    """Whether an edge of it was told to be risky: it has failed, and moves nothing any more."""
    began_in: Configuration = field(default_factory=dict)
    """The configuration in which it began."""
    endangered: str = ""
    """The hazard that was met while it was under way."""
    broken_at: float = 0.0
    broken: str = ""
    """Since when and why it must not go on: a sentence, empty while it may."""

    @property
    def failed(self) -> str:
        """Which function of it ended badly, in words; empty where none did."""
        for edge, (outcome, _) in self.ended.items():
            if outcome != "returned":
                return f"{edge} {outcome}"
        return ""

    @property
    def plan(self) -> Carriage | None:
        """What should come; None where nobody knows any more."""
        return self.plans[0] if self.plans else None

    @property
    def under_way(self) -> list[str]:
        """The edges that have started and are not committed."""
        done = {edge for group in self.commits for edge in group}
        counted = list(self.started)
        for edge in done:
            if edge in counted:
                counted.remove(edge)
        return counted

    @property
    def acting(self) -> list[str]:
        """The edge that acts, or acted last and is not committed; empty where there is none."""
        return [edge for edge in self.acted[-1:] if edge in self.under_way]

    @property
    def complete(self) -> bool:
        return self.plan is not None and len(self.commits) == len(self.plan.all_commits)


class Situation:
    """The fold over a record. ``findings`` are sentences about violations of docs/running.md."""

    def __init__(self, blueprint: Json, asked: Mapping[str, Json], world: Mapping[str, Json]):
        self.asked, self.world = asked, world
        self.drawing = Drawing(blueprint, asked.get("levels", {}))
        self.scene = Scene(self.drawing, world)
        self.settle = float(world.get("settle", 0.0))
        self.goals = goals_of(self.drawing, list(asked.get("goals", ())))
        self.findings: list[str] = []
        self.configuration: Configuration = {}
        self.now = 0.0
        self.moment = -1
        self.step: Step | None = None
        self.shut: dict[str, str] = dict.fromkeys(asked.get("avoid", ()), "avoided")
        self.risky: set[str] = set()
        self.vetoed: set[str] = set()
        self.shunned: set[str] = set()
        """Edges that were vetoed and still could begin: routes may go around them."""
        self.has_vetoes = False
        """Whether an edge was ever vetoed: routes go around it for a while."""
        self.costs: dict[str, float] = {}
        self.latched = ""
        """Why nothing may move: paused, held, taken over, stopped; empty where it may."""
        self.automatic = bool(asked.get("automatic", True))
        self.requested = ""
        """The edge that somebody asked for and that has not begun."""
        self.disturbed = bool(world.get("eyes"))
        """Whether anything was said, disturbed or broken in this run."""
        self._order = 0
        self.last_thing = (-1, 0)
        """When something last happened to the procedure: the moment, and the order within it."""
        self.last_thing_at = -1.0
        self.read = (-1, 0)
        """When the sensors were last read."""
        self.read_at = 0.0
        self.tasks: dict[str, Json] = {}
        self.agreed: list[tuple[str, str, str]] = []
        """Tasks that people have answered since the last step: kind, address, answer."""
        self.asked_people = False
        """Whether people were asked anything."""
        self.asked_while = ""
        """How the run stood when an operation was asked for."""
        self.reviews: dict[str, str] = {}
        self.ended: Json = None
        self._terms: dict[tuple[Any, ...], Terms] = {}

    def broken(self, clause: int, sentence: str) -> None:
        """Note that a clause of docs/running.md does not hold here."""
        self.findings.append(f"clause {clause} broken at t={self.now:g}: {sentence}")

    def happened(self) -> None:
        """Something happened to the procedure, at this point of the record."""
        self._order += 1
        self.last_thing, self.last_thing_at = (self.moment, self._order), self.now

    def was_read(self) -> None:
        """The sensors were read, at this point of the record."""
        self._order += 1
        self.read, self.read_at = (self.moment, self._order), self.now

    @property
    def terms(self) -> Terms:
        """The terms under which edges may be used now."""
        return self._under(frozenset(self.risky))

    def _under(self, bypassed: frozenset[str]) -> Terms:
        key = (
            frozenset(self.shut),
            bypassed,
            tuple(sorted(self.costs.items())),
        )
        if key not in self._terms:
            self._terms[key] = Terms(
                self.drawing,
                key[0],
                key[1],
                dict(self.costs),
                frozenset(self.world.get("unbound", ())),
                frozenset(self.world.get("exact", ())) - frozenset(self.world.get("unbound", ())),
            )
        return self._terms[key]

    def carriage(self, edge: str, asked: bool) -> Carriage | None:
        """What carrying an edge out from here should do."""
        return carry(self.terms, edge, self.configuration, (), asked)

    def carriages(self, edge: str, asked: bool) -> list[Carriage]:
        """The same, with and without going around what was vetoed."""
        found = []
        active = self.configuration
        self.shunned = {
            one for one in self.shunned if active[one.split("/")[0]] == one.split("/")[1]
        }
        for bypassed in (self.risky, self.risky | self.vetoed, self.risky | self.shunned):
            one = carry(self._under(frozenset(bypassed)), edge, self.configuration, (), asked)
            if one is not None and one not in found:
                found.append(one)
        return found

    @property
    def flags(self) -> Configuration:
        """The active states, those in transit as they are pending."""
        pending = self.step.pending if self.step else {}
        return {**self.configuration, **pending}

    def moved_facts(self) -> set[str]:
        """The leaf facts that the step under way moves by itself (clause 9).

        An operation may also move what it declares under ``touches``, while it acts: that is what
        is unknown when it is cancelled (docs/supervision.md).
        """
        if self.step is None or self.step.over:
            return set()
        plan = self.step.plan
        edges = list(plan.starts) if plan else list(self.step.started)
        moved = {fact for edge in edges for fact in self.moved_by(edge)}
        return moved | {fact for edge in self.step.acting for fact in self.touched_by(edge)}

    def moved_by(self, edge: str) -> set[str]:
        """The leaf facts that the function of an edge changes."""
        drawing = self.drawing
        name = edge.split("/", 1)[0]
        source, target = drawing.edges[edge]
        before, after = {name: source}, {name: target}
        if drawing.kind(edge) == "load":
            put_below(drawing, edge, after)
            # Its subs stand where they are committed until it is: what is pending still moves.
            before |= {one: self.configuration[one] for one in after if one != name}
        return {
            f"{one}/{digit}"
            for one, state in after.items()
            for digit in drawing.branches[one].leaves
            if drawing.value(state, one, digit) != drawing.value(before[one], one, digit)
        }

    def touched_by(self, edge: str) -> set[str]:
        """The leaf facts that an operation may have changed once it has begun."""
        name = edge.split("/", 1)[0]
        leaves = self.drawing.branches[name].leaves
        touches = self.drawing.note(edge).get("touches", ())
        return self.moved_by(edge) | {f"{name}/{digit}" for digit in touches if digit in leaves}

    def moved_branches(self) -> set[str]:
        """The SBs whose active state the step under way moves."""
        if self.step is None:
            return set()
        plan = self.step.plan
        edges = list(plan.starts) if plan else list(self.step.started)
        found = {edge.split("/", 1)[0] for edge in edges}
        for edge in edges:
            if self.drawing.kind(edge) == "load":
                falls, rises = self.drawing.changed_subs(edge)
                branch = self.drawing.branches[edge.split("/", 1)[0]]
                for digit in (*falls, *rises):
                    found |= set(self.drawing.trees[branch.subs[digit]])
        return found

    def fact_holds(self, fact: str, value: str) -> bool | None:
        """Whether a fact of any SB, a sub digit too, has a value on sensed facts."""
        name, digit = fact.rsplit("/", 1)
        branch = self.drawing.branches[name]
        sub = branch.subs.get(int(digit))
        if sub is None:
            return self.scene.says(fact, value, self.flags)
        there = self.scene.check(sub, self.drawing.branches[sub].activating, self.flags)
        if there is None:
            return None
        on = branch.on[int(digit)]
        if value == on:
            return there
        others = {facts[int(digit)] for facts in branch.facts.values()} - {on}
        return (not there) if value in others else False

    def believed(self, fact: str) -> str:
        """The value of a fact in the active states."""
        name, digit = fact.rsplit("/", 1)
        return self.drawing.value(self.flags[name], name, int(digit))

    def critical_lost(self) -> list[str]:
        """Critical facts that are not known to be as the flags say, but for those that the step
        under way moves (clause 9)."""
        moved = self.moved_facts()
        return [
            fact
            for fact in sorted(self.drawing.critical)
            if fact not in moved
            and self.scene.is_sensed(fact)
            and self.scene.says(fact, self.believed(fact), self.flags) is not True
        ]

    def required_lost(self, edges: list[str]) -> list[str]:
        """What edges require and is not true on sensed facts, but for what the step moves."""
        moved = self.moved_branches()
        found = []
        for edge in edges:
            for fact, value in self.drawing.note(edge).get("requires", {}).items():
                if fact.rsplit("/", 1)[0] in moved:
                    continue
                if self.fact_holds(fact, value) is not True:
                    found.append(f"{edge} requires {fact}={value}")
        return found
