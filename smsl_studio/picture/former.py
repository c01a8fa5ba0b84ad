"""FormerLines: the lines and labels of a small picture that an edit does not change.

A line depends on the nodes at its ends and near it. A label depends on everything near its line. If
no change is near, the line or label is kept. The picture is then the same as one that is routed as
a whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

import numpy as np

from smsl_studio.picture.curves import Between, breadth
from smsl_studio.picture.detours import GAP, most_passed
from smsl_studio.picture.held_routes import HeldPair, Routing
from smsl_studio.picture.label_candidates import FARTHEST
from smsl_studio.picture.label_rooms import LabelRooms, meeting
from smsl_studio.picture.labels import AsideRect, Rect, meet
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox

NEAR = 16.0
"""A change within so many pixels of a line or label can move it."""


class FormerLines:
    """The routing before an edit, for questions with the numbers of the picture after the edit.

    ``now`` is the new routing. The old one is useful only if states and operations have kept their
    order (``fits``). ``moved`` notes each place at which something has changed.
    """

    def __init__(self, former: Routing, now: Routing) -> None:
        self._former, self._now = former, now
        before, after = former.picture, now.picture
        self._state = [before.index.get(name, -1) for name in after.names]
        self._edges = _matched(former, now)
        self._regrouped = before.grouped ^ after.grouped
        self._far: list[Rect] = []
        """The places at which something changed, each with a margin."""
        self._labels = LabelRooms({}, {}, (), 0.0)
        old = np.array(self._state, dtype=np.intp)
        same = old >= 0
        same[same] = (now.boxes[same] == former.boxes[old[same]]).all(axis=1)
        self._same: list[bool] = same.tolist()
        kept = {old for old, same in zip(self._state, self._same, strict=True) if same}
        self.moved(_rects(former.boxes, (s for s in range(len(before)) if s not in kept)))
        self.moved(_rects(now.boxes, (s for s, same in enumerate(self._same) if not same)))
        self.moved(set(former.readable) ^ set(now.readable))

    @property
    def fits(self) -> bool:
        """Whether the states and edges of both pictures have the same order, marks have the same
        size, and detours may pass as many nodes.
        """
        before, after = self._former, self._now
        limits = most_passed(len(before.picture)), most_passed(len(after.picture))
        if before.style != after.style or limits[0] != limits[1]:
            return False
        states = [old for old in self._state if old >= 0]
        edges = [old for old in self._edges if old >= 0]
        return states == sorted(states) and edges == sorted(edges)

    def moved(self, rects: Iterable[Rect | None]) -> None:
        """Note that something has appeared or disappeared at these places."""
        for r in rects:
            if r is not None:
                # The leader of a label away from its line leads so far beyond it at most.
                far = NEAR + (FARTHEST if isinstance(r, AsideRect) else 0.0)
                m = far * self._now.style.unit
                self._far.append((r[0] - m, r[1] - m, r[2] + m, r[3] + m))

    # Lines

    def plain_pairs(self, box: Callable[[int], NodeBox]) -> list[HeldPair]:
        """Return the pairs with usual lines or detours that the edit cannot have changed.

        This is the answer of ``pair`` for all of them together. ``box`` gives the box of a state.
        """
        former, touched = self._former, self._touched_pairs()
        now_of = {old: state for state, old in enumerate(self._state) if self._same[state]}
        edge_of = {old: edge for edge, old in enumerate(self._edges)}
        found: list[HeldPair] = []
        for key, old in former.plain.items():
            a, b = now_of.get(old.a, -1), now_of.get(old.b, -1)
            if a < 0 or b < 0 or key in touched:
                continue
            there = tuple([edge_of[edge] for edge in old.there])
            pair = Between(a, b, there, tuple([edge_of[edge] for edge in old.back]))
            shapes = {edge: former.shapes[self._edges[edge]] for edge in (*there, *pair.back)}
            reach, around = former.bent.get(key), former.rects.get(key)
            around = reach or around or self._between(pair, box(a), box(b))
            clear = former.clear.get(key) if reach is None else None
            found.append(HeldPair(pair, shapes, around, reach, clear))
        quiet = ~meeting([one.around for one in found], self._far)
        return [one for one, ok in zip(found, quiet.tolist(), strict=True) if ok]

    def _touched_pairs(self) -> set[tuple[int, int]]:
        """Return the former pairs of states with an edge that is new, gone, or drawn otherwise."""
        before, after = self._former.picture, self._now.picture
        gone, found = set(range(len(before.operations))), set[tuple[int, int]]()
        hidden, was_hidden = after.bundles.hidden, before.bundles.hidden
        for edge, old in enumerate(self._edges):
            gone.discard(old)
            if old < 0:
                ends = self._state[after.source[edge]], self._state[max(after.target[edge], 0)]
                found.add((min(ends), max(ends)))
            elif (edge in hidden) != (old in was_hidden):
                gone.add(old)
        for old in gone:
            ends = int(before.source[old]), int(before.target[old])
            found.add((min(ends), max(ends)))
        return found

    def clear(self, pair: Between, source: NodeBox, target: NodeBox) -> bool | None:
        """Return whether the straight line of a pair meets no other node, or None if this is not
        known.
        """
        if not self._is_kept(pair) or not self._is_quiet(self._between(pair, source, target)):
            return None
        return self._former.clear.get((self._state[pair.a], self._state[pair.b]))

    def pair(
        self, pair: Between, source: NodeBox, target: NodeBox
    ) -> tuple[dict[int, EdgeShape], Rect | None] | None:
        """Return the lines of a pair, or None if the edit may change them.

        The second value is the rectangle in which nodes can change the lines. It is None for lines
        that do not lead around nodes.
        """
        if not self._is_kept(pair):
            return None
        a, b = self._state[pair.a], self._state[pair.b]
        reach, edges = self._former.bent.get((a, b)), self._edges
        if not self._is_quiet(reach or self._between(pair, source, target)):
            return None
        shapes = self._former.shapes
        both = (*pair.there, *pair.back)
        if any(edges[e] not in shapes or shapes[edges[e]].way == "lane" for e in both):
            return None
        return {e: shapes[edges[e]] for e in both}, reach

    def shape(self, edge: int, shape: EdgeShape) -> EdgeShape:
        """Return the old line of an edge if it equals the new one ``shape``, else ``shape``."""
        found = self._former.shapes.get(self._edges[edge])
        return found if found is not None and found.is_like(shape) else shape

    def lines_known(self, shapes: dict[int, EdgeShape]) -> None:
        """Note where lines have changed. ``shapes`` has all new lines except loops."""
        former, kept = self._former, set()
        for edge, shape in shapes.items():
            old = self._edges[edge]
            if former.shapes.get(old) is shape:
                kept.add(old)
            else:
                self.moved([shape.bounds])
        loops = (old for old in self._edges if old >= 0 and _is_loop(former.picture, old))
        kept.update(old for old in loops if old not in former.drawn)
        for old, shape in former.shapes.items():
            if old not in kept:
                self.moved([shape.bounds, former.labels.get(old)])

    def mark_known(self, rect: Rect) -> None:
        """Note where the mark of the initial state stands now."""
        if rect != self._former.mark:
            self.moved([rect, self._former.mark])

    def _is_kept(self, pair: Between) -> bool:
        """Return whether a pair has the same nodes at the same places, and the same edges."""
        if not (self._same[pair.a] and self._same[pair.b]):
            return False
        there, back = self._former.picture.between(self._state[pair.a], self._state[pair.b])
        old = self._edges
        if tuple(old[e] for e in pair.there) != there:
            return False
        return tuple(old[e] for e in pair.back) == back

    def _between(self, pair: Between, source: NodeBox, target: NodeBox) -> Rect:
        """Return the rectangle in which another node would be in the way of a pair's lines."""
        style = self._now.style
        aside = GAP * style.unit + breadth(pair, source, target, style)
        return (
            min(source.x, target.x) - aside, min(source.y, target.y) - aside,
            max(source.x, target.x) + aside, max(source.y, target.y) + aside,
        )  # fmt: skip

    # Loops and labels

    def has_loops(
        self, state: int, own: list[int], sizes: list[tuple[float, float]], box: NodeBox
    ) -> bool:
        """Return whether the loops of a state and their labels keep their places."""
        former, old = self._former, [self._edges[e] for e in own]
        if not self._same[state] or -1 in old or len(own) != self._loop_count(state):
            return False
        if self._now.picture.names[state] in self._regrouped:
            return False  # the title of a group above a state comes or goes
        if [former.sizes.get(o) for o in old] != sizes:
            return False
        aside = (20.0 + 30.0 * len(own)) * self._now.style.unit + max(wide for wide, _ in sizes)
        return self._is_quiet(
            (box.x - box.w - aside, box.y - box.h - aside,
             box.x + box.w + aside, box.y + box.h + aside)
        )  # fmt: skip

    def loop(self, edge: int) -> tuple[EdgeShape, Rect | None]:
        """Return the old line of a loop and the place of its label."""
        return self._former.shapes[self._edges[edge]], self.label(edge)

    def loops_moved(self, state: int, own: dict[int, tuple[EdgeShape, Rect | None]]) -> None:
        """Note that the loops of a state were drawn anew."""
        former = self._former
        old = {self._edges[edge] for edge in own}
        if self._state[state] >= 0:
            old |= set(_loops(former.picture, self._state[state]))
        for edge in old & former.shapes.keys():
            self.moved([former.shapes[edge].bounds, former.labels.get(edge)])
        for shape, rect in own.values():
            self.moved([shape.bounds, rect])

    def label(self, edge: int) -> Rect | None:
        """Return the old place of an edge's label, None if it was hidden."""
        return self._former.labels[self._edges[edge]]

    def look_at_labels(
        self, shapes: Mapping[int, EdgeShape], sizes: Mapping[int, tuple[float, float]]
    ) -> None:
        """Prepare ``kept_labels`` for these edges, with the sizes of their labels."""
        former, edges = self._former, self._edges
        kept = {
            edge: shape.bounds
            for edge, shape in shapes.items()
            if former.shapes.get(edges[edge]) is shape
            and former.sizes.get(edges[edge]) == sizes[edge]
        }
        before = {edge: former.labels[edges[edge]] for edge in kept}
        on_line = {e for e, rect in before.items() if rect and not isinstance(rect, AsideRect)}
        self._labels = LabelRooms(kept, sizes, on_line, self._now.style.unit)

    def kept_labels(self) -> frozenset[int]:
        """Return the edges whose labels keep their places (see ``look_at_labels``), as far as it
        is known by now.
        """
        return self._labels.quiet(self._far)

    def label_moved(self, edge: int, rect: Rect | None) -> None:
        """Note the new place of an edge's label."""
        before = self._former.labels.get(self._edges[edge])
        if before != rect:
            self.moved([before, rect])

    def _loop_count(self, state: int) -> int:
        """Return how many loops of a state were not bent by hand."""
        drawn, loops = self._former.drawn, _loops(self._former.picture, self._state[state])
        return sum(edge not in drawn or not drawn[edge].bends for edge in loops)

    def _is_quiet(self, rect: Rect) -> bool:
        """Return whether no change is at this place."""
        return not any(meet(rect, far) for far in self._far)


def _matched(former: Routing, now: Routing) -> list[int]:
    """Return the old number of each edge, -1 if its operation, source or target is not the same, or
    if its line is drawn in another way.
    """
    before, after = former.picture, now.picture
    old_of = {key: edge for edge, key in enumerate(_keys(before))}
    found = [old_of.get(key, -1) for key in _keys(after)]
    if former.drawn or now.drawn:
        drawn, was = now.drawn.get, former.drawn.get
        found = [old if was(old) == drawn(edge) else -1 for edge, old in enumerate(found)]
    return found


def _keys(picture: Picture) -> Iterator[tuple[str, str, str]]:
    """Yield source, operation and target of each edge by name."""
    names = (*picture.names, "")
    source, target = picture.source.tolist(), picture.target.tolist()
    return zip(
        map(names.__getitem__, source), picture.operations, map(names.__getitem__, target),
        strict=True,
    )  # fmt: skip


def _loops(picture: Picture, state: int) -> list[int]:
    return [edge for edge in picture.edges_of(state) if _is_loop(picture, edge)]


def _is_loop(picture: Picture, edge: int) -> bool:
    return bool(picture.source[edge] == picture.target[edge])


def _rects(boxes: Floats, states: Iterable[int]) -> Iterator[Rect]:
    for state in states:
        x, y, w, h = boxes[state].tolist()
        yield x - w, y - h, x + w, y + h
