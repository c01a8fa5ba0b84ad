"""Graphs that are a triangle seen from its three corners, such as the Tower of Hanoi.

In the graph of the Tower of Hanoi the distances of a state to the three corners (all disks on one
peg) tell it from every other state and behave like coordinates: the distance to the apex is its
row, the difference of the other two its place in the row. Nothing here knows about disks: any
graph whose operations all join neighbours on the triangular lattice found this way is drawn so.
"""

from __future__ import annotations

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.shape import distances

HALF_STEP, ROW = 67.0, 102.0
"""Pixels between places in a row (half of the distance of two nodes), and between rows."""
_LATTICE = {(0, 2), (0, -2), (1, 1), (1, -1), (-1, 1), (-1, -1)}
_TOLERATED = 0.1
"""Share of operations that may leave the lattice or have none that leads back."""
_TRIALS = 6


def in_triangle(branch: StateBranch) -> dict[str, tuple[float, float]] | None:
    """The triangle with INITIAL's corner on top; None where the graph is no such figure."""
    graph = graph_of(branch)
    if len(graph.targets) < len(graph) - 1:  # parts that no operation joins
        return None
    lone = _lone(graph)
    if len(graph) < 3 or len(lone) > _TOLERATED * len(graph.targets):
        return None
    # One operation that leads astray must not bend all distances: it has none that leads back.
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
    """Row and half steps of each state; None where two share a place or operations do not fit."""
    corners = _corners(branch, graph, near)
    if corners is None:
        return None
    apex, left, right = (distances(near, corner) for corner in corners)
    places = [(a, b - c) for a, b, c in zip(apex, left, right, strict=True)]
    whole = min(apex) >= 0 and len(set(places)) == len(places)
    return places if whole and _fits(graph, places) else None


def _lone(graph: BranchGraph) -> list[tuple[int, int]]:
    """The pairs of states that operations join in one direction only."""
    pairs = {(s, t) for s, t in zip(graph.sources, graph.targets, strict=True) if s != t}
    return sorted((source, target) for source, target in pairs if (target, source) not in pairs)


def _without(near: list[list[int]], pair: tuple[int, int] | None) -> list[list[int]]:
    if pair is None:
        return near
    fewer = list(near)
    for state, other in (pair, pair[::-1]):
        fewer[state] = [i for i in near[state] if i != other]
    return fewer


def _corners(
    branch: StateBranch, graph: BranchGraph, near: list[list[int]]
) -> tuple[int, int, int] | None:
    """Apex, left and right corner: the three states farthest from each other.

    The apex is INITIAL, or the corner nearest to it; ACTIVATING stands at the right where it is a
    corner, else the corner that is listed later.
    """
    initial = graph.index.get(branch.initial, 0)
    first = _farthest(near, distances(near, initial))
    from_first = distances(near, first)
    second = _farthest(near, from_first)
    both = [min(a, b) for a, b in zip(from_first, distances(near, second), strict=True)]
    third = _farthest(near, both)
    if len({first, second, third}) < 3:
        return None
    away = distances(near, initial)
    apex = min((first, second, third), key=lambda corner: (away[corner], corner))
    goal = graph.index.get(branch.activating)
    left, right = sorted({first, second, third} - {apex}, key=lambda c: (c == goal, c))
    return apex, left, right


def _farthest(near: list[list[int]], steps: list[int]) -> int:
    """The state with most steps; of several the one with fewest neighbours, as corners have."""
    return max(range(len(steps)), key=lambda i: (steps[i], -len(near[i]), -i))


def _fits(graph: BranchGraph, lattice: list[tuple[int, int]]) -> bool:
    """Whether the operations join neighbours on the lattice."""
    strays = 0
    for source, target in zip(graph.sources, graph.targets, strict=True):
        (row, x), (other_row, other_x) = lattice[source], lattice[target]
        if source != target and (other_row - row, other_x - x) not in _LATTICE:
            strays += 1
    return strays <= _TOLERATED * len(graph.targets)
