"""A layout of graphs that form a triangle, such as that of the Tower of Hanoi.

In the Tower of Hanoi the corners are the three states with all disks on one peg. The distances of a
state to the corners identify it and are its coordinates: the distance to the apex is its row, and
the difference of the other two is its place in the row. Nothing here knows about disks. A graph
gets this layout if its operations join neighbours on the lattice that is found in this way.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from itertools import repeat
from operator import add, mul, sub

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.shape import distances

HALF_STEP, ROW = 67.0, 102.0
"""Pixels between places in a row (half the distance of two nodes), and between rows."""
_LATTICE = {(0, 2), (0, -2), (1, 1), (1, -1), (-1, 1), (-1, -1)}
_TOLERATED = 0.1
"""The largest share of operations that may leave the lattice. The same share of them may have no
operation that leads back."""
_TRIALS = 6
Steps = Callable[[int], list[int]]
"""The number of steps from a state to each state."""


def in_triangle(branch: StateBranch) -> dict[str, tuple[float, float]] | None:
    """Return the place of each state (pixels) with INITIAL's corner on top, or None if the graph is
    no such triangle.
    """
    graph = graph_of(branch)
    if len(graph.targets) < len(graph) - 1:  # too few operations to join all states
        return None
    lone = _lone(graph)
    if len(graph) < 3 or len(lone) > _TOLERATED * len(graph.targets):
        return None
    # A single wrong operation would bend all distances. No operation leads back from it, so each of
    # these is left out in turn.
    for stray in (None, *lone[:_TRIALS]):
        near = _without(graph.neighbours, stray)
        lattice = _lattice(branch, graph, near)
        if lattice is not None:
            return {
                name: (x * HALF_STEP, row * ROW)
                for name, (row, x) in zip(graph.names, lattice, strict=True)
            }
    return None


def _lattice(
    branch: StateBranch, graph: BranchGraph, near: list[list[int]]
) -> list[tuple[int, int]] | None:
    """Return the row and the half steps in it for each state. None if two states share a place, or
    if operations do not fit.
    """
    steps = cache(partial(distances, near))
    corners = _corners(branch, graph, near, steps)
    if corners is None:
        return None
    apex, left, right = map(steps, corners)
    places = list(zip(apex, map(sub, left, right), strict=True))
    whole = min(apex) >= 0 and len(set(places)) == len(places)
    return places if whole and _fits(graph, places) else None


def _lone(graph: BranchGraph) -> list[tuple[int, int]]:
    """Return the pairs of states that operations join in one direction only."""
    # A pair is one number, because there may be many thousands.
    count, sources, targets = len(graph), graph.sources, graph.targets
    there = set(map(add, map(mul, sources, repeat(count)), targets))
    lone = there.difference(map(add, map(mul, targets, repeat(count)), sources))
    return [divmod(pair, count) for pair in sorted(lone)]


def _without(near: list[list[int]], pair: tuple[int, int] | None) -> list[list[int]]:
    if pair is None:
        return near
    fewer = list(near)
    for state, other in (pair, pair[::-1]):
        fewer[state] = [i for i in near[state] if i != other]
    return fewer


def _corners(
    branch: StateBranch, graph: BranchGraph, near: list[list[int]], steps: Steps
) -> tuple[int, int, int] | None:
    """Return the apex, the left and the right corner: the three states farthest from each other.

    The apex is the corner nearest to INITIAL. ACTIVATING is the right corner if it is a corner;
    else that is the one listed later.
    """
    initial = graph.index.get(branch.initial, 0)
    first = _farthest(near, steps(initial))
    second = _farthest(near, steps(first))
    third = _farthest(near, list(map(min, steps(first), steps(second))))
    if len({first, second, third}) < 3:
        return None
    away = steps(initial)
    apex = min((first, second, third), key=lambda corner: (away[corner], corner))
    goal = graph.index.get(branch.activating)
    left, right = sorted({first, second, third} - {apex}, key=lambda c: (c == goal, c))
    return apex, left, right


def _farthest(near: list[list[int]], steps: list[int]) -> int:
    """Return the state with the most steps. Of several it is the one with the fewest neighbours,
    because corners have few.
    """
    most = max(steps)
    ends = [state for state, step in enumerate(steps) if step == most]
    return min(ends, key=lambda state: (len(near[state]), state))


def _fits(graph: BranchGraph, lattice: list[tuple[int, int]]) -> bool:
    """Return whether the operations join neighbours on the lattice, except for a small share."""
    # Row and place in it are one number, so that operations of one direction have one difference.
    wide = 4 * len(graph) + 8
    at = [row * wide + x for row, x in lattice]
    ends = map(at.__getitem__, graph.targets), map(at.__getitem__, graph.sources)
    fitting = {row * wide + x for row, x in _LATTICE} | {0}
    strays = len(graph.targets) - sum(map(fitting.__contains__, map(sub, *ends)))
    return strays <= _TOLERATED * len(graph.targets)
