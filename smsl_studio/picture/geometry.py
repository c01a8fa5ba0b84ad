"""Geometry: the place of every edge and label of a picture, for one layout and one size of marks.

Small pictures are routed as a whole (``WholeRouting``). In large ones each edge is routed when it
comes into view. After a drag this holds for the moved lines of small ones, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture import labels
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.edge_lines import EdgeLines
from smsl_studio.picture.held_routes import Routing
from smsl_studio.picture.label_seats import LabelSeats, LabelSize
from smsl_studio.picture.line_pieces import LinePieces
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats, NodeBox
from smsl_studio.picture.state_loops import StateLoops
from smsl_studio.picture.whole_picture import WholeRouting


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
        self.small = picture.small
        self._label_size = label_size
        self._lines = EdgeLines(picture, boxes, style, drawn)
        self._seats = LabelSeats(self._lines, label_size)
        self._loops = StateLoops(self._lines, self._seats)
        self.mark_shift = 0.0
        """The distance of the initial state's mark below the middle of its node (scene units)."""
        self.routing: Routing | None = None
        """The routing of a small picture, for the picture after the next edit."""
        self.dragged = False
        """Whether lines were dropped that lay elsewhere before."""
        self._pieces = LinePieces({})
        if self.small:
            whole = WholeRouting(self._lines, self._seats, self._loops, former)
            self.routing, self.mark_shift = whole.routing, whole.mark_shift
            self._pieces = whole.pieces

    @property
    def places(self) -> labels.LabelPlaces:
        """What no further label may cover."""
        return self._seats.places

    def shape(self, edge: int) -> EdgeShape:
        """Return the line of an edge, or of its bundle."""
        edge = self.picture.line_of(edge)
        found = self._lines.shapes.get(edge)
        if found is None:
            self._route([edge])
            found = self._lines.shapes[edge]
        return found

    def drawn(self, edges: Iterable[int]) -> list[tuple[EdgeShape, labels.Rect | None]]:
        """Return the line and the place of the label of each of these edges."""
        return [(self.shape(edge), self.label(edge)) for edge in edges]

    def prepare(self, edges: Iterable[int]) -> None:
        """Route all of these edges that are not routed yet, together."""
        edges = list(dict.fromkeys(map(self.picture.line_of, edges)))
        self._route(edges)
        self._seats.prepare(edges)

    def label(self, edge: int) -> labels.Rect | None:
        """Return the place of an edge's label or of its bundle's chip, None while it is hidden."""
        edge = self.picture.line_of(edge)
        rects = self._seats.rects
        if edge not in rects:
            self.shape(edge)
            self._seats.place(edge)
        return rects[edge]

    def is_hidden(self, edge: int) -> bool:
        """Return whether the label of an edge has no place."""
        if edge in self.picture.bundles.first or self.label(edge) is not None:
            return False
        return self._seats.size(edge)[0] > 0.0

    def hidden_among(self, edges: Iterable[int]) -> list[int]:
        """Return those of these edges whose label has no place."""
        rects = self._seats.rects
        return [edge for edge in edges if rects.get(edge) is None and self.is_hidden(edge)]

    def fallback(self, edge: int) -> labels.Rect:
        """Return the place where a hidden label appears while its edge is hovered or lit: the
        edge's middle.
        """
        shape = self.shape(edge)
        return labels.centred(shape.at(shape.length / 2), self._label_size(edge))

    def loops_of(self, states: Iterable[int]) -> dict[int, Floats]:
        """Return for each of these states that has loops what they and their names cover, (m, 4).

        A name that stands away from its loop does not count.
        """
        found: dict[int, Floats] = {}
        for state in states:
            own = [e for e in self.picture.edges_of(state) if self._lines.is_loop(e)]
            rects = [self.shape(edge).bounds for edge in own]
            drawn = self._lines.drawn
            names = [self.label(e) for e in own if e not in drawn or drawn[e].label is None]
            rects += [name for name in names if name and not isinstance(name, labels.AsideRect)]
            if rects:
                found[state] = np.array(rects)
        return found

    def covered(self, edge: int, rects: Sequence[labels.Rect]) -> list[int]:
        """Return how many pieces of other lines each rectangle covers; 0 in a large picture."""
        return self._pieces.covered(edge, rects)

    def forget(self, states: Iterable[int]) -> list[int]:
        """Drop the lines of states that have moved, and return their edges.

        During a drag everything else keeps its place.
        """
        moved = list(states)
        self._lines.forget(moved)
        concerned = dict.fromkeys(edge for state in moved for edge in self.picture.edges_of(state))
        for edge in concerned:
            self.redraw(edge)
        return list(concerned)

    def redraw(self, edge: int) -> None:
        """Drop the line of an edge whose layout has changed."""
        self.dragged = self._seats.dragged = True
        self._lines.shapes.pop(edge, None)
        self._seats.forget(edge)

    def box(self, state: int) -> NodeBox:
        """Return the box of a state, with its rounded corners."""
        return self._lines.box(state)

    def _route(self, edges: Iterable[int]) -> None:
        """Draw those of these edges that have no line yet, together."""
        lines = self._lines
        anew = [edge for edge in edges if edge not in lines.shapes]
        for edge in anew:
            if edge not in lines.shapes and lines.is_loop(edge):
                self._loops.draw(int(self.picture.source[edge]))
        lines.draw(anew)
