"""Ranks of routes as whole numbers: cost, then edges of the routed SB, then moves (clause 12).

The three parts stand in one number, so that ranks are added and compared like costs.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import inf

Rank = float
"""A rank: a whole number of any size, or ``inf`` where no way leads."""

UNITS = 10**9
"""Costs are counted in units of 1e-9, as searches round them."""

MOVE = 1
"""The rank of one move."""

NUMBER = 1 << 32
"""The rank of one edge of the routed SB."""

UNIT = 1 << 64
"""The rank of one unit of cost."""

MOST_DECIMAL = 1e6
"""Up to this cost the sums of numbers with nine decimal places are told apart as floats."""

MOST_WHOLE = 2.0**53
"""Up to this cost sums of whole numbers are exact."""


def rank_of(cost: float, number: int = 0, moves: int = 0) -> int:
    """Return the rank of a cost, a number of edges of the routed SB, and a number of moves."""
    return round(cost * UNITS) * UNIT + number * NUMBER + moves


def cost_of(rank: Rank) -> float:
    """Return the cost in a rank, ``inf`` where no way leads."""
    return rank if rank == inf else int(rank) // UNIT / UNITS


def most_exact(costs: Iterable[float]) -> float:
    """Return up to which sum floats compare sums of these costs as exact numbers do, 0 for none.

    Costs with more than nine decimal places are rounded by a search, at other points than here.
    """
    whole = True
    for cost in costs:
        if cost != round(cost, 9) or cost > MOST_WHOLE:
            return 0.0
        whole = whole and cost == int(cost)
    return MOST_WHOLE if whole else MOST_DECIMAL
