"""Self loops: concentric arcs at a corner of their node, with their labels stacked beside them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from smsl_studio.blueprint.edge_layout import LabelPlace
from smsl_studio.picture.label_candidates import OFF_ROOM
from smsl_studio.picture.labels import LabelPlaces, Rect, meet
from smsl_studio.picture.labels import by_hand as moved
from smsl_studio.picture.line_pieces import LinePieces
from smsl_studio.picture.shape import EdgeShape, NodeBox

STEP, ALONE, LEAST, CLOSER = 5.0, 14.0, 8.0, 2.0
"""The distance of two loops, the radius of a loop that is alone, the least radius, and by how much
each further loop makes the innermost one smaller (pixels of a mark). A loop is so large that a
person sees where it leads, and can grasp it beside its handles."""
CORNERS = ("bottom right", "top right", "bottom left", "top left", "right bottom", "right top")


class LoopNeighbours(NamedTuple):
    """What loops must spare besides lines and names: a mark below their node, and the title of a
    group above it (``roof``).
    """

    mark: Rect | None = None
    roof: bool = False


NOTHING_NEAR = LoopNeighbours()


@dataclass(frozen=True, slots=True)
class Corner:
    """The place of a node's loops: the centre of the arcs, the radius of the innermost and of the
    outermost, and the side of the labels.
    """

    name: str
    x: float
    y: float
    inner: float
    radius: float
    label_x: float
    label_y: float
    left: bool
    up: bool


def corner_of(name: str, box: NodeBox, count: int, unit: float) -> Corner:
    """Return the place of ``count`` loops at a named corner of a node."""
    alone = min(ALONE, LEAST + 0.22 * box.h / unit)  # a compact node has smaller ones
    inner = max(alone - CLOSER * (count - 1), LEAST) * unit
    radius = inner + STEP * (count - 1) * unit
    first, second = name.split()
    if first == "right":
        y = box.y + (box.h - radius - 3 * unit) * (1 if second == "bottom" else -1) * 0.35
        return Corner(
            name,
            box.x + box.w + 4 * unit,
            y,
            inner,
            radius,
            box.x + box.w + radius + 9 * unit,
            y,
            False,
            second == "top",
        )
    up, left = first == "top", second == "left"
    x = box.x + (box.w - radius - 4 * unit) * (-1 if left else 1)
    y = box.y + (box.h + 5 * unit) * (-1 if up else 1)
    label_x = x + (radius + 7 * unit) * (-1 if left else 1)
    # Several labels stand beside the arcs, not below them where another line may be nearer.
    rise = (8.0 if count == 1 else 2.0) * unit
    label_y = y + rise * (-1 if up else 1)
    return Corner(name, x, y, inner, radius, label_x, label_y, left, up)


def best_corner(
    box: NodeBox,
    sizes: list[tuple[float, float]],
    places: LabelPlaces,
    lines: LinePieces,
    near: LoopNeighbours = NOTHING_NEAR,
) -> Corner:
    """Return the corner of a node at which its loops and their labels cover the least.

    ``sizes`` has the size of each label. ``lines`` has the other lines of the node.
    """
    unit, mark = places.unit, near.mark
    best: tuple[float, Corner] | None = None
    for order, name in enumerate(CORNERS):
        # The title of a group stands above its states.
        if near.roof and (name.startswith("top") or (name[0] == "r" and len(sizes) > 3)):
            continue
        corner = corner_of(name, box, len(sizes), unit)
        rects = label_boxes(corner, sizes, unit)
        reach = corner.radius + unit
        around = (corner.x - reach, corner.y - reach, corner.x + reach, corner.y + reach)
        cost = order * 0.7 + sum(2.0 * n for n in lines.covered(-1, [around]))
        cost += sum(6.0 for rect in rects if not places.is_free(rect))
        cost += 0.0 if places.is_untaken(around) else 40.0
        cost += 6.0 if mark is not None and meet(around, mark) else 0.0
        cost += sum(float(n) for n in lines.covered(-1, rects))
        if best is None or cost < best[0]:
            best = cost, corner
    assert best is not None
    return best[1]


def placed(
    sizes: Mapping[int, tuple[float, float]],
    box: NodeBox,
    places: LabelPlaces,
    lines: LinePieces,
    by_hand: Mapping[int, LabelPlace | None],
    near: LoopNeighbours = NOTHING_NEAR,
) -> dict[int, tuple[EdgeShape, Rect | None]]:
    """Return the lines of a node's loops and the places of their labels. Mark these places as
    taken.

    ``sizes`` has the size of each loop's label. ``lines`` has the other lines of the node.
    ``by_hand`` has the labels that a person has moved. A label whose place beside the loops covers
    something gets None.
    """
    wanted, found = list(sizes.values()), dict[int, tuple[EdgeShape, Rect | None]]()
    corner = best_corner(box, wanted, places, lines, near)
    stacked = label_boxes(corner, wanted, places.unit)
    outer = arc(corner, box, len(sizes) - 1, places.unit)
    for rank, (edge, beside) in enumerate(zip(sizes, stacked, strict=True)):
        shape, at = arc(corner, box, rank, places.unit), by_hand.get(edge)
        rect = beside if at is None else moved(shape, at, sizes[edge])
        clear = at is not None or (places.is_free(rect) and not _is_crossed(places, outer, rect))
        free = sizes[edge][0] > 0.0 and clear
        found[edge] = shape, rect if free else None
        if free:
            places.take(rect)
    places.loops.extend(shape.bounds for shape, _ in found.values())
    return found


def _is_crossed(places: LabelPlaces, loop: EdgeShape, rect: Rect) -> bool:
    """Return whether a line of another state is as near to the place of a label as its loop is."""
    if any(meet(rect, other) for other in places.loops):
        return True
    room = np.array([max(OFF_ROOM * places.unit, away(loop, rect) + places.unit)])
    return not places.lines.clear([-1], np.array([[rect]]), room)[0, 0]


def away(loop: EdgeShape, rect: Rect) -> float:
    """Return how far a loop is from a rectangle (scene units)."""
    beside = np.maximum(np.maximum(rect[:2] - loop.points, loop.points - rect[2:]), 0.0)
    return float(np.hypot(beside[:, 0], beside[:, 1]).min())


def arc(corner: Corner, box: NodeBox, rank: int, unit: float) -> EdgeShape:
    """Return the arc number ``rank`` at a corner, from border to border. 0 is the innermost."""
    radius = corner.inner + STEP * rank * unit
    if corner.name.startswith("right"):
        gap = corner.x - (box.x + box.w)
        angles = np.linspace(-_half(gap, radius), _half(gap - 2.0 * unit, radius), 22)
        points = np.column_stack(
            [corner.x + radius * np.cos(angles), corner.y + radius * np.sin(angles)]
        )
        return EdgeShape(points, "loop")
    away = -1.0 if corner.up else 1.0
    gap = abs(corner.y - (box.y + box.h * away))
    # The arc runs from the inner side to the side of the corner, and its arrow ends on the border.
    angles = np.linspace(-_half(gap, radius), _half(gap - 2.0 * unit, radius), 22)
    inner = 1.0 if corner.left else -1.0
    points = np.column_stack(
        [
            corner.x - inner * radius * np.sin(angles),
            corner.y + away * radius * np.cos(angles),
        ]
    )
    return EdgeShape(points, "loop")


def _half(gap: float, radius: float) -> float:
    """Return half the angle (rad) of an arc that begins at a line ``gap`` from its centre."""
    return float(np.pi - np.arccos(min(gap / radius, 1.0)))


def label_boxes(
    corner: Corner, sizes: list[tuple[float, float]], unit: float
) -> list[tuple[float, float, float, float]]:
    """Return the places of the labels (left, top, right, bottom), stacked away from the node."""
    pitch = 17.0 * unit
    boxes = []
    for i, (width, height) in enumerate(sizes):
        if corner.name.startswith("right"):
            y = corner.y + (i - (len(sizes) - 1) / 2) * pitch
        else:
            y = corner.label_y + i * pitch * (-1 if corner.up else 1)
        left = corner.label_x - width if corner.left else corner.label_x
        boxes.append((left, y - height / 2, left + width, y + height / 2))
    return boxes
