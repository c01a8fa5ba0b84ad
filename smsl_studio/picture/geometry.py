"""Geometry: where every edge and label of a picture lies, for one layout at one size of marks.

Small pictures are routed whole (lanes, ways around nodes, labels with regard to all lines). Large
ones are routed edge by edge when one comes into view.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from smsl_studio.picture import labels, loops
from smsl_studio.picture.curves import Between, LineStyle, around, in_row, is_clear, joined
from smsl_studio.picture.lanes import Passing, in_lanes
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point

MOST_AROUND = 60
"""At most so many pairs of states get a way around nodes; in a denser picture it shows nothing."""
MOST_AT_ONCE = 20
"""In a large picture, where two states share more edges than this, each is routed when needed."""
LabelSize = Callable[[int], tuple[float, float]]
"""The size of an edge's label in scene units; (0, 0) for none."""


class Geometry:
    """Shapes and label places by edge number; ``boxes`` is an (n, 4) array of centre, half size."""

    def __init__(
        self, picture: Picture, boxes: Floats, style: LineStyle, label_size: LabelSize
    ) -> None:
        self.picture, self.boxes, self.style = picture, boxes, style
        self._label_size = label_size
        self._shapes: dict[int, EdgeShape] = {}
        self._labels: dict[int, labels.Rect | None] = {}
        self._box: dict[int, NodeBox] = {}
        self._pairs: dict[tuple[int, int], Between] = {}
        self._middle = self._centre()
        self._places: labels.LabelPlaces | None = None
        self._lines = labels.LinePieces({})
        self.small = picture.small
        self._around = 0
        if self.small:
            self._route_all()

    def shape(self, edge: int) -> EdgeShape:
        """The line of an edge."""
        found = self._shapes.get(edge)
        if found is None:
            self._route(edge)
            found = self._shapes[edge]
        return found

    def label(self, edge: int) -> labels.Rect | None:
        """The place of an edge's label (left, top, right, bottom); None while it hides."""
        if edge not in self._labels:
            self._place(edge)
        return self._labels[edge]

    def fallback(self, edge: int) -> labels.Rect:
        """Where a hidden label is shown while its edge is hovered or lit: on its middle."""
        shape = self.shape(edge)
        w, h = self._label_size(edge)
        x, y = shape.at(shape.length / 2)
        return x - w / 2, y - h / 2, x + w / 2, y + h / 2

    def covered(self, edge: int, rects: Sequence[labels.Rect]) -> list[int]:
        """How many pieces of other lines each rectangle covers; 0 in a large picture."""
        return self._lines.covered(edge, rects)

    def forget(self, states: Iterable[int]) -> list[int]:
        """Drop the lines at states that moved; returns the edges concerned.

        Used while states are dragged: all else stays as it is until they are let go.
        """
        concerned: dict[int, None] = {}
        for state in states:
            self._box.pop(state, None)
            concerned.update(dict.fromkeys(self.picture.edges_of(state)))
        for edge in concerned:
            self._shapes.pop(edge, None)
            self._labels.pop(edge, None)
        return list(concerned)

    def box(self, state: int) -> NodeBox:
        """The box of a state, with its rounded corners."""
        found = self._box.get(state)
        if found is None:
            x, y, w, h = self.boxes[state].tolist()
            radius = min((6.0 if self.style.compact else 8.0) * self.style.unit, h)
            found = self._box[state] = NodeBox(x, y, w, h, radius)
        return found

    def _centre(self) -> Point:
        if not len(self.boxes):
            return 0.0, 0.0
        low, high = self.boxes[:, :2].min(axis=0), self.boxes[:, :2].max(axis=0)
        return float(low[0] + high[0]) / 2, float(low[1] + high[1]) / 2

    def _outward(self, a: int, b: int) -> Point:
        first, second = self.box(a), self.box(b)
        x, y = (first.x + second.x) / 2, (first.y + second.y) / 2
        return x - self._middle[0], y - self._middle[1]

    # One edge at a time

    def _route(self, edge: int) -> None:
        a, b = int(self.picture.source[edge]), int(self.picture.target[edge])
        if b < 0:
            self._shapes[edge] = self._stub(a, edge)
        elif a == b:
            self._route_loops(a)
        else:
            pair = self._pair(a, b)
            only = edge if len(pair) > MOST_AT_ONCE and not self.small else None
            self._shapes |= self._pair_shapes(pair, only)

    def _pair(self, a: int, b: int) -> Between:
        key = (min(a, b), max(a, b))
        found = self._pairs.get(key)
        if found is None:
            found = self._pairs[key] = Between(*key, *self.picture.between(*key))
        return found

    def _pair_shapes(self, pair: Between, only: int | None) -> dict[int, EdgeShape]:
        source, target = self.box(pair.a), self.box(pair.b)
        outward = self._outward(pair.a, pair.b)
        if self.small and self._around < MOST_AROUND and not self._clear(pair):
            self._around += 1
            return around(pair, source, target, self.style, self.boxes, outward)
        return joined(pair, source, target, self.style, outward, only=only)

    def _clear(self, pair: Between) -> bool:
        ends = (pair.a, pair.b)
        gap = 6.0 * self.style.unit
        return is_clear(self.box(pair.a), self.box(pair.b), self.boxes, ends, gap)

    def _stub(self, state: int, edge: int) -> EdgeShape:
        """The line of an edge whose target is missing: a short arrow to nowhere."""
        box, unit = self.box(state), self.style.unit
        own = [e for e in self.picture.edges_of(state) if self.picture.target[e] < 0]
        x = box.x + (own.index(edge) - (len(own) - 1) / 2) * 18.0 * unit
        y = box.y + box.h
        return EdgeShape(np.array([[x, y + unit], [x, y + 40.0 * unit]]), "stub", 1)

    # All edges of a small picture

    def _route_all(self) -> None:
        passing: list[Passing] = []
        looping: dict[int, None] = {}
        for edge, (a, b) in enumerate(
            zip(self.picture.source.tolist(), self.picture.target.tolist(), strict=True)
        ):
            if edge in self._shapes:
                continue
            if a == b:
                looping[a] = None
            elif b >= 0 and in_row(self.box(a), self.box(b)) and not self._clear(self._pair(a, b)):
                passing.append(Passing(edge, a, b))
            else:
                self._route(edge)
        boxes = [self.box(i) for i in range(len(self.picture))]
        self._shapes |= in_lanes(passing, boxes, self._middle, self.style.unit)
        for one in passing:
            if one.edge not in self._shapes:
                self._route(one.edge)
        self._lines = labels.LinePieces(self._shapes)
        self._places = labels.LabelPlaces(self.boxes, self.style.unit)
        for state in looping:
            self._route_loops(state)
        self._lines = labels.LinePieces(self._shapes)
        for edge in sorted(self._shapes, key=self._label_order):
            self._place(edge)

    def _label_order(self, edge: int) -> tuple[int, float, int]:
        """Lines with the least choice come first."""
        shape = self._shapes[edge]
        ways = {"loop": 0, "line": 1, "curve": 2, "stub": 3, "lane": 4}
        return ways[shape.way], round(shape.length), edge

    def _place(self, edge: int) -> None:
        if edge in self._labels:
            return
        size = self._label_size(edge)
        shape = self.shape(edge)
        if edge in self._labels or size[0] <= 0.0:
            self._labels.setdefault(edge, None)
            return
        places = self._places
        if places is None:
            places = self._places = self._fresh_places()
        compact = self.style.compact
        self._labels[edge] = labels.place(edge, shape, size, places, self._lines, compact)

    def _fresh_places(self) -> labels.LabelPlaces:
        places = labels.LabelPlaces(self.boxes, self.style.unit)
        for rect in self._labels.values():
            if rect is not None:
                places.take(rect)
        return places

    def _route_loops(self, state: int) -> None:
        """The self loops of a state, at the corner where they and their labels cover least."""
        picture, unit = self.picture, self.style.unit
        at_state = picture.edges_of(state)
        own = [e for e in at_state if picture.source[e] == picture.target[e] == state]
        box = self.box(state)
        places = self._places or self._fresh_places()
        sizes = [self._label_size(e) for e in own]
        names = loops.CORNERS
        if box.y > self._middle[1]:
            names = ("top right", "bottom right", *names[2:])
        best: tuple[float, loops.Corner] | None = None
        for order, name in enumerate(names):
            corner = loops.corner_of(name, box, len(own), unit)
            rects = loops.label_boxes(corner, sizes, unit)
            reach = corner.radius + unit
            around_ = (corner.x - reach, corner.y - reach, corner.x + reach, corner.y + reach)
            cost = order * 0.7 + sum(2.0 * n for n in self._lines.covered(-1, [around_]))
            cost += sum(6.0 for rect in rects if not places.is_free(rect))
            cost += sum(float(n) for n in self._lines.covered(-1, rects))
            if best is None or cost < best[0]:
                best = cost, corner
        assert best is not None
        corner = best[1]
        for rank, edge in enumerate(own):
            self._shapes[edge] = loops.arc(corner, box, rank, unit)
        for edge, size, rect in zip(
            own, sizes, loops.label_boxes(corner, sizes, unit), strict=True
        ):
            free = size[0] > 0.0 and places.is_free(rect)
            self._labels[edge] = rect if free else None
            if free:
                places.take(rect)
