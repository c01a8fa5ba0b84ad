"""From an edge to its joint step, or to the reasons why there is none (clauses 5, 6 and 10)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from .edges import Edges, Extra
from .elements import Configuration, Edge, FactKey, Hazard
from .errors import PlanningError, Unavailable
from .hierarchy import Hierarchy, disagreements, standing
from .joint import Carried, Draft, JointStep
from .search import Move, Node, cheapest

MOST_CARRIED = 5_000
"""The largest number of operations in one joint step."""
MOST_WORK = 6_000_000
"""The work that one plan may take. Each edge that is looked at counts 16, and 1 for each SB."""

Held = Mapping[str, Carried]
"""For each SB its edge that is being carried out."""


def patience(states: int) -> int:
    """Return how many joint configurations a search looks at before it is given up."""
    return 50_000 + 4 * states


@dataclass(frozen=True)
class Terms:
    """Which edges may be used, and what they cost. Keys are addresses.

    ``failing`` are the edges that may lead into a failure state (None: all of them). ``costs``
    replace declared costs. No step may meet one of ``hazards``.
    """

    shut: Mapping[str, str] = field(default_factory=dict)
    failing: Collection[str] | None = ()
    costs: Mapping[str, float] = field(default_factory=dict)
    hazards: tuple[Hazard, ...] = ()
    extra: Extra | None = None

    def closures(self, edge: Edge) -> Iterator[str]:
        """Yield why an edge can be used from no configuration at all."""
        if edge.address in self.shut:
            yield f"{edge} is {self.shut[edge.address]}"
        if edge.fails and self.failing is not None and edge.address not in self.failing:
            yield f"{edge} leads into a failure: {edge.fails}"


class Stepper:
    """Makes joint steps under one set of terms, and keeps them."""

    def __init__(self, hierarchy: Hierarchy, terms: Terms) -> None:
        self.hierarchy, self.terms = hierarchy, terms
        self.blueprint = hierarchy.blueprint
        self.edges = Edges(hierarchy, terms.costs, terms.extra)
        self.in_hazards = {key[0] for one in terms.hazards for key, _ in one.facts}
        self._steps: dict[tuple[Node, Edge], JointStep | Unavailable] = {}
        self._routes: dict[object, tuple[Edge, ...] | Unavailable] = {}
        self._regions: dict[object, tuple[Node, Node]] = {}
        self._work = 0

    def key(self, configuration: Configuration) -> Node:
        """Return a configuration as a node of a search."""
        return tuple(configuration[name] for name in self.hierarchy.order)

    def renew(self) -> None:
        """Begin a new question: its work is counted anew."""
        self._work = 0

    def spend(self, edges: int) -> None:
        """Count edges that were looked at. PlanningError beyond what one plan may take."""
        size = 16 + len(self.hierarchy.order)
        self._work += (1 + edges) * size
        if self._work > MOST_WORK + 8 * size * self.blueprint.edge_count:
            raise PlanningError(
                "planning was given up: the sub-SBs can stand together in too many ways",
                "Name a nearer goal, or use fewer levels of sub-SBs, or fewer requires.",
            )

    def asked(self, configuration: Configuration, edge: Edge) -> JointStep | Unavailable:
        """Return the joint step of an edge that somebody asks for, or why there is none."""
        self.renew()
        try:
            return self.step(configuration, edge)
        except PlanningError as error:
            return Unavailable(error.sentence)

    def step(self, configuration: Configuration, edge: Edge) -> JointStep | Unavailable:
        """Return the joint step of an edge out of its SB's active state, or why there is none."""
        key = (self.key(configuration), edge)
        found = self._steps.get(key)
        if found is None:
            draft = Draft(configuration)
            try:
                self._carry(draft, edge, {})
                found = draft.step()
                self._refuse_hazards(configuration, found)
            except Unavailable as no:
                found = no.with_traceback(None)
            self._steps[key] = found
        return found

    def allows(self, configuration: Configuration, edge: Edge) -> bool:
        """Return whether an edge alone may be used from a configuration."""
        return not self._objections(configuration, edge)

    def _objections(self, configuration: Configuration, edge: Edge) -> list[str]:
        return [*self.terms.closures(edge), *self.edges.missing(edge, configuration)]

    def _allow(self, configuration: Configuration, edge: Edge) -> None:
        reasons = self._objections(configuration, edge)
        if reasons:
            raise Unavailable(*reasons)

    def _refuse_hazards(self, before: Configuration, step: JointStep) -> None:
        here = dict(before)
        for action in step.actions if self.terms.hazards else ():
            here.update(action.moved)
            for hazard in self.terms.hazards:
                if self.blueprint.meets(hazard, here):
                    words = f"{step.asked} would meet the hazard {hazard.name}"
                    raise Unavailable(words, hazard=hazard.name)

    # one edge, with everything that must move with it --------------------------------------------

    def _carry(self, draft: Draft, edge: Edge, held: Held) -> None:
        self._allow(draft.configuration, edge)
        if len(draft.carried) >= MOST_CARRIED:
            raise PlanningError(f"{edge} would take more than {MOST_CARRIED:,} operations")
        places = self._loaded(draft.configuration, edge) if edge.load else {}
        along = self._along(draft.configuration, edge, places, held)
        crossed = [sub for sub in places if self._crossing(draft.configuration, sub, places[sub])]
        new = [draft.begin(edge, self._transit(edge, crossed))]
        new += [draft.begin(one, self._transit(one, ())) for one in along]
        inner = {**held, **{one.edge.branch: one for one in new}}
        self._link(draft, new, places, inner)
        if not edge.load:
            self._drive(draft, edge, inner)
        done = draft.run(edge) if edge.acts else _last_crossing(draft, new[0])
        draft.finish(new[0], done, {**places, edge.branch: edge.target})
        for one in new[1:]:
            done = draft.run(one.edge) if one.edge.acts else done
            draft.finish(one, done, {one.edge.branch: one.edge.target})
        if not held and (edge.crossing or edge.kind != "pure"):
            self._agree(draft)

    def _transit(self, edge: Edge, loaded: Iterable[str]) -> Iterator[FactKey]:
        """Yield the base digits that are in transit until the edge commits."""
        if edge.crossing:
            yield from self.hierarchy.bases[edge.branch]
        for sub in loaded:
            yield from self.hierarchy.bases[sub]

    def _link(self, draft: Draft, new: list[Carried], places: Configuration, held: Held) -> None:
        """Let every crossing commit with the edges of its bases."""
        pairs = [(one, one.edge.branch) for one in new if one.edge.crossing]
        pairs += [(new[0], sub) for sub in places]
        draft.links += [
            (one, held[base])
            for one, crossed in pairs
            for base, _ in self.hierarchy.bases[crossed]
            if base in held
        ]

    def _agree(self, draft: Draft) -> None:
        broken = disagreements(self.hierarchy, draft.configuration)
        if broken:
            names = ", ".join(f"{name}/{digit}" for name, digit in broken)
            raise Unavailable(f"{draft.carried[0].edge} would leave {names} against its sub-SB")

    def _crossing(self, configuration: Configuration, sub: str, state: str) -> int:
        is_active = self.hierarchy.is_active
        return is_active(sub, state) - is_active(sub, configuration[sub])

    # edges of bases that go along (clause 10) ----------------------------------------------------

    def _along(
        self, configuration: Configuration, edge: Edge, places: Configuration, held: Held
    ) -> list[Edge]:
        taken = {name: one.edge for name, one in held.items()}
        taken[edge.branch] = edge
        before = len(taken)
        if edge.crossing:
            self._take(configuration, edge.branch, edge.crossing, taken, ())
        for sub, state in places.items():
            crossing = self._crossing(configuration, sub, state)
            if crossing:
                self._take(configuration, sub, crossing, taken, {*places, edge.branch})
        return list(taken.values())[before:]

    def _take(
        self,
        configuration: Configuration,
        sub: str,
        crossing: int,
        taken: dict[str, Edge],
        loaded: Collection[str],
    ) -> None:
        """Add to ``taken`` an edge of every base of a sub-SB that crosses, and of their bases."""
        kind = "rise" if crossing > 0 else "fall"
        for base, digit in self.hierarchy.bases[sub]:
            if base in loaded:
                continue
            if base in taken:
                moving = taken[base]
                if digit in (moving.rises if crossing > 0 else moving.falls):
                    continue
                raise Unavailable(f"{moving} is no {kind} of digit {digit} for {sub}")
            reasons: list[str] = []
            if not any(
                self._goes_along(configuration, one, taken, loaded, reasons)
                for one in self._singles(kind, base, configuration[base], digit)
            ):
                here = f"{base}/{configuration[base]}"
                words = f"{here} has no {kind} of digit {digit} for {sub} to take along"
                raise Unavailable(words, *reasons)

    def _goes_along(
        self,
        configuration: Configuration,
        edge: Edge,
        taken: dict[str, Edge],
        loaded: Collection[str],
        reasons: list[str],
    ) -> bool:
        attempt = {**taken, edge.branch: edge}
        try:
            self._allow(configuration, edge)
            if edge.crossing:
                self._take(configuration, edge.branch, edge.crossing, attempt, loaded)
        except Unavailable as no:
            reasons += no.reasons
            return False
        taken.clear()
        taken.update(attempt)
        return True

    def _singles(self, kind: str, base: str, state: str, digit: int) -> list[Edge]:
        """Return the pure rises or falls of one digit, cheapest first."""
        found = [
            edge
            for edge in self.edges.out(base, state)
            if edge.kind == kind and digit in (*edge.rises, *edge.falls) and not edge.load
        ]
        return sorted(found, key=lambda edge: (edge.price, edge.name))

    # sub-SBs -------------------------------------------------------------------------------------

    def _loaded(self, configuration: Configuration, edge: Edge) -> dict[str, str]:
        """Return where a ``load`` edge puts the sub-SBs that it changes and those below them."""
        failing = self.terms.failing
        may_fail = failing is None or edge.address in failing
        subs = dict(self.hierarchy.subs[edge.branch])
        found: dict[str, str] = {}
        for digit in (*edge.falls, *edge.rises):
            sub = subs[digit]
            found.update(standing(self.hierarchy, sub, self._aim(sub, digit in edge.rises)))
        for name, state in found.items():
            fails = self.blueprint[name].failing
            if not may_fail and state in fails and configuration[name] not in fails:
                raise Unavailable(f"{edge} loads {name} into a failure: {fails[state]}")
        return found

    def _aim(self, sub: str, rises: bool) -> str:
        return self.hierarchy.rest(sub, rises)

    def _drive(self, draft: Draft, edge: Edge, held: Held) -> None:
        """Move sub-SBs: first falls to INITIAL, then rises to ACTIVATING, in order of digits."""
        subs = dict(self.hierarchy.subs[edge.branch])
        for digit in (*edge.falls, *edge.rises):
            sub = subs[digit]
            goal = self._aim(sub, digit in edge.rises)
            if draft.configuration[sub] == goal:
                continue
            for part in self._sub_route(draft.configuration, sub, goal, held):
                self._carry(draft, part, held)

    def _sub_route(
        self, configuration: Configuration, sub: str, goal: str, held: Held
    ) -> tuple[Edge, ...]:
        """Return a sub-SB's own edges to its goal (clause 12). A route is kept for all
        configurations that are equal in what it depends on.
        """
        region, border = self._region(sub, held)
        fixed = tuple((name, held[name].edge.rises, held[name].edge.falls) for name in border)
        key = (sub, goal, tuple(configuration[name] for name in region), fixed)
        found = self._routes.get(key)
        if found is None:
            found = self._routes[key] = self._search(configuration, sub, goal, held)
        if isinstance(found, Unavailable):
            raise found
        return found

    def _region(self, sub: str, held: Held) -> tuple[Node, Node]:
        """Return the SBs that the route of a sub-SB depends on, in the hierarchy's order, and the
        bases around them that are being carried out already.

        These are all SBs below it, other bases that go along, and every SB with a fact that one of
        them requires.
        """
        key = (sub, frozenset(held))
        if key not in self._regions:
            moving = set(self.hierarchy.tree(sub))
            waiting, border = list(moving), set[str]()
            while waiting:
                for base, _ in self.hierarchy.bases[waiting.pop()]:
                    if base in held:
                        border.add(base)
                    elif base not in moving:
                        moving.add(base)
                        waiting.append(base)
            seen = moving.union(*(self.edges.requiring(name) for name in moving))
            order = self.hierarchy.order
            names = tuple(name for name in order if name in seen)
            self._regions[key] = names, tuple(name for name in order if name in border)
        return self._regions[key]

    def _search(
        self, configuration: Configuration, sub: str, goal: str, held: Held
    ) -> tuple[Edge, ...] | Unavailable:
        region, _ = self._region(sub, held)
        crossing = 1 if self.hierarchy.is_active(sub, goal) else -1
        at, reasons = region.index(sub), dict[str, None]()

        def moves(node: Node) -> Iterator[Move]:
            """Yield the possible edges out of a node, each with the cost of all that it moves."""
            here = {**configuration, **dict(zip(region, node, strict=True))}
            edges = self.edges.out(sub, node[at])
            for edge in edges:
                if edge.crossing not in (0, crossing):
                    continue
                draft = Draft(here)
                try:
                    self._carry(draft, edge, held)
                except Unavailable as no:
                    reasons.update(dict.fromkeys(no.reasons))
                    continue
                to = tuple(draft.configuration[name] for name in region)
                yield Move(to, draft.cost, 1, lambda: (), (edge.name,), edge)
            self.spend(len(edges))

        start = tuple(configuration[name] for name in region)
        most = patience(self.blueprint.state_count)
        found = cheapest(start, lambda node: node[at] == goal, moves, most)
        if found is None:
            words = f"no permitted way leads {sub} from {configuration[sub]} to {goal}"
            return Unavailable(words, *reasons)
        return tuple(move.what for move in found)


def _last_crossing(draft: Draft, carried: Carried) -> int:
    return max(one.done for one, base in draft.links if base is carried and one is not carried)
