"""The cost of a layout: a layout with a low cost is easy to read.

Crossings, lines through nodes, lines to the left, and the length of lines have a cost. All lines
are straight here, because other modules bend a line only where it is needed. All places are whole
numbers, so all sums are exact, and the best layout is the same on every machine. They are floats,
because numpy multiplies floats faster.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
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

    ``onwards`` is 1 where the second state of a pair is farther from INITIAL, -1 where the first
    one is, and 0 if as many operations lead back. ``half`` is half the width and half the height of
    each node, with room around it (pixels). States stand on a lattice: ``step`` is half the
    distance of two columns, and half that of two rows (pixels).
    """

    pairs: Ints
    weight: Floats
    onwards: Floats
    half: Floats
    step: Floats
    of: list[Ints] = field(init=False)
    """The numbers of the pairs of each state."""

    def __post_init__(self) -> None:
        """Collect the pairs of each state."""
        own: list[list[int]] = [[] for _ in range(len(self.half))]
        for number, (a, b) in enumerate(self.pairs.tolist()):
            own[a].append(number)
            own[b].append(number)
        object.__setattr__(self, "of", [np.array(one, dtype=np.intp) for one in own])

    @cached_property
    def apart(self) -> list[Ints]:
        """The numbers of the pairs that each state is not in."""
        every = np.arange(len(self.pairs))
        return [np.delete(every, own) for own in self.of]

    @cached_property
    def meet(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which pairs have a state in common with which, (n, n)."""
        one = self.pairs[:, None, :, None]
        return np.asarray((one == self.pairs[None, :, None, :]).any(axis=(2, 3)))

    def others(self, state: int) -> Ints:
        """Return the states that operations join with a state."""
        return np.asarray(self.pairs[self.of[state]].sum(axis=1) - state)


def ties_of(graph: BranchGraph, far: Sequence[int], half: Floats, step: Floats) -> Ties:
    """Return the pairs of a graph, without operations that lead back to their own state. ``far``
    tells how far each state is from INITIAL.
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
    return Ties(pairs, weight, np.where(away > 0.0, onwards, 0.0), half, step)


def cost_of(ties: Ties, at: Floats) -> float:
    """Return the cost of a whole layout. ``at`` has the centre of each node, (n, 2)."""
    starts, ends = at[ties.pairs[:, 0]], at[ties.pairs[:, 1]]
    step = ends - starts
    total = _lengths(step) @ ties.weight
    total += BACKWARDS * (_leads_back(step, ties.onwards) @ ties.weight)
    hits = _hits(starts[:, None], ends[:, None], at[None], ties.half[None])
    hits[np.arange(len(hits))[:, None], ties.pairs] = False
    total += THROUGH * (hits.sum(axis=1) @ ties.weight)
    a, b = (_area(step[:, None], points[None] - starts[:, None]) for points in (starts, ends))
    crossed = (a * b <= 0.0) & (a * b <= 0.0).T & ~((a == 0.0) & (b == 0.0)) & ~ties.meet
    return float(total + CROSSING / 2.0 * (ties.weight @ crossed @ ties.weight))


def is_clear(ties: Ties, at: Floats) -> bool:
    """Return whether no line crosses another one or passes through a node."""
    gap = at[ties.pairs[:, 0]] - at[ties.pairs[:, 1]]
    return bool(cost_of(ties, at) - _lengths(gap) @ ties.weight < CROSSING)


def costs_at(ties: Ties, at: Floats, state: int, places: Floats, most: float = np.inf) -> Floats:
    """Return what a state costs at each of some places: its lines, and the lines through its node.

    The result is ``inf`` for places at which it costs ``most`` or more.
    """
    own = ties.of[state]
    others = ties.pairs[own].sum(axis=1) - state
    weight, goals = ties.weight[own], at[others]
    step = goals[None] - places[:, None]
    onwards = ties.onwards[own] * np.where(ties.pairs[own, 0] == state, 1.0, -1.0)
    found = (_lengths(step) + BACKWARDS * _leads_back(step, onwards)) @ weight
    # Few places are cheap enough to be looked at further: what takes longest comes last.
    here = np.flatnonzero(found < most)
    rest = _near_pairs(ties, at, state, np.vstack([places[here], goals]))
    a, b = ties.pairs[rest].T
    starts, ends = at[a], at[b]
    worth = weight[:, None] * ties.weight[rest]
    worth[(a == others[:, None]) | (b == others[:, None])] = 0.0
    crossed = _cross(places[here], goals, starts, ends)
    found[here] += CROSSING * (crossed.reshape(len(here), worth.size) @ worth.ravel())
    here = here[found[here] < most]
    hits = _hits(starts[None], ends[None], places[here, None], ties.half[state])
    found[here] += THROUGH * (hits @ ties.weight[rest])
    here = here[found[here] < most]
    found[here] += THROUGH * (_nodes_on(ties, at, state, others, places[here]) @ weight)
    found[found >= most] = np.inf
    return np.asarray(found)


def _near_pairs(ties: Ties, at: Floats, state: int, points: Floats) -> Ints:
    """Return the pairs without a state whose lines may meet one between some points, or its node at
    one of them.
    """
    rest = ties.apart[state]
    if not len(points):
        return rest[:0]
    low, high = points.min(axis=0) - ties.half[state], points.max(axis=0) + ties.half[state]
    starts, ends = at[ties.pairs[rest, 0]], at[ties.pairs[rest, 1]]
    near = (np.minimum(starts, ends) <= high) & (np.maximum(starts, ends) >= low)
    return np.asarray(rest[near[:, 0] & near[:, 1]])


def _lengths(step: Floats) -> Floats:
    # A square root is rounded in the same way everywhere.
    return np.asarray(np.floor(np.sqrt((step**2).sum(axis=-1))))


def _leads_back(step: Floats, onwards: Floats) -> Any:
    return (step[..., 0] * onwards <= 0.0) & (onwards != 0.0)


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
    goals = at[others]
    points = np.vstack([places, goals])
    near = (at >= points.min(axis=0) - ties.half) & (at <= points.max(axis=0) + ties.half)
    near[state] = False
    nodes = np.flatnonzero(near[:, 0] & near[:, 1])
    hits = _hits(places[:, None, None], goals[None, :, None], at[nodes], ties.half[nodes])
    return (hits & (others[:, None] != nodes)).sum(axis=2)


def _hits(a: Floats, b: Floats, centre: Floats, half: Floats) -> Any:
    """Return whether lines from a to b meet boxes.

    They meet if their projections overlap on both axes and on the normal of the line.
    """
    wide, high, middle = np.abs(b - a), half * 2.0, a + b - 2.0 * centre
    near = np.abs(middle[..., 0]) < wide[..., 0] + high[..., 0]
    near &= np.abs(middle[..., 1]) < wide[..., 1] + high[..., 1]
    gap = _area(b - a, centre - a)
    return near & (np.abs(gap) < wide[..., 0] * half[..., 1] + wide[..., 1] * half[..., 0])
