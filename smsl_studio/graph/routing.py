"""The cheapest route through one State Branch.

The result is always the same: the first by cost, then by the number of operations, then by the
sequence of their names. Costs are added as decimal fractions, so that 0.1 + 0.2 equals 0.3.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from math import isinf, isnan, lcm

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.both_ends import lightest
from smsl_studio.graph.build import BranchGraph, graph_of

Cost = Callable[[str, str], float]


@dataclass(frozen=True, slots=True)
class Route:
    """A route: its operations in order, its states with start and goal, and its cost."""

    operations: tuple[Address, ...]
    states: tuple[str, ...]
    cost: float


def cheapest(
    branch: StateBranch,
    start: str,
    goal: str,
    *,
    avoid: Collection[Address] = (),
    cost: Cost | None = None,
) -> Route | None:
    """Return the cheapest route from ``start`` to ``goal``, or None if there is none.

    ``avoid`` has operations and states that the route must not use. ``cost`` gives the cost of
    ``(state, operation)``, infinity to exclude it. By default it is the cost that the branch
    declares, else 1. Raises AddressError for an unknown state and ValueError for a cost below zero.
    """
    graph = graph_of(branch)
    first, last = graph.number(start), graph.number(goal)
    prices = _prices(branch, graph, avoid, cost)
    edges = lightest(graph, first, last, prices.weights, prices.never)
    if edges is None:
        return None
    units = sum(prices.weights[edge] for edge in edges) // prices.unit
    return Route(
        operations=tuple(
            Address(branch.name, graph.names[graph.sources[e]], graph.operations[e]) for e in edges
        ),
        states=(start, *(graph.names[graph.targets[e]] for e in edges)),
        cost=float(Fraction(units, prices.scale)),
    )


@dataclass(frozen=True, slots=True)
class _Prices:
    """The weight of each edge: its cost in whole units, times ``unit``, plus 1 for the edge itself.

    So the cost counts before the number of operations. ``unit`` is the weight of one unit of cost,
    and ``scale`` units make a cost of 1. An edge that must not be used has the weight ``never``,
    which is larger than the weight of any path.
    """

    weights: list[int]
    unit: int
    scale: int
    never: int

    def without(self, closed: Collection[int]) -> _Prices:
        """Exclude some edges, and return this object."""
        for edge in closed:
            self.weights[edge] = self.never
        return self


def _prices(
    branch: StateBranch, graph: BranchGraph, avoid: Collection[Address], cost: Cost | None
) -> _Prices:
    unit = len(graph) + 1
    closed = _closed(graph, avoid)
    if cost is None and "_operations" not in branch.fields:
        return _Prices([unit + 1] * len(graph.targets), unit, 1, 2 * unit * unit).without(closed)
    price = cost or branch.cost
    costs = [
        float(price(graph.names[source], operation))
        for source, operation in zip(graph.sources, graph.operations, strict=True)
    ]
    exact: dict[float, Fraction] = {}
    for edge, value in enumerate(costs):
        if isnan(value) or value < 0:
            where = Address(graph.branch, graph.names[graph.sources[edge]], graph.operations[edge])
            raise ValueError(f"the cost of {where} is {value}; a cost is 0 or more")
        if isinf(value):
            closed.add(edge)
        elif value not in exact:
            exact[value] = Fraction(Decimal(repr(value)))
    scale = 1
    for fraction in exact.values():
        scale = lcm(scale, fraction.denominator)
    units = {value: int(fraction * scale) for value, fraction in exact.items()}
    never = (max(units.values(), default=0) + 1) * unit * unit
    weights = {value: count * unit + 1 for value, count in units.items()}
    return _Prices([weights.get(v, never) for v in costs], unit, scale, never).without(closed)


def _closed(graph: BranchGraph, avoid: Collection[Address]) -> set[int]:
    """Return the edges that ``avoid`` excludes."""
    closed: set[int] = set()
    for address in avoid:
        state = graph.index.get(address.state)
        if address.branch != graph.branch or state is None:
            continue
        if not address.operation:
            closed.update(graph.edges_out(state), graph.edges_in[state])
        else:
            here = graph.edges_out(state)
            closed.update(e for e in here if graph.operations[e] == address.operation)
    return closed
