"""From an edge that is asked for to its joint step, or to the reasons why there is none.

Pure: a configuration in, a value out. Dispatch, inspection and ``explore`` share it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import (
    Configuration,
    Hierarchy,
    disagreements,
    standing,
)
from smsl_studio.blueprint.edges import Edge, Edges, Kind
from smsl_studio.blueprint.joint import Carried, JointStep, Script
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.search import Move, cheapest

Held = Mapping[str, Carried]
"""The base edges that are being carried out, by SB."""


@dataclass(frozen=True)
class Terms:
    """What may be used: edges shut out with the reason, and the edges that have a function.

    ``bound`` None stands for a plan without a world: every edge counts as bound.
    """

    shut: Mapping[Address, str] = field(default_factory=dict)
    bound: Collection[Address] | None = None
    exact: Collection[Address] = ()


class Unavailable(Exception):  # noqa: N818 -- an answer, not an error of ours
    """An edge cannot be carried out from a configuration; ``reasons`` are sentences."""

    def __init__(self, *reasons: str) -> None:
        super().__init__("; ".join(reasons))
        self.reasons = reasons


class Stepper:
    """Writes joint steps; remembers what it found, so that one is kept as long as its terms."""

    def __init__(self, hierarchy: Hierarchy, terms: Terms | None = None) -> None:
        self.hierarchy = hierarchy
        self.terms = terms or Terms()
        self.edges = Edges(hierarchy, self.terms.exact)
        self._steps: dict[tuple[tuple[str, ...], Edge], JointStep | Unavailable] = {}
        self._routes: dict[object, tuple[Edge, ...] | Unavailable] = {}

    def step(self, configuration: Configuration, edge: Edge) -> JointStep | Unavailable:
        """The joint step of an edge out of its SB's active state (clauses 5, 6, 10)."""
        key = (self.key(configuration), edge)
        found = self._steps.get(key)
        if found is None:
            script = Script(configuration)
            try:
                self._carry(script, edge, {})
                found = script.joint_step()
            except Unavailable as no:
                found = no
            self._steps[key] = found
        return found

    def key(self, configuration: Configuration) -> tuple[str, ...]:
        """A configuration as a tuple in the order of ``hierarchy.order``."""
        return tuple(configuration[name] for name in self.hierarchy.order)

    def _carry(self, script: Script, edge: Edge, held: Held) -> Carried:
        """Write the edge, its subs' movements and the bases' edges that must go with it."""
        self._allow(script.configuration, edge)
        places = self._loaded(edge) if edge.load else {}
        along = self._along(script.configuration, edge, places, held)
        crossed = (sub for sub in places if self._crossing(script.configuration, sub, places[sub]))
        new = [script.begin(edge, self._transit(edge, crossed))]
        new += [script.begin(one, self._transit(one, ())) for one in along]
        carried, inner = new[0], {**held, **{one.edge.branch: one for one in new}}
        self._link(script, new, places, inner)
        if not edge.load:
            self._drive(script, edge, inner)
        done = script.run(edge) if edge.function else self._last_crossing(script, carried)
        script.finish(carried, done, {**places, edge.branch: edge.target})
        for other in along:
            done = script.run(other) if other.function else done
            script.finish(inner[other.branch], done, {other.branch: other.target})
        if not held and (edge.crossing or edge.kind is not Kind.PURE):
            self._agree(script)
        return carried

    def allows(self, configuration: Configuration, edge: Edge) -> bool:
        """Whether an edge by itself may be used from a configuration: not shut, bound, required
        facts given. All there is to ask of a pure edge that is no crossing."""
        try:
            self._allow(configuration, edge)
        except Unavailable:
            return False
        return True

    def _allow(self, configuration: Configuration, edge: Edge) -> None:
        reasons = []
        shut = self.terms.shut.get(edge.address) if self.terms.shut else None
        if shut is not None:
            reasons.append(f"{edge} is {shut}")
        bound = self.terms.bound
        if edge.function and bound is not None and edge.address not in bound:
            reasons.append(f"no function is bound to {edge} in this world")
        if edge.requires:
            reasons.extend(self.edges.missing(edge, configuration))
        if reasons:
            raise Unavailable(*reasons)

    def _transit(self, edge: Edge, loaded: Iterable[str]) -> tuple[FactKey, ...]:
        """The base digits in transit from the start of a crossing to its commit."""
        crossed = [edge.branch] if edge.crossing else []
        return tuple(fact for sub in (*crossed, *loaded) for fact in self.hierarchy.bases[sub])

    def _agree(self, script: Script) -> None:
        broken = disagreements(self.hierarchy, script.configuration)
        if broken:
            names = ", ".join(f"{name}/{digit}" for name, digit in broken)
            raise Unavailable(f"{script.carried[0].edge} would leave {names} against its sub-SB")

    # its bases: what a crossing takes along (clauses 5 and 10) ----------------------------------

    def _along(
        self, configuration: Configuration, edge: Edge, places: Mapping[str, str], held: Held
    ) -> tuple[Edge, ...]:
        """The bases' edges that go along with a crossing, nearest first."""
        taken = {name: carried.edge for name, carried in held.items()}
        taken[edge.branch] = edge
        before = len(taken)
        if edge.crossing:
            self._take(configuration, edge.branch, edge.crossing, taken, {})
        for sub, state in places.items():
            crossing = self._crossing(configuration, sub, state)
            if crossing:
                self._take(configuration, sub, crossing, taken, {**places, edge.branch: ""})
        return tuple(taken.values())[before:]

    def _crossing(self, configuration: Configuration, sub: str, state: str) -> int:
        """1 where a sub would enter its ACTIVATING state, -1 where it would leave it, else 0."""
        activating = self.hierarchy.blueprint[sub].activating
        return (state == activating) - (configuration[sub] == activating)

    def _take(
        self,
        configuration: Configuration,
        sub: str,
        crossing: int,
        taken: dict[str, Edge],
        loaded: Mapping[str, str],
    ) -> None:
        kind = Kind.RISE if crossing > 0 else Kind.FALL
        for base, digit in self.hierarchy.bases[sub]:
            if base in loaded:
                continue
            if base in taken:
                moving = taken[base]
                if digit in (moving.rises if crossing > 0 else moving.falls):
                    continue
                raise Unavailable(f"{moving} is no {kind.value} of digit {digit} for {sub}")
            reasons: list[str] = []
            for edge in self._singles(kind, base, configuration[base], digit):
                attempt = {**taken, base: edge}
                try:
                    self._allow(configuration, edge)
                    if edge.crossing:
                        self._take(configuration, base, edge.crossing, attempt, loaded)
                except Unavailable as no:
                    reasons.extend(no.reasons)
                    continue
                taken.clear()
                taken.update(attempt)
                break
            else:
                here = f"{base}/{configuration[base]}"
                words = f"{here} has no {kind.value} of digit {digit} for {sub} to take along"
                raise Unavailable(words, *reasons)

    def _singles(self, kind: Kind, base: str, state: str, digit: int) -> list[Edge]:
        """The pure rises or falls of one digit, cheapest first; ``load`` edges do not count."""
        found = (
            edge
            for edge in self.edges.out(base, state)
            if edge.kind is kind and digit in (*edge.rises, *edge.falls) and not edge.load
        )
        return sorted(found, key=lambda edge: (edge.price, edge.name))

    def _link(
        self, script: Script, new: list[Carried], places: Mapping[str, str], held: Held
    ) -> None:
        """Every crossing commits with the edges of its bases."""
        pairs = [(carried, carried.edge.branch) for carried in new if carried.edge.crossing]
        pairs += [(new[0], sub) for sub in places]
        script.links += [
            (carried, held[base])
            for carried, crossed in pairs
            for base, _ in self.hierarchy.bases[crossed]
            if base in held
        ]

    # its subs -----------------------------------------------------------------------------------

    def _loaded(self, edge: Edge) -> dict[str, str]:
        """Where a ``load`` edge leaves the subs it changes and everything below them."""
        subs = dict(self.hierarchy.subs[edge.branch])
        found: dict[str, str] = {}
        for digit in (*edge.falls, *edge.rises):
            branch = self.hierarchy.blueprint[subs[digit]]
            state = branch.activating if digit in edge.rises else branch.initial
            found.update(standing(self.hierarchy, branch.name, state))
        return found

    def _drive(self, script: Script, edge: Edge, held: Held) -> None:
        """Falls to INITIAL, then rises to ACTIVATING, in order of digit (clause 5)."""
        subs = dict(self.hierarchy.subs[edge.branch])
        for digit in (*edge.falls, *edge.rises):
            branch = self.hierarchy.blueprint[subs[digit]]
            goal = branch.activating if digit in edge.rises else branch.initial
            for part in self._sub_route(script.configuration, branch, goal, held):
                self._carry(script, part, held)

    def _sub_route(
        self, configuration: Configuration, branch: StateBranch, goal: str, held: Held
    ) -> tuple[Edge, ...]:
        """The sub's own edges to its goal, over the joint configurations below it (clause 12)."""
        if configuration[branch.name] == goal:
            return ()
        taken = frozenset((name, carried.edge.name) for name, carried in held.items())
        key = (branch.name, goal, self._seen(branch.name, configuration), taken)
        if key not in self._routes:
            self._routes[key] = self._search(configuration, branch, goal, held)
        found = self._routes[key]
        if isinstance(found, Unavailable):
            raise found
        return found

    def _seen(self, branch: str, configuration: Configuration) -> tuple[str, ...]:
        """What of a configuration a sub-route depends on."""
        if branch in self._plain:
            return (configuration[branch],)
        return self.key(configuration)

    def _search(
        self, configuration: Configuration, branch: StateBranch, goal: str, held: Held
    ) -> tuple[Edge, ...] | Unavailable:
        crossing = 1 if goal == branch.activating else -1
        at = self.hierarchy.order.index(branch.name)
        reasons: dict[str, None] = {}

        def moves(node: tuple[str, ...]) -> Iterator[Move]:
            here = dict(zip(self.hierarchy.order, node, strict=True))
            for edge in self.edges.out(branch.name, node[at]):
                if edge.crossing not in (0, crossing):
                    continue
                script = Script(here)
                try:
                    self._carry(script, edge, held)
                except Unavailable as no:
                    reasons.update(dict.fromkeys(no.reasons))
                    continue
                to = self.key(script.configuration)
                yield Move(to, script.cost, (edge.name,), (), edge)

        found = cheapest(self.key(configuration), lambda node: node[at] == goal, moves)
        if found is not None:
            return tuple(move.what for move in found)
        here = configuration[branch.name]
        return Unavailable(f"no permitted way leads {branch.name} from {here} to {goal}", *reasons)

    @cached_property
    def _plain(self) -> frozenset[str]:
        """The subs whose routes depend on nothing but their own state: flat, with one base, and
        with no ``requires`` in them or in what they take along."""
        demanding = any(
            note.requires
            for branch in self.hierarchy.blueprint
            for note in branch.notes.operations.values()
        )
        if demanding:
            return frozenset()
        return frozenset(
            name
            for name, bases in self.hierarchy.bases.items()
            if len(bases) == 1 and not self.hierarchy.subs[name]
        )

    def _last_crossing(self, script: Script, carried: Carried) -> int:
        return max(one.done for one, base in script.links if base is carried and one is not carried)
