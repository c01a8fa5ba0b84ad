"""How far the states of an SB are from its ACTIVATING state."""

from __future__ import annotations

from heapq import heappop, heappush

from smsl_studio.blueprint.model import StateBranch


def far_from(branch: StateBranch) -> dict[str, float]:
    """Return the cost of the cheapest way from each state to ACTIVATING within the SB.

    States without a way are not in it. What operations require and take along is not asked.
    """
    into: dict[str, list[tuple[str, float]]] = {}
    for edge in branch.edges():
        cost = branch.cost(edge.source, edge.name)
        into.setdefault(edge.target, []).append((edge.source, cost))
    found: dict[str, float] = {}
    waiting = [(0.0, branch.activating)] if branch.activating in branch.table else []
    while waiting:
        far, state = heappop(waiting)
        if state in found:
            continue
        found[state] = far
        for source, cost in into.get(state, ()):
            if source not in found:
                heappush(waiting, (far + cost, source))
    return found
