"""Planning a route, without a world."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import RunRefused
from smsl_studio.front.addresses import Written, operations_at, state_at
from smsl_studio.graph.routing import Route, cheapest


def plan_route(
    where: Blueprint | StateBranch,
    start: Written,
    goal: Written,
    avoid: Iterable[Written] = (),
    branch: str | None = None,
) -> Route | None:
    """The cheapest route from one state to another of the same SB; None where none leads there.

    In a State Branch only its own edges are looked at. In a Blueprint a route of an SB that has
    sub-SBs is planned over joint configurations, so that its cost is that of what is really
    carried out; it lists the SB's own edges. AddressError for a name that does not exist;
    RunRefused where no run could stand in ``start``.
    """
    if isinstance(where, StateBranch):
        return cheapest(where, str(start), str(goal), avoid=_in_branch(where, avoid))
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
    from smsl_studio.blueprint.stepper import Terms
    from smsl_studio.dispatch.planner import Planner
    from smsl_studio.front.starts import starts_for

    hierarchy = Hierarchy(blueprint)
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


def _in_branch(branch: StateBranch, avoid: Iterable[Written]) -> list[Address]:
    found = [text if isinstance(text, Address) else Address(*Address.split(text)) for text in avoid]
    return [address for address in found if address.branch == branch.name]
