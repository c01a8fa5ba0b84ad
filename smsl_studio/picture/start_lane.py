"""The lane of operations back to the start: below or above all nodes, and to the initial state.

Pure geometry. Each way leads from its state straight or beside it to the lane, along the lane, and
from there to the initial state. No way meets a node.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from smsl_studio.picture.curves import TIP_GAP
from smsl_studio.picture.detours import GAP
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point, rounded

APART, LINE_GAP, RADIUS = 56.0, 18.0, 8.0
"""The distances of the lane from nodes and from other lines, and the radius of its corners."""
ASIDE, STEP, FARTHEST = 14.0, 12.0, 260.0
"""How far from a node a way beside it turns, the distance between the places that are tried for it,
and how far from the middle of the node they are (pixels of a mark)."""
INSET = 12.0
"""The least distance of an end from the corner of its node."""
Bounds = tuple[float, float, float, float]


class LaneNodes(NamedTuple):
    """The nodes of a drawing: the centres and half sizes of all, (n, 4), the box of each by its
    number, the same as obstacles, and the number of scene units in a pixel of a mark.
    """

    boxes: Floats
    box: Callable[[int], NodeBox]
    obstacles: Obstacles
    unit: float


def ways_back(
    picture: Picture, edges: Sequence[int], nodes: LaneNodes, others: Mapping[int, EdgeShape]
) -> dict[int, EdgeShape]:
    """Return the ways of some operations to the initial state by the lane, without those that have
    none. The lane itself begins at the state that is farthest to the side, among those with a way.

    ``others`` are the lines of the drawing, from which the lane keeps away.
    """
    if not edges:
        return {}
    bundles, start = picture.bundles, int(picture.target[edges[0]])
    lane, middle = StartLane(nodes, start), nodes.box(start).x
    if not lane.settle(one.bounds for edge, one in others.items() if edge not in bundles.back):
        return {}
    found: dict[int, EdgeShape] = {}
    for edge in edges:
        # The lane stays where it is when one of its operations is drawn alone.
        own = bundles.back if edge == bundles.lane else (edge,)
        states = dict.fromkeys(picture.source[list(own)].tolist())
        far = sorted(states, key=lambda state: -abs(nodes.box(state).x - middle))
        way = next(filter(None, map(lane.way, far)), None)
        if way is not None:
            found[edge] = way
    return found


class StartLane:
    """The lane on one side of a drawing, with the ways of all states to the initial state."""

    def __init__(self, nodes: LaneNodes, start: int) -> None:
        """``start`` is the number of the initial state."""
        self._nodes, self._unit, self._number = nodes, nodes.unit, start
        self._start = nodes.box(start)
        self._outward, self._y = 1.0, 0.0
        self._entry: list[Point] | None = None

    def settle(self, lines: Iterable[Bounds]) -> bool:
        """Find the lane: below the drawing, else above it. Returns whether there is one.

        ``lines`` are the bounds of all other lines.
        """
        others, boxes, unit = list(lines), self._nodes.boxes, self._unit
        low = max(boxes[:, 1] + boxes[:, 3]) + APART * unit
        high = min(boxes[:, 1] - boxes[:, 3]) - APART * unit
        low = max([low, *(one[3] + LINE_GAP * unit for one in others)])
        high = min([high, *(one[1] - LINE_GAP * unit for one in others)])
        for self._outward, self._y in ((1.0, float(low)), (-1.0, float(high))):
            self._entry = self._drop(self._number, 0.0)
            if self._entry is not None:
                return True
        return False

    def way(self, state: int) -> EdgeShape | None:
        """Return the way from a state, by its number, to the initial state; None if nodes are in
        the way.
        """
        box = self._nodes.box(state)
        leave = self._drop(state, box.w * 0.25 * (1.0 if box.x < self._start.x else -1.0))
        if leave is None or self._entry is None:
            return None
        *inside, last = reversed(self._entry)
        tip = last[0], last[1] + self._outward * TIP_GAP * self._unit
        return EdgeShape(rounded([*leave, *inside, tip], RADIUS * self._unit), "lane")

    def _drop(self, state: int, first: float) -> list[Point] | None:
        """Return the shortest free way from the border of a node to the lane, None for none.

        ``first`` is the distance from the middle of the node that is tried first.
        """
        tried = list(self._drops(self._nodes.box(state), first))
        lines = [rounded(corners, RADIUS * self._unit) for corners in tried]
        free = self._nodes.obstacles.keep_clear(lines, GAP * self._unit, (state,))
        return next((corners for corners, ok in zip(tried, free, strict=True) if ok), None)

    def _drops(self, box: NodeBox, first: float) -> Iterator[list[Point]]:
        unit, outward = self._unit, self._outward
        edge, half = box.y + outward * box.h, max(box.w - INSET * unit, 0.0)
        turn = edge + outward * ASIDE * unit
        for step in range(int(FARTHEST / STEP) + 1):
            for side in (1.0, -1.0)[: 2 if step else 1]:
                x = box.x + first + side * step * STEP * unit
                end = min(max(x, box.x - half), box.x + half)
                if abs(end - x) < 1e-9:
                    yield [(x, edge), (x, self._y)]
                else:
                    yield [(end, edge), (end, turn), (x, turn), (x, self._y)]
