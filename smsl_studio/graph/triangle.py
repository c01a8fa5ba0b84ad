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
"""Share of operations that may leave the lattice: a faulty one must not spoil the picture."""


def in_triangle(branch: StateBranch) -> dict[str, tuple[float, float]] | None:
    """The triangle with INITIAL's corner on top; None where the graph is no such figure."""
    graph = graph_of(branch)
    if len(graph) < 3 or not _leads_back(graph):
        return None
    near = _both_ways(graph)
    corners = _corners(branch, graph, near)
    if corners is None:
        return None
    apex, left, right = (distances(near, corner) for corner in corners)
    lattice = [(a, b - c) for a, b, c in zip(apex, left, right, strict=True)]
    if min(apex) < 0 or len(set(lattice)) < len(lattice) or not _fits(graph, lattice):
        return None
    return {
        name: (x * HALF_STEP, row * ROW)
        for name, (row, x) in zip(graph.names, lattice, strict=True)
    }


def _leads_back(graph: BranchGraph) -> bool:
    """Whether nearly every operation has one that leads back."""
    pairs = {(s, t) for s, t in zip(graph.sources, graph.targets, strict=True) if s != t}
    lone = sum((target, source) not in pairs for source, target in pairs)
    return bool(pairs) and lone <= _TOLERATED * len(pairs)


def _both_ways(graph: BranchGraph) -> list[list[int]]:
    """Neighbours by pairs of operations; by any operation where the pairs do not connect all.

    A single operation between two states may be a slip of the hand; it must not bend distances.
    """
    pairs = set(zip(graph.sources, graph.targets, strict=True))
    near = [
        [other for other in others if (state, other) in pairs and (other, state) in pairs]
        for state, others in enumerate(graph.neighbours)
    ]
    return near if min(distances(near, 0)) >= 0 else graph.neighbours


def _corners(
    branch: StateBranch, graph: BranchGraph, near: list[list[int]]
) -> tuple[int, int, int] | None:
    """Apex, left and right corner: the three states farthest from each other.

    The apex is INITIAL, or the corner nearest to it; ACTIVATING stands at the right where it is a
    corner, else the corner that is listed later.
    """
    initial = graph.index.get(branch.initial, 0)
    first = _farthest(distances(near, initial))
    from_first = distances(near, first)
    second = _farthest(from_first)
    both = [min(a, b) for a, b in zip(from_first, distances(near, second), strict=True)]
    third = _farthest(both)
    if len({first, second, third}) < 3:
        return None
    away = distances(near, initial)
    apex = min((first, second, third), key=lambda corner: (away[corner], corner))
    goal = graph.index.get(branch.activating)
    left, right = sorted({first, second, third} - {apex}, key=lambda c: (c == goal, c))
    return apex, left, right


def _farthest(steps: list[int]) -> int:
    return max(range(len(steps)), key=lambda i: (steps[i], -i))


def _fits(graph: BranchGraph, lattice: list[tuple[int, int]]) -> bool:
    """Whether the operations join neighbours on the lattice."""
    strays = 0
    for source, target in zip(graph.sources, graph.targets, strict=True):
        (row, x), (other_row, other_x) = lattice[source], lattice[target]
        if source != target and (other_row - row, other_x - x) not in _LATTICE:
            strays += 1
    return strays <= _TOLERATED * len(graph.targets)
