"""A local search for a better layout: states move one by one until no move helps. They settle.

States stand on a lattice, so every place is a pair of whole numbers. A move is made only if it
makes the layout cheaper (``crossings`` has the cost), so the search ends, and the same layout
always ends in the same way.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable

import numpy as np

from smsl_studio.graph.crossings import Floats, Ties, costs_at
from smsl_studio.stop import heed

GAP = np.array([38.0, 20.0])
"""The room between two nodes, in addition to the room around each node (pixels)."""
ROUNDS = 8
WIDEST, WIDE, NARROW = (8, 10), (4, 6), (2, 4)
"""How many steps of the lattice a state looks across and down: many in a graph of few pairs."""
FEW_PAIRS, MANY_PAIRS = 30, 100


def settle(ties: Ties, at: Floats, stays: Iterable[int] = (), across: bool = True) -> Floats:
    """Return places at which no state can stand better.

    ``at`` has the places at the beginning. The states of ``stays`` do not move. Without ``across``
    every state keeps its x.
    """
    at = at.copy()
    pairs = len(ties.pairs)
    reach = WIDEST if across and pairs <= FEW_PAIRS else WIDE if pairs <= MANY_PAIRS else NARROW
    moves = _steps(reach[0] if across else 0, reach[1]) * ties.step
    fixed = set(stays)
    movable = [i for i in range(len(at)) if i not in fixed and len(ties.of[i])]
    waiting = set(movable)
    for _ in range(ROUNDS):
        changed: set[int] = set()
        for state in [i for i in movable if i in waiting]:
            heed()
            if _moved(ties, at, state, moves, across):
                changed.update((state, *ties.others(state).tolist()))
        waiting = changed
        if not waiting:
            break
    return at


def _steps(across: int, down: int) -> Floats:
    """Return the steps to near places of the lattice, nearest first. The first one is no step."""
    found = itertools.product(range(-across, across + 1), range(-down, down + 1))
    near = sorted(found, key=lambda p: (abs(p[0]) + abs(p[1]), p))
    return np.array(near, dtype=np.float64)


def _moved(ties: Ties, at: Floats, state: int, moves: Floats, across: bool) -> bool:
    """Move a state to the cheapest free place near it or near the middle of its neighbours."""
    middle = np.sort(at[ties.others(state)], axis=0)[len(ties.of[state]) // 2]
    middle = np.round((middle - at[state]) / ties.step) * ties.step
    if not across:
        middle[0] = 0.0
    places = np.vstack([moves, moves + middle]) + at[state]
    places = places[_free(ties, at, state, places)]
    if not len(places):
        return False
    now = float(costs_at(ties, at, state, at[state : state + 1])[0])
    costs = costs_at(ties, at, state, places, now)
    best = int(costs.argmin())
    if costs[best] == np.inf:
        return False
    at[state] = places[best]
    return True


def _free(
    ties: Ties, at: Floats, state: int, places: Floats
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    room = ties.half + ties.half[state] + GAP
    near = (at > places.min(axis=0) - room) & (at < places.max(axis=0) + room)
    near[state] = False
    nodes = np.flatnonzero(near[:, 0] & near[:, 1])
    gap = np.abs(places[:, None] - at[nodes])
    meets = (gap[..., 0] < room[nodes, 0]) & (gap[..., 1] < room[nodes, 1])
    return np.asarray(~meets.any(axis=1))
