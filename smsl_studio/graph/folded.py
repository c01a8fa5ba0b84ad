"""A long chain of states, folded into rows, so that it is seen as a whole."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise

from smsl_studio.blueprint.model import StateBranch

Point = tuple[float, float]
LONG = 7
"""A chain of fewer states stays in one row."""
ROW = 172.0
"""The distance between two rows (pixels)."""
PROPORTION = 1.6
"""The width of the folded drawing divided by its height."""
LEAST = 4
"""The least number of states in a row."""


def folded_chain(branch: StateBranch, fresh: Mapping[str, Point]) -> dict[str, Point] | None:
    """Return the place of each state of a chain in rows; the odd rows lead back (pixels).

    None if the SB is no long chain: then some state is joined to more than two others, or not all
    hang together. ``fresh`` has the places in one row; they tell how far states have to be apart.
    """
    order = chain_of(branch)
    if len(order) < LONG:
        return None
    apart = max(math.dist(fresh[one], fresh[other]) for one, other in pairwise(order))
    wide = max(LEAST, round(math.sqrt(len(order) * ROW / apart * PROPORTION)))
    # The last row is not left with one state, if one column more or less avoids it.
    wide = min((wide, wide + 1), key=lambda count: (len(order) % count == 1, count))
    found: dict[str, Point] = {}
    for number, name in enumerate(order):
        row, column = divmod(number, wide)
        found[name] = ((wide - 1 - column if row % 2 else column) * apart, row * ROW)
    return {name: found[name] for name in branch.table}


def chain_of(branch: StateBranch) -> list[str]:
    """Return the states in the order of the chain, from INITIAL if it is an end; empty if the SB is
    no chain."""
    near: dict[str, set[str]] = {name: set() for name in branch.table}
    for name, row in branch.table.items():
        for target in row.values():
            if target in near and target != name:
                near[name].add(target)
                near[target].add(name)
    ends = [name for name, others in near.items() if len(others) == 1]
    if len(ends) != 2 or any(len(others) not in (1, 2) for others in near.values()):
        return []
    here, before, order = branch.initial if branch.initial in ends else ends[0], "", []
    while here:
        order.append(here)
        onward = [name for name in near[here] if name != before]
        before, here = here, onward[0] if onward else ""
    return order if len(order) == len(near) else []
