"""Labels: the place of each label on its line, so that it covers no node and no other label.

A label slides along its edge to a free place. Without one it is hidden until the edge is hovered,
selected or lit. Pure geometry.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from smsl_studio.blueprint.edge_layout import LabelPlace
from smsl_studio.picture.shape import EdgeShape, Floats, Point

Rect = tuple[float, float, float, float]
"""Left, top, right, bottom."""
SHARES = (0.5, 0.43, 0.57, 0.36, 0.64, 0.29, 0.71, 0.22, 0.78)
EARLY_SHARES = (0.4, 0.34, 0.46, 0.28, 0.52, 0.58, 0.22, 0.64, 0.7)
"""Compact edges come in opposite pairs, so labels near the start do not meet."""
LANE_SHARES = (0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.2, 0.8)
BESIDE_GAP = 6.0


def meet(a: Rect, b: Rect) -> bool:
    """Return whether two rectangles overlap."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


class LabelPlaces:
    """The places that are taken, in a grid of cells. No label covers a node or another label.

    ``boxes`` has the nodes, an (n, 4) array of centres and half sizes. They are sorted into cells
    with numpy, because a loop over thousands of nodes is slow.
    """

    def __init__(self, boxes: Floats, unit: float) -> None:
        self.unit = unit
        self._cell = 96.0 * unit
        if len(boxes):
            self._cell = max(self._cell, float(boxes[:, 2:].max()) * 2.0 + 4.0 * unit)
        self._cells: dict[tuple[int, int], list[Rect]] = {}
        margin = 2.0 * unit
        self._nodes = np.hstack(
            [boxes[:, :2] - boxes[:, 2:] - margin, boxes[:, :2] + boxes[:, 2:] + margin]
        )
        at = np.floor(boxes[:, :2] / self._cell).astype(np.int64)
        key = at[:, 0] * 1_000_003 + at[:, 1]
        order = np.argsort(key, kind="stable")
        sorted_ = key[order]
        starts = np.nonzero(np.diff(sorted_, prepend=sorted_[:1] - 1))[0]
        stops = np.append(starts[1:], len(order))[: len(starts)]
        cells = zip(sorted_[starts].tolist(), starts.tolist(), stops.tolist(), strict=True)
        self._rows = {k: order[i:j] for k, i, j in cells}

    def take(self, rect: Rect, margin: float = 1.0) -> None:
        """Keep a rectangle free of labels from now on."""
        m = margin * self.unit
        wide = (rect[0] - m, rect[1] - m, rect[2] + m, rect[3] + m)
        for cell in self._over(wide):
            self._cells.setdefault(cell, []).append(wide)

    def is_free(self, rect: Rect) -> bool:
        """Return whether a rectangle covers no node and no taken place."""
        for cell in self._over(rect):
            if any(meet(rect, other) for other in self._cells.get(cell, ())):
                return False
        return not self._covers_node(rect)

    def _covers_node(self, rect: Rect) -> bool:
        """Return whether a rectangle covers a node. A node reaches at most half a cell beyond the
        cell of its centre, so only near cells are searched.
        """
        left, top, right, bottom = rect
        half = self._cell / 2
        for x, y in self._over((left - half, top - half, right + half, bottom + half)):
            rows = self._rows.get(x * 1_000_003 + y)
            if rows is None:
                continue
            if any(meet(rect, other) for other in self._nodes[rows].tolist()):
                return True
        return False

    def _over(self, rect: Rect) -> list[tuple[int, int]]:
        left, top, right, bottom = (int(v // self._cell) for v in rect)
        return [(x, y) for x in range(left, right + 1) for y in range(top, bottom + 1)]


class LinePieces:
    """The straight pieces of all lines in one array, to count the lines that a label covers."""

    def __init__(self, shapes: dict[int, EdgeShape]) -> None:
        pieces = [shape.pieces for shape in shapes.values()]
        self._pieces = np.vstack(pieces) if pieces else np.zeros((0, 4))
        self._owners = np.repeat(np.array(list(shapes), dtype=int), [len(p) for p in pieces])

    def covered(self, edge: int, rects: Sequence[Rect]) -> list[int]:
        """Return for each rectangle how many pieces of other lines than ``edge`` it covers."""
        if not len(self._pieces):
            return [0] * len(rects)
        box = np.array(rects)
        a, b = self._pieces[:, :2], self._pieces[:, 2:]
        low, high = np.minimum(a, b), np.maximum(a, b)
        near = (
            (high[:, 0] > box[:, 0].min())
            & (low[:, 0] < box[:, 2].max())
            & (high[:, 1] > box[:, 1].min())
            & (low[:, 1] < box[:, 3].max())
            & (self._owners != edge)
        )
        if not near.any():
            return [0] * len(rects)
        start = a[near][None]
        step = b[near][None] - start
        step = np.where(np.abs(step) < 1e-9, 1e-9, step)
        t1 = (box[:, None, :2] - start) / step
        t2 = (box[:, None, 2:] - start) / step
        enter = np.minimum(t1, t2).max(axis=2)
        leave = np.maximum(t1, t2).min(axis=2)
        hits = (enter < leave) & (leave > 0.0) & (enter < 1.0)
        counts: list[int] = hits.sum(axis=1).tolist()
        return counts


def place(
    edge: int,
    shape: EdgeShape,
    size: tuple[float, float],
    places: LabelPlaces,
    lines: LinePieces,
    compact: bool,
) -> Rect | None:
    """Take and return the best free place of one label, or None if there is none."""
    best: tuple[float, Rect] | None = None
    unit = places.unit
    for cost, make in _candidates(shape, size, unit, compact):
        if best is not None and cost >= best[0]:
            break
        rect = make()
        if rect is not None and places.is_free(rect):
            near = lines.covered(edge, [rect, _wider(rect, 4.0 * unit)])
            total = cost + near[0] * 0.6 + min(near[1], 1) * 0.3
            if best is None or total < best[0]:
                best = total, rect
    if best is None:
        return None
    places.take(best[1])
    return best[1]


def _wider(rect: Rect, margin: float) -> Rect:
    left, top, right, bottom = rect
    return left - margin, top - margin, right + margin, bottom + margin


Candidate = tuple[float, Callable[[], "Rect | None"]]


def _candidates(
    shape: EdgeShape, size: tuple[float, float], unit: float, compact: bool
) -> list[Candidate]:
    """Return possible places with their costs: on the line, from its middle outwards, and beside a
    steep line.

    Each place is a function that computes it, because usually the first one is free.
    """
    found: list[Candidate] = []
    low, high = 0.0, shape.length
    if shape.way == "lane":
        low, high = _long_side(shape)
    beside = bool(shape.side) and not compact
    shares = LANE_SHARES if shape.way == "lane" else EARLY_SHARES if compact else SHARES

    def on_line(along: float) -> Rect | None:
        """Return the rectangle of the label on the line, or None if it would hide too much of the
        line.
        """
        fits = _fits(shape, along, size, unit)
        return _centred(shape.at(along), size) if fits else None

    for order, share in enumerate(shares):
        along = low + (high - low) * share
        cost = order * 0.12
        if beside:
            found.append((cost, partial(_beside, shape, along, size, unit)))
        found.append((cost + (1.5 if beside else 0.0), partial(on_line, along)))
        if shape.way in ("curve", "bent", "detour"):
            found.append((cost + 2.2, partial(outside, shape, along, size, unit)))
    if shape.way in ("line", "curve", "bent", "detour"):
        # A label that hardly fits stands in the middle of the line without its arrowhead.
        found.append((0.3, partial(on_line, (shape.length - 8.0 * unit) / 2)))
    found.sort(key=lambda candidate: candidate[0])
    return found


def _fits(shape: EdgeShape, along: float, size: tuple[float, float], unit: float) -> bool:
    """Return whether enough of the line stays visible, and all of its arrowhead."""
    dx, dy = shape.direction(along)
    # The words are narrower than the label, by 4 pixels on each side.
    half = size[0] / 2 - 3.0 * unit
    reach = min(half / max(abs(dx), 1e-6), size[1] / 2 / max(abs(dy), 1e-6))
    return along - reach >= -2.0 * unit and along + reach <= shape.length - 7.0 * unit


def by_hand(shape: EdgeShape, at: LabelPlace, size: tuple[float, float]) -> Rect:
    """Return the rectangle of a label that somebody has moved."""
    share, dx, dy = at
    x, y = shape.at(shape.length * share)
    return _centred((x + dx, y + dy), size)


def outside(
    shape: EdgeShape, along: float, size: tuple[float, float], gap: float, side: int = 1
) -> Rect:
    """Return a rectangle beside a line, with a gap, on its outer side (``side`` 1) or inner side
    (-1).
    """
    x, y = shape.at(along)
    dx, dy = shape.direction(along)
    nx, ny = -dy * shape.out * side, dx * shape.out * side
    reach = abs(nx) * size[0] / 2 + abs(ny) * size[1] / 2 + gap
    return _centred((x + nx * reach, y + ny * reach), size)


def _centred(point: Point, size: tuple[float, float]) -> Rect:
    x, y = point
    w, h = size[0] / 2, size[1] / 2
    return x - w, y - h, x + w, y + h


def _beside(shape: EdgeShape, along: float, size: tuple[float, float], unit: float) -> Rect:
    """Return a rectangle beside a steep line, on the side away from the next line."""
    x, y = shape.at(along)
    _, dy = shape.direction(along)
    # With y down, (-dy, dx) points to the right of the direction (dx, dy).
    to_right = (-dy if shape.side > 0 else dy) > 0
    gap = BESIDE_GAP * unit - 4.0 * unit
    left = x + gap if to_right else x - gap - size[0]
    return left, y - size[1] / 2, left + size[0], y + size[1] / 2


def _long_side(shape: EdgeShape) -> tuple[float, float]:
    """Return the lengths between which the middle stretch of a lane runs, without its corners."""
    steps = np.diff(shape.lengths)
    i = int(steps.argmax())
    inner = steps[1:-1]
    if len(inner):
        i = 1 + int(inner.argmax())
    return float(shape.lengths[i]), float(shape.lengths[i + 1])
