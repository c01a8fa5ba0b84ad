"""Lanes: rounded lines outside a row of nodes, for edges that would cross a node of it. Pure
geometry.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from smsl_studio.picture.curves import TIP_GAP
from smsl_studio.picture.detours import GAP
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.shape import EdgeShape, NodeBox, rounded

FIRST, STEP, SLOT, RADIUS = 45.0, 20.0, 24.0, 8.0
"""Distances: from the row's border to the first lane, between lanes, between ends at one node, and
the radius of corners.
"""
LEAST, ROOM, AMPLE = 6.0, 10.0, 200.0
"""With less room than the first before the next row, there are no lanes. The second is the distance
that lanes keep from that row. A row that is farther away than the third from the last lane changes
nothing.
"""


@dataclass(frozen=True, slots=True)
class Passing:
    """An edge that passes other nodes of its row: its number and its two states."""

    edge: int
    source: int
    target: int


def in_lanes(
    passing: Sequence[Passing],
    boxes: Sequence[NodeBox],
    unit: float,
    obstacles: Obstacles,
) -> dict[int, EdgeShape]:
    """Return the lines of edges that pass other nodes, in lanes outside their row.

    Lanes run above their row, or below it if there is more room. The lanes of columns are left or
    right in the same way. Short edges get inner lanes, so that lanes do not cross. An edge is not
    in the result if it has no room for lanes, or if its lane would come too near to a node. Lanes
    depend only on those beside them and on the nodes that they pass.
    """
    shapes: dict[int, EdgeShape] = {}
    for key in sorted({_row(p, boxes) for p in passing}):
        column = key[0] == "column"
        for group in _groups([p for p in passing if _row(p, boxes) == key], boxes, column):
            lanes = _lanes(group, boxes, unit, column)
            for p in group:
                lane, ends = lanes.get(p.edge), (p.source, p.target)
                if lane and all(obstacles.keep_clear([lane.points], GAP * unit, ends)):
                    shapes[p.edge] = lane
    return shapes


def _row(p: Passing, boxes: Sequence[NodeBox]) -> tuple[str, float]:
    a, b = boxes[p.source], boxes[p.target]
    return ("row", round(a.y)) if abs(a.y - b.y) <= 1.0 else ("column", round(a.x))


def _groups(
    row: Sequence[Passing], boxes: Sequence[NodeBox], column: bool
) -> Iterator[list[Passing]]:
    """Yield the edges of a row that pass the same nodes or meet at a node."""

    def span(p: Passing) -> tuple[float, float]:
        low, high = sorted(_turned(boxes[i], column).x for i in (p.source, p.target))
        return low, high

    group: list[Passing] = []
    end = 0.0
    for p in sorted(row, key=span):
        low, high = span(p)
        if group and low > end:
            yield group
            group = []
        end = max(end, high) if group else high
        group.append(p)
    if group:
        yield group


def _lanes(
    group: Sequence[Passing], boxes: Sequence[NodeBox], unit: float, column: bool
) -> dict[int, EdgeShape]:
    """Return the lanes of a group. A column is a row with x and y exchanged."""
    box = {i: _turned(boxes[i], column) for p in group for i in (p.source, p.target)}
    line = next(iter(box.values())).y
    levels = _levels(group, box)
    slots = _slots(group, box, levels, unit)
    half = max(b.h for b in box.values())
    first, step = FIRST * unit, STEP * unit
    wanted = first + max(levels.values()) * step
    # In a layout of several rows the lanes must not reach the next row.
    above, below = _rooms(box, wanted + AMPLE * unit, boxes, unit, column)
    outward, room = (-1.0, above) if above >= below else (1.0, below)
    if room < LEAST * unit:
        return {}
    squeeze = min(1.0, room / wanted)
    first, step = first * squeeze, step * squeeze
    shapes: dict[int, EdgeShape] = {}
    for p in group:
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


def _rooms(
    row: dict[int, NodeBox],
    most: float,
    boxes: Sequence[NodeBox],
    unit: float,
    column: bool,
) -> tuple[float, float]:
    """Return the free depth above and below some nodes of a row, to the next node beside them. It
    is never told to be more than ``most``.
    """
    line, half = next(iter(row.values())).y, max(b.h for b in row.values())
    low, high = min(b.x - b.w for b in row.values()), max(b.x + b.w for b in row.values())
    found = [most, most]
    for one in boxes:
        other = _turned(one, column)
        if low < other.x + other.w and other.x - other.w < high:
            away = other.y - line
            if abs(away) > half:
                side = int(away > 0.0)
                found[side] = min(found[side], abs(away) - other.h - half - ROOM * unit)
    return found[0], found[1]


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
