"""Plans a route without a world."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.hazards import GuardHazard, first_met, guard_hazards
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import AddressError, RunRefused, did_you_mean
from smsl_studio.front.script.addresses import Written, operations_at, state_at
from smsl_studio.graph.routing import Route, cheapest
from smsl_studio.stop import heed

if TYPE_CHECKING:
    from smsl_studio.dispatch.route.planner import Leg


def plan_route(
    where: Blueprint | StateBranch,
    start: Written,
    goal: Written,
    avoid: Iterable[Written] = (),
    branch: str | None = None,
) -> Route | None:
    """Return the cheapest route between two states of one SB, or None if there is none.

    With a State Branch, only its own edges count, and entries of ``avoid`` in other SBs are
    ignored.

    With a Blueprint, an SB with sub-SBs is planned together with them. So the cost includes the
    operations of the sub-SBs, but the route lists only the SB's own edges. An SB without sub-SBs
    moves alone, and all other SBs keep their states of a start. The route meets no hazard (see
    ``hazards_between``). It takes no operation that ``requires`` a fact that does not hold (see
    ``unmet_between``).

    ``branch`` is the SB of states that are written without an SB. AddressError for an unknown name.
    RunRefused if no configuration agrees with ``start``.

    >>> route = plan_route(read("hanoi-corrected.json"), "State_aaa", "State_ccc")
    >>> len(route.operations), route.cost
    (7, 7.0)
    """
    if isinstance(where, StateBranch):
        first_name, last_name = _state_in(where, start), _state_in(where, goal)
        return cheapest(where, first_name, last_name, avoid=list(_edges_in(where, avoid)))
    first, last = _ends(where, start, goal, branch)
    shut = operations_at(where, avoid)
    hazards = guard_hazards(where)
    if not hazards and not where[first.branch].subs and not _requires(where[first.branch]):
        return cheapest(where[first.branch], first.state, last.state, avoid=shut)
    return _Asked(where, first, last, shut).route(hazards)


def hazards_between(
    where: Blueprint,
    start: Written,
    goal: Written,
    avoid: Iterable[Written] = (),
    branch: str | None = None,
) -> tuple[str, ...]:
    """Return the names of the hazards on the route that there would be without hazards.

    Empty if there is no such route. The arguments are those of ``plan_route``.
    """
    hazards = guard_hazards(where)
    if not hazards:
        return ()
    first, last = _ends(where, start, goal, branch)
    return _Asked(where, first, last, operations_at(where, avoid)).met(hazards)


def unmet_between(
    where: Blueprint,
    start: Written,
    goal: Written,
    avoid: Iterable[Written] = (),
    branch: str | None = None,
) -> tuple[str, ...]:
    """Return why there is no route, if operations on it require facts that do not hold.

    The route is the one that would be taken if no operation required a fact. There is a sentence
    for each missing fact. The result is empty if there is no such route, and for an SB with
    sub-SBs. The arguments are those of ``plan_route``.
    """
    first, last = _ends(where, start, goal, branch)
    if where[first.branch].subs or not _requires(where[first.branch]):
        return ()
    return _Asked(where, first, last, operations_at(where, avoid)).unmet()


def _ends(
    where: Blueprint, start: Written, goal: Written, branch: str | None
) -> tuple[Address, Address]:
    """Return both states of a question. The goal is of the SB of the start if nothing is said."""
    first = state_at(where, start, branch)
    return first, state_at(where, goal, branch or first.branch)


def _requires(branch: StateBranch) -> bool:
    """Return whether an operation of an SB requires facts."""
    return any(note.requires for note in branch.notes.operations.values())


class _Asked:
    """A question for a route of one SB in its blueprint."""

    def __init__(
        self, blueprint: Blueprint, start: Address, goal: Address, avoid: Sequence[Address]
    ) -> None:
        self._blueprint, self._start, self._goal, self._avoid = blueprint, start, goal, avoid
        self._own = blueprint[start.branch]

    def route(self, hazards: Sequence[GuardHazard]) -> Route | None:
        """Return the cheapest route that meets none of the hazards."""
        if self._alone(hazards):
            others = self._configuration()
            barred = {state for one in hazards for state in one.bars(self._own.name, others)}
            if self._start.state in barred or first_met(hazards, others) is not None:
                return None
            shut = [Address(self._own.name, state) for state in sorted(barred)]
            return self._cheapest((*self._avoid, *shut, *self._unmet(others)))
        legs = self._legs(hazards)
        if legs is None:
            return None
        edges = (edge for leg in legs for edge in leg.operations)
        own = tuple(edge for edge in edges if edge.branch == self._own.name)
        table = self._own.table
        states = (self._start.state, *(table[edge.state][edge.operation] for edge in own))
        return Route(own, states, sum(leg.cost for leg in legs))

    def met(self, hazards: Sequence[GuardHazard]) -> tuple[str, ...]:
        """Return the names of the hazards on the route that there would be without them."""
        from smsl_studio.dispatch.route.planner import hazards_on

        here = self._configuration()
        if not self._alone(hazards):
            return tuple(one.name for one in hazards_on(hazards, here, self._legs(())))
        route = self._cheapest((*self._avoid, *self._unmet(here)))
        places = [{**here, self._own.name: one} for one in route.states] if route else []
        return tuple(one.name for one in hazards if any(map(one.meets, places)))

    def unmet(self) -> tuple[str, ...]:
        """Return the missing facts on the route that would be taken if no operation required a
        fact.
        """
        closed = self._unmet(self._configuration())
        route = self._cheapest(self._avoid) if closed else None
        edges = route.operations if route else ()
        return tuple(dict.fromkeys(words for edge in edges for words in closed.get(edge, ())))

    def _unmet(self, others: Mapping[str, str]) -> dict[Address, tuple[str, ...]]:
        """Return the edges of the SB that require a fact that does not hold, with sentences.

        ``others`` has the states of all other SBs.
        """
        from smsl_studio.blueprint.configuration import Hierarchy
        from smsl_studio.blueprint.edges import Edges

        if not _requires(self._own):
            return {}
        edges, name = Edges(Hierarchy(self._blueprint)), self._own.name
        found: dict[Address, tuple[str, ...]] = {}
        for state in self._own.table:
            heed()
            for edge in edges.out(name, state):
                missing = tuple(edges.missing(edge, {**others, name: state}))
                if missing:
                    found[edge.address] = missing
        return found

    def _cheapest(self, avoid: Sequence[Address]) -> Route | None:
        return cheapest(self._own, self._start.state, self._goal.state, avoid=avoid)

    def _alone(self, hazards: Sequence[GuardHazard]) -> bool:
        """Return whether the SB moves alone, as far as its route and the hazards are concerned."""
        from smsl_studio.blueprint.configuration import Hierarchy

        if self._own.subs:
            return False
        hierarchy = Hierarchy(self._blueprint)
        above = {n for root in hierarchy.roots_of(self._own.name) for n in hierarchy.tree(root)}
        named = {name for one in hazards for name in one.states}
        return self._own.name in hierarchy.roots or not (named & above)

    def _configuration(self) -> dict[str, str]:
        from smsl_studio.blueprint.configuration import Hierarchy
        from smsl_studio.front.starts import starts_for

        hierarchy = Hierarchy(self._blueprint)
        found = next(starts_for(hierarchy, self._start.branch, self._start.state), None)
        if found is None:
            raise RunRefused(f"no configuration agrees with {self._start}")
        return found

    def _legs(self, hazards: Sequence[GuardHazard]) -> tuple[Leg, ...] | None:
        from smsl_studio.blueprint.configuration import Hierarchy
        from smsl_studio.blueprint.terms import Terms
        from smsl_studio.dispatch.route.effort import refuse_too_large
        from smsl_studio.dispatch.route.planner import Planner

        hierarchy = Hierarchy(self._blueprint)
        refuse_too_large(hierarchy)
        configuration = self._configuration()
        terms = Terms(shut=dict.fromkeys(self._avoid, "avoided"), hazards=tuple(hazards))
        return Planner(hierarchy, terms).legs(configuration, [self._goal])


def _state_in(branch: StateBranch, written: Written) -> str:
    """Return the name of a state, written alone or with the SB. ``cheapest`` reports an unknown
    name."""
    if isinstance(written, str) and written in branch.table:
        return written
    names = _names(written)
    return names[-1] if names in ((branch.name, names[-1]), (names[-1],)) else str(written)


def _edges_in(branch: StateBranch, avoid: Iterable[Written]) -> Iterator[Address]:
    """Yield the edges to avoid of one SB. Entries that name another SB are ignored."""
    for written in avoid:
        names = _names(written)
        if names[0] == branch.name and len(names) > 1:
            names = names[1:]
        elif isinstance(written, Address) or (len(names) > 1 and names[0] not in branch.table):
            continue
        edges = [edge for edge in branch.edges() if names in _ways_to_write(edge)]
        if not edges and (len(names) > 1 or names[0] not in branch.table):
            known = [*branch.table, *(edge.name for edge in branch.edges())]
            raise AddressError(
                f"{written} is no operation of {branch.name}",
                advice=did_you_mean(names[-1], known),
            )
        yield from (edge.address for edge in edges)


def _ways_to_write(edge: Operation) -> tuple[tuple[str, ...], ...]:
    """Return the ways to write an edge: state and name, state alone, name alone."""
    return (edge.source, edge.name), (edge.source,), (edge.name,)


def _names(written: Written) -> tuple[str, ...]:
    return written.path if isinstance(written, Address) else Address.split(written)
