"""A layout of large graphs by distance: pivot MDS, some rounds of stress, then a free cell for each
node.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from operator import mul
from typing import Any

import numpy as np

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.shape import distances
from smsl_studio.stop import heed

Array = np.ndarray[Any, np.dtype[np.float64]]
Cell = tuple[int, int]
EDGE = 190.0
"""The mean distance between neighbours, in pixels."""
CELL_X, CELL_Y = 150.0, 90.0
_PIVOTS, _ROUNDS, _TURNS = 32, 8, 60
_EXACT, _FINE = 2.0**20, 2.0**16
"""Entries of matrices and of axes are rounded to 1 over these. Then a sum of a million products is
exact.
"""
BLOCK = 4
"""The side of a block, in cells. Each block keeps one cell for which it knows the full rings."""


def by_distance(branch: StateBranch) -> dict[str, tuple[float, float]]:
    """Return the place of each state (pixels). Distances tell how many operations lie between.

    INITIAL stands left of ACTIVATING. The result is deterministic: there is no random start, and
    INITIAL and ACTIVATING fix the signs of the axes.
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
    """Return pivots that are far from each other, and the steps from every state to each pivot.

    A state that no path joins with a pivot gets a distance larger than all others.
    """
    count = min(_PIVOTS, len(graph))
    nearest = np.full(len(graph), np.inf)
    pivots: list[int] = []
    rows: list[Array] = []
    state = first
    for _ in range(count):
        heed()
        row = np.array(distances(graph.neighbours, state), dtype=np.float64)
        far = row.max() + 4.0
        row[row < 0] = far
        pivots.append(state)
        rows.append(row)
        nearest = np.minimum(nearest, row)
        state = int(nearest.argmax())
    return pivots, np.stack(rows, axis=1)


def _pivot_mds(steps: Array) -> Array:
    """Return places on the two main axes of the doubly centred squared distances to the pivots.

    The matrices hold whole numbers so small that every sum is exact. So the result does not depend
    on the order in which a machine adds.
    """
    squares = steps**2
    centred = -0.5 * (
        squares
        - squares.mean(axis=0, keepdims=True)
        - squares.mean(axis=1, keepdims=True)
        + squares.mean()
    )
    largest = max(float(np.abs(centred).max()), 1e-9)
    centred = np.round(centred * (_EXACT / largest))
    axes = np.round(np.array(_main_axes((centred.T @ centred).tolist())).T * _FINE)
    axes = axes * np.where(axes[np.abs(axes).argmax(axis=0), [0, 1]] < 0, -1.0, 1.0)
    places = (centred @ axes) / _FINE
    lengths = _length(places - places[:1])
    wanted = np.abs(steps[:, 0])
    scale = math.fsum(lengths * wanted) / max(math.fsum(lengths**2), 1e-9)
    return np.asarray(places * scale)


def _main_axes(matrix: list[list[float]]) -> list[list[float]]:
    """Return the two main axes of a symmetric matrix, each of length 1, by power iteration with
    exact sums.
    """
    axes: list[list[float]] = []
    for number in range(2):
        axis = [1.0 if i == number else 1.0 / (i + 2 + number) for i in range(len(matrix))]
        for _ in range(_TURNS):
            for other in axes:
                along = math.fsum(map(mul, axis, other))
                axis = [a - along * b for a, b in zip(axis, other, strict=True)]
            axis = [math.fsum(map(mul, row, axis)) for row in matrix]
            size = math.sqrt(math.fsum(map(mul, axis, axis))) or 1.0
            axis = [a / size for a in axis]
        axes.append(axis)
    return axes


def _length(gap: Array) -> Array:
    """Return the length of each of some vectors, (..., 2)."""
    return np.asarray(np.sqrt(gap[..., 0] ** 2 + gap[..., 1] ** 2))


def _stress(places: Array, pivots: list[int], steps: Array) -> Array:
    """Return places after some rounds in which each state moves to fit its distances to the pivots.
    Near pivots count more.
    """
    weights = 1.0 / np.maximum(steps, 1.0) ** 2
    weights[np.asarray(pivots), np.arange(len(pivots))] = 0.0
    # Sums are made one by one, because numpy adds in an order that depends on the machine.
    total = np.maximum(sum(weights.T, np.zeros(len(steps))), 1e-9)[:, None]
    for _ in range(_ROUNDS):
        heed()
        moved = np.zeros_like(places)
        for number, pivot in enumerate(pivots):
            gap = places - places[pivot]
            share = steps[:, number] / np.maximum(_length(gap), 1e-6)
            moved += weights[:, number, None] * (places[pivot] + gap * share[:, None])
        places = moved / total
    return np.asarray(places)


def _turned(places: Array, initial: int, goal: int) -> Array:
    """Return the places turned so that ACTIVATING is to the right of INITIAL, and INITIAL in the
    upper half.
    """
    x, y = (places[goal] - places[initial]).tolist()
    length = math.sqrt(x * x + y * y)
    if length > 1e-6:
        cos, sin = x / length, y / length
        across, down = places[:, 0], places[:, 1]
        places = np.stack([across * cos + down * sin, down * cos - across * sin], axis=1)
    if 2.0 * places[initial, 1] > places[:, 1].min() + places[:, 1].max() + 1e-6:
        places = places * np.array([1.0, -1.0])
    return np.asarray(places - places.min(axis=0))


def _own_cells(places: Array) -> list[tuple[float, float]]:
    """Return for each state the centre of the nearest free cell (pixels), so that no nodes
    overlap.
    """
    taken: set[Cell] = set()
    full = _Full()
    found: list[tuple[float, float]] = []
    for x, y in places.tolist():
        heed()
        wanted = (round(x / CELL_X), round(y / CELL_Y))
        ring = full.around(wanted)
        cell = full.free(wanted, ring, taken)
        while cell is None:
            ring += 1
            cell = full.free(wanted, ring, taken)
        full.learn(wanted, ring)
        taken.add(cell)
        found.append((cell[0] * CELL_X, cell[1] * CELL_Y))
    return found


class _Full:
    """The rings around cells that are known to be full, so that no crowd is searched twice.

    If all cells within a radius of a cell are taken, those within a smaller radius of a cell near
    it are taken too.
    """

    def __init__(self) -> None:
        self._rings: dict[Cell, int] = {}
        self._widest: dict[Cell, tuple[Cell, int]] = {}
        self._walks: dict[Cell, tuple[int, Iterator[Cell]]] = {}

    def around(self, cell: Cell) -> int:
        """Return the first ring around a cell on which a cell may be free."""
        x, y = cell
        ring = self._rings.get(cell, 0)
        column, row = x // BLOCK, y // BLOCK
        for block in product((column - 1, column, column + 1), (row - 1, row, row + 1)):
            known = self._widest.get(block)
            if known is not None:
                (i, j), radius = known
                ring = max(ring, radius - max(abs(x - i), abs(y - j)))
        return ring

    def learn(self, cell: Cell, ring: int) -> None:
        """Note that all rings inside this one are full."""
        self._rings[cell] = ring
        block = cell[0] // BLOCK, cell[1] // BLOCK
        if ring > self._widest.get(block, (cell, -1))[1]:
            self._widest[block] = cell, ring

    def free(self, wanted: Cell, ring: int, taken: set[Cell]) -> Cell | None:
        """Return the first free cell on a ring, or None. A second search of a ring goes on where
        the first one ended.
        """
        last, walk = self._walks.get(wanted, (-1, iter(())))
        if last != ring:
            walk = _ring(wanted, ring)
            self._walks[wanted] = ring, walk
        return next((cell for cell in walk if cell not in taken), None)


def _ring(wanted: Cell, ring: int) -> Iterator[Cell]:
    around = range(-ring, ring + 1)
    for i in around:
        for j in around if abs(i) == ring else (-ring, ring) if ring else (0,):
            yield wanted[0] + i, wanted[1] + j
