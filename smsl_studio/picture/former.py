"""FormerLines: which lines and labels of a small picture still hold after an edit.

A line depends on the nodes at its ends and near it, a label on what else stands near its line. What
no change comes near is taken over, so that the picture is the same as one that is routed whole.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from smsl_studio.picture.curves import Between, LineStyle, is_outward
from smsl_studio.picture.labels import Rect, meet
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox, Point

REACH = 0.5
"""A way around nodes stays within this share of its length beside the straight way."""
NEAR = 16.0
"""Pixels around a line or a label in which something else can move it."""


@dataclass
class Routing:
    """What came of routing a picture, as it was before anybody dragged a state."""

    picture: Picture
    boxes: Floats
    middle: Point
    style: LineStyle
    shapes: dict[int, EdgeShape] = field(default_factory=dict)
    labels: dict[int, Rect | None] = field(default_factory=dict)
    sizes: dict[int, tuple[float, float]] = field(default_factory=dict)
    """The sizes that the labels were placed with."""
    clear: dict[tuple[int, int], bool] = field(default_factory=dict)
    """By pair of states whether the straight way between them meets no other node."""
    bent: set[tuple[int, int]] = field(default_factory=set)
    """The pairs whose lines lead around other nodes, or would if there were room."""


class FormerLines:
    """A routing before an edit, asked in the numbers of the picture after it.

    ``now`` is the routing that is being made. It is of use where the order of states and operations
    is the same (``fits``). Whatever turns out to be elsewhere than before is told by ``moved``.
    """

    def __init__(self, former: Routing, now: Routing) -> None:
        self._former, self._now = former, now
        before, after = former.picture, now.picture
        self._state = [before.index.get(name, -1) for name in after.names]
        self._edges = _matched(before, after)
        self._far: list[Rect] = []
        """Where something changed, with a margin."""
        self._same = [
            old >= 0 and bool((now.boxes[state] == former.boxes[old]).all())
            for state, old in enumerate(self._state)
        ]
        kept = {old for old, same in zip(self._state, self._same, strict=True) if same}
        self.moved(_rects(former.boxes, (s for s in range(len(before)) if s not in kept)))
        self.moved(_rects(now.boxes, (s for s, same in enumerate(self._same) if not same)))

    @property
    def fits(self) -> bool:
        """Whether what stands in both pictures stands in one order, at one size of marks."""
        if self._former.style != self._now.style:
            return False
        states = [old for old in self._state if old >= 0]
        edges = [old for old in self._edges if old >= 0]
        return states == sorted(states) and edges == sorted(edges)

    def moved(self, rects: Iterable[Rect | None]) -> None:
        """Something stands here now, or stands here no longer."""
        m = NEAR * self._now.style.unit
        self._far += [(r[0] - m, r[1] - m, r[2] + m, r[3] + m) for r in rects if r is not None]

    # Lines.

    def clear(self, pair: Between, source: NodeBox, target: NodeBox) -> bool | None:
        """Whether the straight way of a pair is clear; None where that has to be looked at."""
        if not self._untouched(pair, source, target, 0.0):
            return None
        return self._former.clear.get((self._state[pair.a], self._state[pair.b]))

    def pair(
        self, pair: Between, source: NodeBox, target: NodeBox
    ) -> tuple[dict[int, EdgeShape], bool] | None:
        """The lines of a pair, and whether they lead around nodes; None where they may change."""
        a, b = self._state[pair.a], self._state[pair.b]
        straight = self._former.clear.get((a, b), False)
        if not self._untouched(pair, source, target, 0.0 if straight else REACH):
            return None
        there, back = self._former.picture.between(a, b)
        edges = self._edges
        if tuple(edges[e] for e in pair.there) != there:
            return None
        if tuple(edges[e] for e in pair.back) != back:
            return None
        former, middle = self._former.middle, self._now.middle
        if former != middle and is_outward(source, target, former) != is_outward(
            source, target, middle
        ):
            return None
        shapes = self._former.shapes
        both = (*pair.there, *pair.back)
        if any(edges[e] not in shapes or shapes[edges[e]].way == "lane" for e in both):
            return None
        return {e: shapes[edges[e]] for e in both}, (a, b) in self._former.bent

    def shape(self, edge: int, shape: EdgeShape) -> EdgeShape:
        """The former line of an edge where it is the same, else the one that was made now."""
        found = self._former.shapes.get(self._edges[edge])
        return found if found is not None and found.is_like(shape) else shape

    def lines_known(self, shapes: dict[int, EdgeShape]) -> None:
        """All lines but loops are there: what is another than it was has moved."""
        former, kept = self._former, set()
        for edge, shape in shapes.items():
            old = self._edges[edge]
            if former.shapes.get(old) is shape:
                kept.add(old)
            else:
                self.moved([shape.bounds])
        kept.update(old for old in self._edges if old >= 0 and _is_loop(former.picture, old))
        for old, shape in former.shapes.items():
            if old not in kept:
                self.moved([shape.bounds, former.labels.get(old)])

    def _untouched(self, pair: Between, source: NodeBox, target: NodeBox, reach: float) -> bool:
        if not (self._same[pair.a] and self._same[pair.b]):
            return False
        aside = reach * max(abs(source.x - target.x), abs(source.y - target.y)) * 1.5
        return self._is_quiet((
            min(source.x, target.x) - aside, min(source.y, target.y) - aside,
            max(source.x, target.x) + aside, max(source.y, target.y) + aside,
        ))  # fmt: skip

    # Loops and labels.

    def has_loops(
        self, state: int, own: list[int], sizes: list[tuple[float, float]], box: NodeBox
    ) -> bool:
        """Whether the loops of a state and their labels stand where they stood."""
        former, old = self._former, [self._edges[e] for e in own]
        if not self._same[state] or -1 in old or len(own) != self._loop_count(state):
            return False
        if [former.sizes.get(o) for o in old] != sizes:
            return False
        if (box.y > former.middle[1]) != (box.y > self._now.middle[1]):
            return False
        aside = (20.0 + 30.0 * len(own)) * self._now.style.unit + max(wide for wide, _ in sizes)
        return self._is_quiet(
            (box.x - box.w - aside, box.y - box.h - aside,
             box.x + box.w + aside, box.y + box.h + aside)
        )  # fmt: skip

    def loop(self, edge: int) -> tuple[EdgeShape, Rect | None]:
        """A loop that stands where it stood, and the place of its label."""
        return self._former.shapes[self._edges[edge]], self.label(edge)

    def loops_moved(self, state: int, own: dict[int, tuple[EdgeShape, Rect | None]]) -> None:
        """The loops of a state were drawn anew: they stand elsewhere, or others do."""
        former = self._former
        old = {self._edges[edge] for edge in own}
        if self._state[state] >= 0:
            old |= set(_loops(former.picture, self._state[state]))
        for edge in old & former.shapes.keys():
            self.moved([former.shapes[edge].bounds, former.labels.get(edge)])
        for shape, rect in own.values():
            self.moved([shape.bounds, rect])

    def label(self, edge: int) -> Rect | None:
        """Where the label of an edge stood; None where it hid."""
        return self._former.labels[self._edges[edge]]

    def has_label(self, edge: int, shape: EdgeShape, size: tuple[float, float]) -> bool:
        """Whether the label of an edge stands where it stood."""
        old = self._edges[edge]
        if self._former.shapes.get(old) is not shape or self._former.sizes.get(old) != size:
            return False
        left, top, right, bottom = shape.bounds
        wide, high = size
        return self._is_quiet((left - wide, top - high, right + wide, bottom + high))

    def label_moved(self, edge: int, rect: Rect | None) -> None:
        """The label of an edge was placed anew."""
        before = self._former.labels.get(self._edges[edge])
        if before != rect:
            self.moved([before, rect])

    def _loop_count(self, state: int) -> int:
        return len(_loops(self._former.picture, self._state[state]))

    def _is_quiet(self, rect: Rect) -> bool:
        return not any(meet(rect, far) for far in self._far)


def _matched(before: Picture, after: Picture) -> list[int]:
    """By edge the number it had: the same operation of the same state to the same state."""
    names, sources = after.names, after.source.tolist()
    found = []
    for operation, source, target in zip(
        after.operations, sources, after.target.tolist(), strict=True
    ):
        old = before.numbered(names[source], operation)
        if old >= 0 and _name(before, int(before.target[old])) != _name(after, target):
            old = -1
        found.append(old)
    return found


def _name(picture: Picture, state: int) -> str:
    return picture.names[state] if state >= 0 else ""


def _loops(picture: Picture, state: int) -> list[int]:
    return [edge for edge in picture.edges_of(state) if _is_loop(picture, edge)]


def _is_loop(picture: Picture, edge: int) -> bool:
    return bool(picture.source[edge] == picture.target[edge])


def _rects(boxes: Floats, states: Iterable[int]) -> Iterator[Rect]:
    for state in states:
        x, y, w, h = boxes[state].tolist()
        yield x - w, y - h, x + w, y + h
