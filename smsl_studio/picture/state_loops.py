"""StateLoops: the loops of states. Their lines and labels choose a corner of the node together."""

from __future__ import annotations

import numpy as np

from smsl_studio.picture import loops
from smsl_studio.picture.edge_lines import EdgeLines
from smsl_studio.picture.former import FormerLines
from smsl_studio.picture.label_seats import LabelSeats
from smsl_studio.picture.labels import AsideRect
from smsl_studio.picture.line_pieces import LinePieces, Rect
from smsl_studio.picture.readable import stub_at


class StateLoops:
    """Draws the loops of a state into ``lines`` and puts their labels into ``seats``."""

    def __init__(self, lines: EdgeLines, seats: LabelSeats) -> None:
        self._lines, self._seats = lines, seats
        self.former: FormerLines | None = None
        """The loops before an edit, while those that it did not touch are taken over."""

    def draw(self, state: int) -> None:
        """Draw the loops of a state at the corner where they and their labels cover least."""
        lines, seats, picture = self._lines, self._seats, self._lines.picture
        at_state = picture.edges_of(state)
        ends = [edge for edge in at_state if picture.source[edge] == picture.target[edge]]
        own = [edge for edge in ends if lines.is_loop(edge)]
        sizes = {edge: seats.size(edge) for edge in own}
        box, places = lines.box(state), seats.places if seats.begun else seats.fresh_places()
        former = self.former
        if former is not None and former.has_loops(state, own, list(sizes.values()), box):
            held = {edge: former.loop(edge) for edge in own}
            if all(map(self._is_beside, own, (rect for _, rect in held.values()))):
                for edge, (shape, rect) in held.items():
                    lines.shapes[edge], seats.rects[edge] = shape, rect
                    if rect is not None:
                        places.take(rect)
                    places.loops.append(shape.bounds)
                return
        # A line of other states that comes or goes must not move a loop.
        others = [edge for edge in at_state if edge not in ends] if picture.small else []
        lines.draw(others)
        pieces = LinePieces({edge: lines.shapes[edge] for edge in others})
        by_hand = {edge: lines.drawn[edge].label for edge in own if edge in lines.drawn}
        mark = stub_at(picture, state, box, lines.style.unit)
        near = loops.LoopNeighbours(mark, picture.names[state] in picture.grouped)
        found = loops.placed(sizes, box, places, pieces, by_hand, near)
        for edge, (shape, rect) in found.items():
            lines.shapes[edge] = shape
            if self._is_beside(edge, rect):
                seats.rects[edge] = rect
        if former is not None:
            former.loops_moved(state, found)

    def give_way(self) -> None:
        """Take the label of a loop from its place if a loop that was drawn later is as near to it.
        It gets a place after the others, with a leader.
        """
        seats, picture, shapes = self._seats, self._lines.picture, self._lines.shapes
        lines, unit = seats.places.lines, seats.places.unit
        for edge, rect in list(seats.rects.items()):
            if rect is None or shapes[edge].way != "loop" or edge in self._lines.drawn:
                continue
            state = picture.source[edge]
            own = [e for e in picture.edges_of(state) if e in shapes and picture.target[e] == state]
            near = min(loops.away(shapes[e], rect) for e in own if shapes[e].way == "loop")
            room = np.array([near + unit])
            if not lines.clear([edge], np.array([[rect]]), room, picture.source)[0, 0]:
                del seats.rects[edge]

    def _is_beside(self, edge: int, rect: Rect | None) -> bool:
        """Return whether a label has its place beside its loop, or is not to be shown at all."""
        return self._seats.size(edge)[0] <= 0.0 or (
            rect is not None and not isinstance(rect, AsideRect)
        )
