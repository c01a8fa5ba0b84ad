"""EdgeLines: the lines of a picture from one state to another, each drawn when it is asked for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture import bends, start_lane
from smsl_studio.picture.clear_pairs import ClearPairs
from smsl_studio.picture.curves import (
    Between,
    LineStyle,
    around_each,
    shapes_of,
    strands_of,
    stub,
)
from smsl_studio.picture.detours import Rect
from smsl_studio.picture.former import FormerLines
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox
from smsl_studio.picture.strands import Strand

MOST_AT_ONCE = 20
"""If two states of a large picture share more edges, each edge is drawn when it is needed."""


class EdgeLines:
    """The lines between states, by edge number.

    ``boxes`` is an (n, 4) array of centres and half sizes. ``drawn`` has the edges whose line or
    label somebody has drawn by hand. ``StateLoops`` draws the other loops into ``shapes``, too.
    """

    def __init__(
        self,
        picture: Picture,
        boxes: Floats,
        style: LineStyle,
        drawn: Mapping[int, EdgeLayout],
    ) -> None:
        self.picture, self.boxes, self.style, self.drawn = picture, boxes, style, drawn
        self.obstacles = Obstacles(boxes)
        self.clears = ClearPairs(self.obstacles, style, self.box)
        self.shapes: dict[int, EdgeShape] = {}
        """The lines that are drawn."""
        self.bent: dict[tuple[int, int], Rect] = {}
        """The pairs whose usual lines meet other nodes. Only nodes inside the rectangle of a pair
        can change its lines.
        """
        self.former: FormerLines | None = None
        """The lines before an edit, while those that it did not touch are taken over."""
        self._box: dict[int, NodeBox] = {}
        self._pairs: dict[tuple[int, int], Between] = {}
        self._strands: dict[int, Strand] = {}
        """The planned lines that ``finish`` draws."""
        self._led: dict[int, Between] = {}
        """The pair of each planned line that leads around nodes."""

    def box(self, state: int) -> NodeBox:
        """Return the box of a state, with its rounded corners."""
        found = self._box.get(state)
        if found is None:
            x, y, w, h = self.boxes[state].tolist()
            radius = min((6.0 if self.style.compact else 8.0) * self.style.unit, h)
            found = self._box[state] = NodeBox(x, y, w, h, radius)
        return found

    def pair(self, a: int, b: int) -> Between:
        """Return the edges between two states."""
        key = (min(a, b), max(a, b))
        found = self._pairs.get(key)
        if found is None:
            found = self._pairs[key] = Between(*key, *self.picture.between(*key))
        return found

    def take_pairs(self, pairs: Mapping[tuple[int, int], Between]) -> None:
        """Take over pairs from before an edit."""
        self._pairs |= pairs

    def is_clear(self, pair: Between) -> bool:
        """Return whether the lines of a pair are drawn without a detour.

        The lines of a very large or far picture never have one.
        """
        none = self.style.far or not self.picture.careful
        return none or self.clears.holds(pair, self.former)

    def is_loop(self, edge: int) -> bool:
        """Return whether a line is a loop that nobody has drawn by hand."""
        loops = bool(self.picture.source[edge] == self.picture.target[edge])
        return loops and (edge not in self.drawn or self.by_hand(edge) is None)

    def by_hand(self, edge: int) -> EdgeShape | None:
        """Return the line of an edge through its bends, None if it has none beside its nodes."""
        a, b = int(self.picture.source[edge]), int(self.picture.target[edge])
        points = self.drawn[edge].bends
        if b < 0 or not points:
            return None
        others = np.delete(self.boxes, (a, b), axis=0) if self.picture.small else None
        return bends.bent(self.box(a), self.box(b), points, self.style.unit, others)

    def ways_back(self, edges: Sequence[int]) -> dict[int, EdgeShape]:
        """Return the lines of edges that lead back to the start by the lane."""
        lane = start_lane.LaneNodes(self.boxes, self.box, self.obstacles, self.style.unit)
        return start_lane.ways_back(self.picture, edges, lane, self.shapes)

    def forget(self, states: Iterable[int]) -> None:
        """Drop the boxes of states that have moved, and what depended on them for other lines."""
        self.clears.known.clear()
        for state in states:
            self._box.pop(state, None)

    # Drawing

    def draw(self, edges: Iterable[int]) -> None:
        """Draw those of these edges that have no line yet, together. Loops must be drawn by hand or
        have their lines.
        """
        for edge in edges:
            if not self.is_planned(edge):
                self.plan(edge)
        self.finish()

    def is_planned(self, edge: int) -> bool:
        """Return whether an edge has a line, or ``finish`` gives it one."""
        return edge in self.shapes or edge in self._strands or edge in self._led

    def plan(self, edge: int) -> None:
        """Plan the line of an edge. ``finish`` draws the planned lines between two states; others
        are drawn here.
        """
        picture = self.picture
        a, b = int(picture.source[edge]), int(picture.target[edge])
        by_hand = self.by_hand(edge) if edge in self.drawn else None
        back = by_hand is None and picture.small and edge in picture.bundles.back
        if by_hand is not None:
            self.shapes[edge] = by_hand
        elif back and (ways := self.ways_back([edge])):
            self.shapes |= ways
        elif b < 0:
            self.shapes[edge] = stub(self.box(a), picture.dangling(a), edge, self.style.unit)
        else:
            pair = self.pair(a, b)
            only = edge if len(pair) > MOST_AT_ONCE and not picture.small else None
            self._plan_pair(pair, only)

    def finish(self) -> None:
        """Draw all planned lines together."""
        if self._strands:
            self._keep(shapes_of(self._strands, self.style))
            self._strands.clear()
        if self._led:
            pairs = list(dict.fromkeys(self._led.values()))
            ends = [(self.box(pair.a), self.box(pair.b)) for pair in pairs]
            found = around_each(pairs, ends, self.style, self.obstacles)
            for pair, (shapes, reach) in zip(pairs, found, strict=True):
                self._keep(shapes)
                self.bent[pair.a, pair.b] = reach
            self._led.clear()

    def _plan_pair(self, pair: Between, only: int | None) -> None:
        source, target = self.box(pair.a), self.box(pair.b)
        held = self.former.pair(pair, source, target) if self.former is not None else None
        if held is not None:
            shapes, reach = held
            self._keep(shapes)
            if reach is not None:
                self.bent[pair.a, pair.b] = reach
        elif only is not None or self.is_clear(pair):
            self._strands |= strands_of(pair, source, target, self.style, True, only)
        else:
            self._led |= dict.fromkeys((*pair.there, *pair.back), pair)

    def _keep(self, shapes: Mapping[int, EdgeShape]) -> None:
        """Keep lines, but those that are drawn by hand as they are drawn."""
        for edge in self.drawn.keys() & shapes.keys():
            by_hand = self.by_hand(edge)
            if by_hand is not None:
                shapes = {**shapes, edge: by_hand}
        self.shapes |= shapes
