"""The cheapest route through one State Branch, always the same one.

Ties are broken by cost, then by the number of operations, then by the sequence of their names.
Costs are counted exactly (as decimal fractions), so that 0.1 + 0.2 and 0.3 are a tie.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from heapq import heappop, heappush
from math import isinf, isnan, lcm

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of

Cost = Callable[[str, str], float]
Weight = tuple[int, int]
"""Cost in units of the scale, and number of operations."""


@dataclass(frozen=True, slots=True)
class Route:
    """Operations to carry out in order, the states passed (start and goal included), the cost."""

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
    """The cheapest route from ``start`` to ``goal``; None where none leads there.

    ``avoid`` takes out operations, and states with all operations to and from them. ``cost`` says
    what ``(state, operation)`` costs; the default is what the branch declares (1 each), infinity
    takes an operation out. Raises AddressError for an unknown state, ValueError for a cost below
    zero.
    """
    graph = graph_of(branch)
    first, last = graph.number(start), graph.number(goal)
    prices = _prices(branch, graph, avoid, cost)
    best = _to_goal(graph, first, last, prices)
    if first not in best:
        return None
    edges = list(_walk(graph, first, best, prices))
    return Route(
        operations=tuple(
            Address(branch.name, graph.names[graph.sources[e]], graph.operations[e]) for e in edges
        ),
        states=(start, *(graph.names[graph.targets[e]] for e in edges)),
        cost=float(Fraction(best[first][0], prices.scale)),
    )


@dataclass(frozen=True, slots=True)
class _Prices:
    """Per edge whether it may be used and its cost in whole units; how many units make 1."""

    usable: list[bool]
    units: list[int]
    scale: int


def _to_goal(graph: BranchGraph, start: int, goal: int, prices: _Prices) -> dict[int, Weight]:
    """The least weight from each state to the goal, worked out until the start is settled."""
    best: dict[int, Weight] = {goal: (0, 0)}
    settled: set[int] = set()
    queue: list[tuple[int, int, int]] = [(0, 0, goal)]
    while queue:
        cost, count, state = heappop(queue)
        if state in settled:
            continue
        settled.add(state)
        if state == start:
            break
        for edge in graph.edges_in[state]:
            if not prices.usable[edge]:
                continue
            source = graph.sources[edge]
            weight = (cost + prices.units[edge], count + 1)
            if source not in best or weight < best[source]:
                best[source] = weight
                heappush(queue, (*weight, source))
    return best


def _walk(
    graph: BranchGraph, state: int, best: dict[int, Weight], prices: _Prices
) -> Iterator[int]:
    """The edges of the best route. Names are unique within a state, so the smallest one that keeps
    the weight leads to the smallest sequence; the count falls at each step, so it ends."""
    while best[state][1]:
        cost, count = best[state]
        edge = min(
            (
                edge
                for edge in graph.edges_out(state)
                if prices.usable[edge]
                and best.get(graph.targets[edge]) == (cost - prices.units[edge], count - 1)
            ),
            key=lambda e: graph.operations[e],
        )
        yield edge
        state = graph.targets[edge]


def _prices(
    branch: StateBranch, graph: BranchGraph, avoid: Collection[Address], cost: Cost | None
) -> _Prices:
    usable = _usable(graph, avoid)
    if cost is None and "_operations" not in branch.fields:
        return _Prices(usable, [1] * len(graph.targets), 1)
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
            usable[edge] = False
        elif value not in exact:
            exact[value] = Fraction(Decimal(repr(value)))
    scale = 1
    for fraction in exact.values():
        scale = lcm(scale, fraction.denominator)
    units = {value: int(fraction * scale) for value, fraction in exact.items()}
    return _Prices(usable, [units.get(value, 0) for value in costs], scale)


def _usable(graph: BranchGraph, avoid: Collection[Address]) -> list[bool]:
    usable = [True] * len(graph.targets)
    for address in avoid:
        state = graph.index.get(address.state)
        if address.branch != graph.branch or state is None:
            continue
        for edge in graph.edges_out(state):
            if not address.operation or graph.operations[edge] == address.operation:
                usable[edge] = False
        if not address.operation:
            for edge in graph.edges_in[state]:
                usable[edge] = False
    return usable
