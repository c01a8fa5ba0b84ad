"""Large graphs drawn by distance: pivot-MDS, a little stress, then every node its own cell."""

from __future__ import annotations

from typing import Any

import numpy as np

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.shape import distances

Array = np.ndarray[Any, np.dtype[np.float64]]
EDGE = 190.0
"""Pixels between neighbours, on average."""
CELL_X, CELL_Y = 150.0, 90.0
_PIVOTS, _ROUNDS = 32, 8


def by_distance(branch: StateBranch) -> dict[str, tuple[float, float]]:
    """Places whose distances tell how many operations lie between; INITIAL left, ACTIVATING right.

    Deterministic: no random start, and the signs of the axes are fixed by INITIAL and ACTIVATING.
    """
    graph = graph_of(branch)
    initial = graph.index.get(branch.initial, 0)
    goal = graph.index.get(branch.activating, len(graph) - 1)
    pivots, steps = _pivot_distances(graph, initial)
    places = _pivot_mds(steps)
    places = _stress(places, pivots, steps)
    places = _turned(places * EDGE, initial, goal)
    cells = _own_cells(places)
    return {name: cells[i] for i, name in enumerate(graph.names)}


def _pivot_distances(graph: BranchGraph, first: int) -> tuple[list[int], Array]:
    """Pivots far from each other and the steps from every state to each; parts stand apart."""
    count = min(_PIVOTS, len(graph))
    nearest = np.full(len(graph), np.inf)
    pivots: list[int] = []
    rows: list[Array] = []
    state = first
    for _ in range(count):
        row = np.array(distances(graph.neighbours, state), dtype=np.float64)
        far = row.max() + 4.0
        row[row < 0] = far
        pivots.append(state)
        rows.append(row)
        nearest = np.minimum(nearest, row)
        state = int(nearest.argmax())
    return pivots, np.stack(rows, axis=1)


def _pivot_mds(steps: Array) -> Array:
    """The two main axes of the doubly centred squared distances to the pivots."""
    squares = steps**2
    centred = -0.5 * (
        squares
        - squares.mean(axis=0, keepdims=True)
        - squares.mean(axis=1, keepdims=True)
        + squares.mean()
    )
    values, vectors = np.linalg.eigh(centred.T @ centred)
    axes = vectors[:, np.argsort(values)[::-1][:2]]
    axes = axes * np.where(axes[np.abs(axes).argmax(axis=0), [0, 1]] < 0, -1.0, 1.0)
    places = centred @ axes
    lengths = np.linalg.norm(places[:, None, :] - places[None, :1, :], axis=2)[:, 0]
    wanted = np.abs(steps[:, 0])
    scale = (lengths @ wanted) / max(float(lengths @ lengths), 1e-9)
    return np.asarray(places * scale)


def _stress(places: Array, pivots: list[int], steps: Array) -> Array:
    """Every state moves to where its distances to the pivots are best met, near ones first."""
    weights = 1.0 / np.maximum(steps, 1.0) ** 2
    weights[np.asarray(pivots), np.arange(len(pivots))] = 0.0
    total = np.maximum(weights.sum(axis=1), 1e-9)[:, None]
    for _ in range(_ROUNDS):
        anchors = places[pivots]
        gap = places[:, None, :] - anchors[None, :, :]
        length = np.maximum(np.linalg.norm(gap, axis=2), 1e-6)
        wanted = anchors[None, :, :] + gap * (steps / length)[:, :, None]
        places = (weights[:, :, None] * wanted).sum(axis=1) / total
    return np.asarray(places)


def _turned(places: Array, initial: int, goal: int) -> Array:
    """Turned so that the way from INITIAL to ACTIVATING runs to the right, INITIAL above 0."""
    way = places[goal] - places[initial]
    length = float(np.hypot(*way))
    if length > 1e-6:
        cos, sin = way / length
        places = places @ np.array([[cos, -sin], [sin, cos]])
    if places[initial, 1] > places[:, 1].mean() + 1e-6:
        places = places * np.array([1.0, -1.0])
    return np.asarray(places - places.min(axis=0))


def _own_cells(places: Array) -> list[tuple[float, float]]:
    """Each state to a cell of its own, the nearest free one, so that no node covers another."""
    taken: set[tuple[int, int]] = set()
    next_ring: dict[tuple[int, int], int] = {}
    found: list[tuple[float, float]] = []
    for x, y in places.tolist():
        wanted = (round(x / CELL_X), round(y / CELL_Y))
        ring = next_ring.get(wanted, 0)
        cell = _free(wanted, ring, taken)
        while cell is None:
            ring += 1
            cell = _free(wanted, ring, taken)
        next_ring[wanted] = ring
        taken.add(cell)
        found.append((cell[0] * CELL_X, cell[1] * CELL_Y))
    return found


def _free(
    wanted: tuple[int, int], ring: int, taken: set[tuple[int, int]]
) -> tuple[int, int] | None:
    around = range(-ring, ring + 1)
    cells = (
        (wanted[0] + i, wanted[1] + j)
        for i in around
        for j in (around if abs(i) == ring else (-ring, ring) if ring else (0,))
    )
    return next((cell for cell in cells if cell not in taken), None)
