"""Plans a route without a world."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.elements import Operation
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import AddressError, RunRefused, did_you_mean
from smsl_studio.front.script.addresses import Written, operations_at, state_at
from smsl_studio.graph.routing import Route, cheapest


def plan_route(
    where: Blueprint | StateBranch,
    start: Written,
    goal: Written,
    avoid: Iterable[Written] = (),
    branch: str | None = None,
) -> Route | None:
    """Return the cheapest route between two states of one SB. None if there is no route.

    With a State Branch only its own edges count, and entries of ``avoid`` in other SBs are ignored.
    With a Blueprint, an SB with sub-SBs is planned over joint configurations. So the cost includes
    the operations of the sub-SBs, but the route lists only the SB's own edges. ``branch`` is the SB
    of states that are written without an SB. AddressError for an unknown name. RunRefused if no
    configuration agrees with ``start``.

    >>> route = plan_route(read("hanoi-corrected.json"), "State_aaa", "State_ccc")
    >>> len(route.operations), route.cost
    (7, 7.0)
    """
    if isinstance(where, StateBranch):
        first_name, last_name = _state_in(where, start), _state_in(where, goal)
        return cheapest(where, first_name, last_name, avoid=list(_edges_in(where, avoid)))
    first = state_at(where, start, branch)
    last = state_at(where, goal, branch or first.branch)
    shut = operations_at(where, avoid)
    own = where[first.branch]
    if not own.subs:
        return cheapest(own, first.state, last.state, avoid=shut)
    return _joint_route(where, first, last, shut)


def _joint_route(
    blueprint: Blueprint, start: Address, goal: Address, avoid: Iterable[Address]
) -> Route | None:
    from smsl_studio.blueprint.configuration import Hierarchy
    from smsl_studio.blueprint.terms import Terms
    from smsl_studio.dispatch.route.effort import refuse_too_large
    from smsl_studio.dispatch.route.planner import Planner
    from smsl_studio.front.starts import starts_for

    hierarchy = Hierarchy(blueprint)
    refuse_too_large(hierarchy)
    configuration = next(starts_for(hierarchy, start.branch, start.state), None)
    if configuration is None:
        raise RunRefused(f"no configuration agrees with {start}")
    planner = Planner(hierarchy, Terms(shut=dict.fromkeys(avoid, "avoided")))
    legs = planner.legs(configuration, [goal])
    if legs is None:
        return None
    own = tuple(edge for leg in legs for edge in leg.operations if edge.branch == goal.branch)
    table = blueprint[goal.branch].table
    states = (start.state, *(table[edge.state][edge.operation] for edge in own))
    return Route(own, states, sum(leg.cost for leg in legs))


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
