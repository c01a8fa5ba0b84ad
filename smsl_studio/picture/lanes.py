"""Lanes: rounded lines outside a row of nodes, for edges that would cross a node of it. Pure
geometry.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from smsl_studio.picture.curves import TIP_GAP
from smsl_studio.picture.detours import GAP
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.shape import EdgeShape, NodeBox, Point, rounded

FIRST, STEP, SLOT, RADIUS = 45.0, 20.0, 24.0, 8.0
"""Distances: from the row's border to the first lane, between lanes, between ends at one node, and
the radius of corners.
"""
LEAST = 6.0
"""With less room than this before the next row, there are no lanes."""


@dataclass(frozen=True, slots=True)
class Passing:
    """An edge that passes other nodes of its row: its number and its two states."""

    edge: int
    source: int
    target: int


def in_lanes(
    passing: Sequence[Passing],
    boxes: Sequence[NodeBox],
    middle: Point,
    unit: float,
    obstacles: Obstacles,
) -> dict[int, EdgeShape]:
    """Return the lines of edges that pass other nodes, in lanes outside their row.

    The lanes of rows above ``middle`` run above their rows, those of other rows below. The lanes of
    columns are left or right in the same way. Short edges get inner lanes, so that lanes do not
    cross. An edge is not in the result if its row has no room for lanes, or if its lane would come
    too near to a node.
    """
    shapes: dict[int, EdgeShape] = {}
    for key in sorted({_row(p, boxes) for p in passing}):
        row = [p for p in passing if _row(p, boxes) == key]
        lanes = _row_lanes(row, boxes, middle, unit, key[0] == "column")
        for p in row:
            lane = lanes.get(p.edge)
            if lane and all(obstacles.keep_clear([lane.points], GAP * unit, (p.source, p.target))):
                shapes[p.edge] = lane
    return shapes


def _row(p: Passing, boxes: Sequence[NodeBox]) -> tuple[str, float]:
    a, b = boxes[p.source], boxes[p.target]
    return ("row", round(a.y)) if abs(a.y - b.y) <= 1.0 else ("column", round(a.x))


def _row_lanes(
    row: Sequence[Passing], boxes: Sequence[NodeBox], middle: Point, unit: float, column: bool
) -> dict[int, EdgeShape]:
    """Return the lanes of one row. A column is a row with x and y exchanged."""
    box = {i: _turned(boxes[i], column) for p in row for i in (p.source, p.target)}
    centre = middle[0] if column else middle[1]
    line = next(iter(box.values())).y
    outward = -1.0 if line <= centre else 1.0
    levels = _levels(row, box)
    slots = _slots(row, box, levels, unit)
    half = max(b.h for b in box.values())
    # In a layout of several rows the lanes must not reach the next row.
    room = _room(line, half, outward, boxes, column)
    step = STEP * unit
    first = FIRST * unit
    deepest = max(levels.values())
    if room is not None and room < LEAST * unit:
        return {}
    if room is not None and first + deepest * step > room:
        squeeze = room / (first + deepest * step)
        first, step = first * squeeze, step * squeeze
    shapes: dict[int, EdgeShape] = {}
    for p in row:
        a, b = box[p.source], box[p.target]
        depth = half + first + step * levels[p.edge]
        start_x, end_x = slots[p.edge]
        corners = [
            (start_x, a.y + outward * (a.h + unit)),
            (start_x, line + outward * depth),
            (end_x, line + outward * depth),
            (end_x, b.y + outward * (b.h + TIP_GAP * unit)),
        ]
        points = rounded([(y, x) for x, y in corners] if column else corners, RADIUS * unit)
        shapes[p.edge] = EdgeShape(points, "lane")
    return shapes


def _turned(box: NodeBox, column: bool) -> NodeBox:
    return NodeBox(box.y, box.x, box.h, box.w, box.radius) if column else box


def _room(
    line: float, half: float, outward: float, boxes: Sequence[NodeBox], column: bool
) -> float | None:
    """Return the free depth between a row and the nodes of the next row, None if there is no next
    row.
    """
    at = np.array([(b.x, b.w) if column else (b.y, b.h) for b in boxes])
    beyond = (at[:, 0] - line) * outward
    others = beyond[beyond > half] - at[beyond > half, 1]
    return float(others.min() - half - 10.0) if len(others) else None


def _levels(row: Sequence[Passing], box: dict[int, NodeBox]) -> dict[int, int]:
    """Return the lane number of each edge: the nearest free lane, for short edges first."""
    spans: list[list[tuple[float, float]]] = []
    levels: dict[int, int] = {}

    def order(p: Passing) -> tuple[float, bool, int]:
        """Return the sort key: short edges first, then edges to the right, then by number."""
        a, b = box[p.source].x, box[p.target].x
        return round(abs(a - b)), a > b, p.edge

    for p in sorted(row, key=order):
        low, high = sorted((box[p.source].x, box[p.target].x))
        level = 0
        while level < len(spans) and any(low < b and a < high for a, b in spans[level]):
            level += 1
        if level == len(spans):
            spans.append([])
        spans[level].append((low, high))
        levels[p.edge] = level
    return levels


def _slots(
    row: Sequence[Passing], box: dict[int, NodeBox], levels: dict[int, int], unit: float
) -> dict[int, tuple[float, float]]:
    """Return where each edge leaves its source and reaches its target, side by side so that lanes
    nest.
    """
    ends: dict[int, list[tuple[float, int, bool]]] = {}
    for p in row:
        right = box[p.target].x > box[p.source].x
        for state, leaves, goes_right in ((p.source, True, right), (p.target, False, not right)):
            rank = float(levels[p.edge] + 1)
            # An edge to the right in an inner lane is nearest to the right border.
            ends.setdefault(state, []).append(
                (1 / rank if goes_right else -1 / rank, p.edge, leaves)
            )
    found: dict[tuple[int, bool], float] = {}
    for state, own in ends.items():
        own.sort()
        step = min(SLOT * unit, 2 * (box[state].w - 14.0 * unit) / max(len(own) - 1, 1))
        for i, (_, edge, leaves) in enumerate(own):
            found[edge, leaves] = box[state].x + (i - (len(own) - 1) / 2) * step
    return {p.edge: (found[p.edge, True], found[p.edge, False]) for p in row}
