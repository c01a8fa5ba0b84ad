"""The cost of a layout: a layout with a low cost is easy to read.

Crossings, lines through nodes, lines to the left, and the length of lines have a cost. All lines
are straight here, because other modules bend a line only where it is needed. All places are whole
numbers, so all sums are exact, and the best layout is the same on every machine. They are floats,
because numpy multiplies floats faster.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from smsl_studio.graph.build import BranchGraph

Floats = np.ndarray[Any, np.dtype[np.float64]]
"""Whole numbers, small enough that floats hold them exactly."""
Ints = np.ndarray[Any, np.dtype[np.intp]]
CROSSING, THROUGH, BACKWARDS = 800.0, 1600.0, 200.0
"""The costs of a crossing, of a line through a node, and of an operation that leads away from
INITIAL but not to the right. One pixel of line costs 1.
"""


@dataclass(frozen=True, eq=False)
class Ties:
    """The pairs of states that operations join.

    ``weight`` is the number of operations of a pair, in both directions. ``onwards`` is 1 if the
    second state of a pair is farther from INITIAL, and -1 if the first one is. It is 0 if as many
    operations lead back. ``half`` is half the width and half the height of each node, with room
    around it (pixels).
    """

    pairs: Ints
    weight: Floats
    onwards: Floats
    half: Floats
    of: list[Ints] = field(init=False)
    """The numbers of the pairs of each state."""

    def __post_init__(self) -> None:
        """Collect the pairs of each state."""
        own: list[list[int]] = [[] for _ in range(len(self.half))]
        for number, (a, b) in enumerate(self.pairs.tolist()):
            own[a].append(number)
            own[b].append(number)
        object.__setattr__(self, "of", [np.array(one, dtype=np.intp) for one in own])

    def others(self, state: int) -> Ints:
        """Return the states that operations join with a state."""
        return np.asarray(self.pairs[self.of[state]].sum(axis=1) - state)


def ties_of(graph: BranchGraph, far: Sequence[int], half: Floats) -> Ties:
    """Return the pairs of states of a graph. Operations that lead back to their own state do not
    count. ``far`` has the distance of each state from INITIAL (operations).
    """
    found: dict[tuple[int, int], list[int]] = {}
    for a, b in zip(graph.sources, graph.targets, strict=True):
        if a != b:
            both = found.setdefault((min(a, b), max(a, b)), [0, 0])
            both[0] += 1
            both[1] += (far[b] > far[a]) - (far[b] < far[a])
    pairs = np.array(sorted(found), dtype=np.intp).reshape(-1, 2)
    counts = np.array([found[pair] for pair in sorted(found)], dtype=np.float64).reshape(-1, 2)
    weight, away = counts.T
    rank = np.array(far, dtype=np.float64)
    onwards = np.sign(rank[pairs[:, 1]] - rank[pairs[:, 0]])
    return Ties(pairs, weight, np.where(away > 0.0, onwards, 0.0), half)


def cost_of(ties: Ties, at: Floats) -> float:
    """Return the cost of a whole layout. ``at`` has the centre of each node, (n, 2)."""
    total = 0.0
    for state in range(len(at)):
        total += float(costs_at(ties, at, state, at[state : state + 1], once=True)[0])
    return total


def is_clear(ties: Ties, at: Floats) -> bool:
    """Return whether no line crosses another one or passes through a node."""
    gap = at[ties.pairs[:, 0]] - at[ties.pairs[:, 1]]
    length = np.floor(np.sqrt((gap**2).sum(axis=1))) @ ties.weight
    return bool(cost_of(ties, at) - length < CROSSING)


def costs_at(ties: Ties, at: Floats, state: int, places: Floats, once: bool = False) -> Floats:
    """Return the cost of a state at each of some places: its lines, and the lines through its node.

    With ``once``, only lines to states with larger numbers count, and only crossings with later
    lines. Then a sum over all states counts nothing twice.
    """
    own = ties.of[state]
    a, b = ties.pairs[:, 0], ties.pairs[:, 1]
    rest = np.flatnonzero((a != state) & (b != state))
    starts, ends = at[a[rest]], at[b[rest]]
    hits = _hits(starts[None], ends[None], places[:, None], ties.half[state])
    found = THROUGH * (hits @ ties.weight[rest])
    if once:
        own = own[ties.pairs[own, 0] == state]
    if not len(own):
        return np.asarray(found)
    others = ties.pairs[own].sum(axis=1) - state
    weight, goals = ties.weight[own], at[others]
    step = goals[None] - places[:, None]
    # Every machine rounds a square root in the same way (IEEE 754).
    found += np.floor(np.sqrt((step**2).sum(axis=2))) @ weight
    onwards = ties.onwards[own] * np.where(ties.pairs[own, 0] == state, 1.0, -1.0)
    found += BACKWARDS * (((step[..., 0] * onwards <= 0.0) & (onwards != 0.0)) @ weight)
    if not once:
        found += THROUGH * (_nodes_on(ties, at, state, others, places) @ weight)
    worth = weight[:, None] * ties.weight[rest]
    worth[(a[rest] == others[:, None]) | (b[rest] == others[:, None])] = 0.0
    if once:
        worth[own[:, None] > rest] = 0.0
    crossed = _cross(places, goals, starts, ends)
    found += CROSSING * (crossed.reshape(len(places), -1) @ worth.ravel())
    return np.asarray(found)


def _area(a: Floats, b: Floats) -> Any:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _cross(places: Floats, goals: Floats, a: Floats, b: Floats) -> Any:
    """Return whether the line from each place to each goal crosses each line from a to b, (k, d,
    m). Lines that touch each other cross, unless they are parts of one straight line.
    """
    here, there = _area(b - a, places[:, None] - a), _area(b - a, goals[:, None] - a)
    between = here[:, None] * there[None] <= 0.0
    way = _area(places[:, None], goals[None])[:, :, None]
    sides = [
        way + _area(goals[:, None], end[None])[None] - _area(places[:, None], end[None])[:, None]
        for end in (a, b)
    ]
    in_line = (sides[0] == 0.0) & (sides[1] == 0.0)
    return between & (sides[0] * sides[1] <= 0.0) & ~in_line


def _nodes_on(ties: Ties, at: Floats, state: int, others: Ints, places: Floats) -> Any:
    """Return how many nodes the line from each place to each neighbour passes through, (k, d)."""
    hits = _hits(places[:, None, None], at[others][None, :, None], at[None, None], ties.half)
    hits[:, np.arange(len(others)), others] = False
    hits[:, :, state] = False
    return hits.sum(axis=2)


def _hits(a: Floats, b: Floats, centre: Floats, half: Floats) -> Any:
    """Return whether lines from a to b meet boxes.

    They meet if their projections overlap on both axes and on the normal of the line.
    """
    wide, high, middle = np.abs(b - a), half * 2.0, a + b - 2.0 * centre
    near = np.abs(middle[..., 0]) < wide[..., 0] + high[..., 0]
    near &= np.abs(middle[..., 1]) < wide[..., 1] + high[..., 1]
    gap = _area(b - a, centre - a)
    return near & (np.abs(gap) < wide[..., 0] * half[..., 1] + wide[..., 1] * half[..., 0])
