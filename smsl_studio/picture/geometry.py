"""Geometry: the place of every edge and label of a picture, for one layout and one size of marks.

Small pictures are routed as a whole. In large ones each edge is routed when it comes into view.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture import bends, initial_mark, labels, loops, start_lane
from smsl_studio.picture.clear_pairs import ClearPairs
from smsl_studio.picture.curves import (
    Between,
    LineStyle,
    around,
    in_row,
    shapes_of,
    strands_of,
    stub,
)
from smsl_studio.picture.former import FormerLines
from smsl_studio.picture.kept_routing import Routing
from smsl_studio.picture.lanes import Passing, in_lanes
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.readable import readable_of, stub_at
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox
from smsl_studio.picture.strands import Strand

MOST_AT_ONCE = 20
"""If two states of a large picture share more edges, each edge is routed when it is needed."""
LabelSize = Callable[[int], tuple[float, float]]
"""Returns the size of an edge's label in scene units, (0, 0) for none."""


class Geometry:
    """The lines and label places of a picture, by edge number.

    ``boxes`` is an (n, 4) array of centres and half sizes. ``drawn`` has the edges whose line or
    label somebody has drawn by hand. ``former`` is the routing of a small picture before an edit.
    What the edit does not touch is copied from it, and the result is the same as without it.
    """

    def __init__(
        self,
        picture: Picture,
        boxes: Floats,
        style: LineStyle,
        label_size: LabelSize,
        drawn: Mapping[int, EdgeLayout],
        former: Routing | None = None,
    ) -> None:
        self.picture, self.boxes, self.style = picture, boxes, style
        self._obstacles = Obstacles(boxes)
        self._clears = ClearPairs(self._obstacles, style, self.box)
        self._drawn = drawn
        self._label_size = label_size
        self._shapes: dict[int, EdgeShape] = {}
        self._strands: dict[int, Strand] = {}
        self._labels: dict[int, labels.Rect | None] = {}
        self.mark_shift = 0.0
        """The distance of the initial state's mark below the middle of its node (scene units)."""
        self.routing: Routing | None = None
        """The routing of a small picture, for the picture after the next edit."""
        self._work: Routing | None = None
        self._former: FormerLines | None = None
        self._box: dict[int, NodeBox] = {}
        self._pairs: dict[tuple[int, int], Between] = {}
        self.places: labels.LabelPlaces | None = None
        self._lines = labels.LinePieces({})
        self._choice: labels.LabelChoice | None = None
        self.small = picture.small
        if self.small:
            self._route_small(former)

    def shape(self, edge: int) -> EdgeShape:
        """Return the line of an edge, or of its bundle."""
        edge = self.picture.line_of(edge)
        found = self._shapes.get(edge)
        if found is None:
            self._route_each([edge])
            found = self._shapes[edge]
        return found

    def prepare(self, edges: Iterable[int]) -> None:
        """Route all of these edges that are not routed yet, together."""
        edges = list(dict.fromkeys(map(self.picture.line_of, edges)))
        self._route_each(edges)
        if anew := [edge for edge in edges if edge not in self._labels]:
            self._choice = self._choice_of(anew)

    def label(self, edge: int) -> labels.Rect | None:
        """Return the place of an edge's label or of its bundle's chip, None while it is hidden."""
        edge = self.picture.line_of(edge)
        if edge not in self._labels:
            self._place(edge)
        return self._labels[edge]

    def is_hidden(self, edge: int) -> bool:
        """Return whether the label of an edge has no place."""
        bundled = edge in self.picture.bundles.first
        return not bundled and self.label(edge) is None and self._label_size(edge)[0] > 0.0

    def fallback(self, edge: int) -> labels.Rect:
        """Return the place where a hidden label appears while its edge is hovered or lit: the
        edge's middle.
        """
        shape = self.shape(edge)
        return labels.centred(shape.at(shape.length / 2), self._label_size(edge))

    def covered(self, edge: int, rects: Sequence[labels.Rect]) -> list[int]:
        """Return how many pieces of other lines each rectangle covers; 0 in a large picture."""
        return self._lines.covered(edge, rects)

    def forget(self, states: Iterable[int]) -> list[int]:
        """Drop the lines of states that have moved, and return their edges.

        During a drag everything else keeps its place.
        """
        concerned: dict[int, None] = {}
        self._clears.known.clear()
        for state in states:
            self._box.pop(state, None)
            concerned.update(dict.fromkeys(self.picture.edges_of(state)))
        for edge in concerned:
            self.redraw(edge)
        return list(concerned)

    def redraw(self, edge: int) -> None:
        """Drop the line of an edge whose layout has changed."""
        self._shapes.pop(edge, None)
        self._labels.pop(edge, None)
        self._choice = None

    def box(self, state: int) -> NodeBox:
        """Return the box of a state, with its rounded corners."""
        found = self._box.get(state)
        if found is None:
            x, y, w, h = self.boxes[state].tolist()
            radius = min((6.0 if self.style.compact else 8.0) * self.style.unit, h)
            found = self._box[state] = NodeBox(x, y, w, h, radius)
        return found

    # One edge at a time

    def _route_each(self, edges: Iterable[int]) -> None:
        """Route those of these edges that are not routed yet, together."""
        for edge in edges:
            if edge not in self._shapes and edge not in self._strands:
                self._plan(edge)
        self._draw()

    def _plan(self, edge: int) -> None:
        """Plan the line of an edge. ``_draw`` draws the planned lines between two states; others
        are drawn here.
        """
        a, b = int(self.picture.source[edge]), int(self.picture.target[edge])
        by_hand = self._by_hand(edge) if edge in self._drawn else None
        back = by_hand is None and self.small and edge in self.picture.bundles.back
        if by_hand is not None:
            self._shapes[edge] = by_hand
        elif back and (ways := self._ways_back([edge])):
            self._shapes |= ways
        elif b < 0:
            self._shapes[edge] = stub(self.box(a), self.picture.dangling(a), edge, self.style.unit)
        elif a == b:
            self._route_loops(a)
        else:
            pair = self._pair(a, b)
            only = edge if len(pair) > MOST_AT_ONCE and not self.small else None
            self._plan_pair(pair, only)

    def _draw(self) -> None:
        """Draw all planned lines together."""
        if self._strands:
            self._keep(shapes_of(self._strands, self.style))
            self._strands.clear()

    def _keep(self, shapes: Mapping[int, EdgeShape]) -> None:
        """Keep lines, but those that are drawn by hand as they are drawn."""
        for edge in self._drawn.keys() & shapes.keys():
            by_hand = self._by_hand(edge)
            if by_hand is not None:
                shapes = {**shapes, edge: by_hand}
        self._shapes |= shapes

    def _by_hand(self, edge: int) -> EdgeShape | None:
        """Return the line of an edge through its bends, None if it has none beside its nodes."""
        a, b = int(self.picture.source[edge]), int(self.picture.target[edge])
        points = self._drawn[edge].bends
        if b < 0 or not points:
            return None
        others = np.delete(self.boxes, (a, b), axis=0) if self.small else None
        return bends.bent(self.box(a), self.box(b), points, self.style.unit, others)

    def _pair(self, a: int, b: int) -> Between:
        key = (min(a, b), max(a, b))
        found = self._pairs.get(key)
        if found is None:
            found = self._pairs[key] = Between(*key, *self.picture.between(*key))
        return found

    def _plan_pair(self, pair: Between, only: int | None) -> None:
        source, target = self.box(pair.a), self.box(pair.b)
        work, former = self._work, self._former
        held = former.pair(pair, source, target) if former is not None else None
        if held is not None:
            shapes, reach = held
            self._keep(shapes)
        elif only is not None or self._clear(pair):
            self._strands |= strands_of(pair, source, target, self.style, True, only)
            return
        else:
            shapes, reach = around(pair, source, target, self.style, self._obstacles)
            self._keep(shapes)
        if work is not None and reach is not None:
            work.bent[pair.a, pair.b] = reach

    def _clear(self, pair: Between) -> bool:
        """Return whether the lines of a pair are drawn without a detour.

        The lines of a very large or far picture never have one.
        """
        none = self.style.far or not self.picture.careful
        return none or self._clears.holds(pair, self._former)

    # All edges of a small picture

    def _route_small(self, former: Routing | None) -> None:
        drawn = dict(self._drawn)
        work = self._work = Routing(self.picture, self.boxes, self.style, drawn)
        work.readable = readable_of(self.picture, self.boxes, self.style, self.box)
        if former is not None:
            held = FormerLines(former, work)
            self._former = held if held.fits else None
        self._route_all(work)
        self._former = None
        work.shapes, work.labels, work.clear = self._shapes, self._labels, self._clears.known
        self.routing = work.copied()

    def _route_all(self, work: Routing) -> None:
        if self._former is not None:
            self._shapes |= work.keep(self._former.plain_pairs(self.box))
            self._pairs |= work.plain
            self._clears.known |= work.clear
        elif self.picture.careful and not self.style.far:
            self._clears.look([self._pair(a, b) for a, b in self.picture.pairs()])
        held = set(self._shapes)
        passing: list[Passing] = []
        looping: dict[int, None] = {}
        back, hidden = self.picture.bundles.back, self.picture.bundles.hidden
        for edge, (a, b) in enumerate(
            zip(self.picture.source.tolist(), self.picture.target.tolist(), strict=True)
        ):
            if edge in self._shapes or edge in self._strands or edge in hidden:
                continue
            if edge in self._drawn and (by_hand := self._by_hand(edge)) is not None:
                self._shapes[edge] = by_hand
            elif a == b:
                looping[a] = None
            elif edge in back:
                continue
            elif b >= 0 and in_row(self.box(a), self.box(b)) and not self._clear(self._pair(a, b)):
                passing.append(Passing(edge, a, b))
            else:
                self._plan(edge)
                work.note_plain(self._pairs.get((min(a, b), max(a, b))))
        if passing:
            boxes = list(map(self.box, range(len(self.picture))))
            self._shapes |= in_lanes(passing, boxes, self.style.unit, self._obstacles)
        self._route_each(one.edge for one in passing)
        own = [edge for edge in back if edge not in hidden and edge not in self._drawn]
        self._shapes |= self._ways_back(own)
        self._route_each(own)
        if self._former is not None:
            same = self._former.shape
            self._shapes |= {e: same(e, s) for e, s in self._shapes.items() if e not in held}
            self._former.lines_known(self._shapes)
        self._lines = labels.LinePieces(self._shapes)
        self.places = self._fresh_places(work.readable)
        self._mark_initial(work, self.places)
        for edge, layout in self._drawn.items():
            if layout.label is not None and edge in self._shapes:
                self._place(edge)
        for state in looping:
            self._route_loops(state)
        if looping:
            self._lines = labels.LinePieces(self._shapes)
        self._label_all(work, self.places)

    def _label_all(self, work: Routing, places: labels.LabelPlaces) -> None:
        """Place all labels that have no place yet, in the order of their ranks."""
        ranks = {edge: labels.rank_of(edge, shape) for edge, shape in self._shapes.items()}
        order = [edge for edge in sorted(ranks, key=ranks.__getitem__) if edge not in self._labels]
        work.sizes |= {edge: self._label_size(edge) for edge in order}
        former, kept = self._former, frozenset[int]()
        if former is not None:
            former.look_at_labels({edge: self._shapes[edge] for edge in order}, work.sizes)
            kept = former.kept_labels()
        # The places of all new labels are worked out together, which is much quicker.
        self._choice = self._choice_of(edge for edge in order if edge not in kept)
        for edge in order:
            if former is None or edge not in kept:
                self._place(edge)
                kept = kept if former is None else former.kept_labels()
            else:
                rect = self._labels[edge] = former.label(edge)
                if rect is not None:
                    places.take(rect)

    def _ways_back(self, edges: Sequence[int]) -> dict[int, EdgeShape]:
        """Return the lines of edges that lead back to the start by the lane."""
        lane = start_lane.LaneNodes(self.boxes, self.box, self._obstacles, self.style.unit)
        return start_lane.ways_back(self.picture, edges, lane, self._shapes)

    def _mark_initial(self, work: Routing, places: labels.LabelPlaces) -> None:
        """Find the place of the initial state's mark. No label may cover it."""
        state = self.picture.index.get(self.picture.branch.initial, -1)
        if state < 0:
            return
        found = initial_mark.placed(self.box(state), self._lines, self.style.unit)
        self.mark_shift, work.mark = found
        places.take(work.mark)
        if self._former is not None:
            self._former.mark_known(work.mark)

    def _place(self, edge: int) -> None:
        if edge in self._labels:
            return
        size, shape = self._label_size(edge), self.shape(edge)
        if self._work is not None:
            self._work.sizes[edge] = size
        if edge in self._labels or size[0] <= 0.0:
            self._labels.setdefault(edge, None)
            return
        places = self.places = self.places or self._fresh_places()
        former, at = self._former, self._drawn[edge].label if edge in self._drawn else None
        if at is not None:
            moved = self._labels[edge] = labels.by_hand(shape, at, size)
            places.take(moved)
            if former is not None:
                former.label_moved(edge, moved)
            return
        choice = self._choice
        if choice is None or not choice.knows(edge):
            choice = self._choice_of([edge])
        rect = self._labels[edge] = choice.take(edge)
        if former is not None:
            former.label_moved(edge, rect)

    def _choice_of(self, edges: Iterable[int]) -> labels.LabelChoice:
        """Return the choice of label places for those of the edges whose lines are known."""
        shapes = {edge: self._shapes[edge] for edge in edges}
        sizes, compact = [self._label_size(edge) for edge in shapes], self.style.compact
        self.places = self.places or self._fresh_places()
        return labels.LabelChoice(shapes, sizes, self.places, compact, self.picture.careful)

    def _fresh_places(self, readable: Sequence[labels.Rect] | None = None) -> labels.LabelPlaces:
        places = labels.LabelPlaces(self.boxes, self.style.unit)
        if readable is None:
            readable = readable_of(self.picture, self.boxes, self.style, self.box)
        for rect in (*readable, *self._labels.values()):
            if rect is not None:
                places.take(rect)
        bends.keep_clear(self._drawn.values(), places)
        return places

    def _route_loops(self, state: int) -> None:
        """Draw the loops of a state at the corner where they and their labels cover least."""
        picture = self.picture
        at_state = picture.edges_of(state)
        own = [e for e in at_state if picture.source[e] == picture.target[e] == state]
        own = [e for e in own if e not in self._drawn or self._by_hand(e) is None]
        box = self.box(state)
        places = self.places or self._fresh_places()
        sizes = [self._label_size(e) for e in own]
        if self._work is not None:
            self._work.sizes |= dict(zip(own, sizes, strict=True))
        former = self._former
        if former is not None and former.has_loops(state, own, sizes, box):
            for edge in own:
                self._shapes[edge], rect = former.loop(edge)
                self._labels[edge] = rect
                if rect is not None:
                    places.take(rect)
            return
        # A line of other states that comes or goes must not move a loop.
        lines = [e for e in at_state if picture.source[e] != picture.target[e]] * self.small
        pieces = labels.LinePieces({e: self.shape(e) for e in lines})
        by_hand = {e: self._drawn[e].label for e in own if e in self._drawn}
        mark = stub_at(picture, state, box, self.style.unit)
        found = loops.placed(dict(zip(own, sizes, strict=True)), box, places, pieces, by_hand, mark)
        for edge, (shape, rect) in found.items():
            self._shapes[edge], self._labels[edge] = shape, rect
        if former is not None:
            former.loops_moved(state, found)
