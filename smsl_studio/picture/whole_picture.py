"""Routing of a small picture as a whole: all lines first, then all labels by their ranks.

What an edit does not touch is taken over from the routing before it. The result is the same as
without it.
"""

from __future__ import annotations

from smsl_studio.picture import initial_mark, labels
from smsl_studio.picture.curves import in_row
from smsl_studio.picture.edge_lines import EdgeLines
from smsl_studio.picture.former import FormerLines
from smsl_studio.picture.held_routes import Routing
from smsl_studio.picture.label_seats import LabelSeats
from smsl_studio.picture.lanes import Passing, in_lanes
from smsl_studio.picture.line_pieces import LinePieces
from smsl_studio.picture.readable import readable_of
from smsl_studio.picture.state_loops import StateLoops


class WholeRouting:
    """Draws all lines into ``lines`` and chooses all places of labels in ``seats``.

    ``former`` is the routing before an edit.
    """

    def __init__(
        self,
        lines: EdgeLines,
        seats: LabelSeats,
        loops: StateLoops,
        former: Routing | None = None,
    ) -> None:
        self._lines, self._seats, self._loops = lines, seats, loops
        picture, boxes, style = lines.picture, lines.boxes, lines.style
        readable = readable_of(picture, boxes, style, lines.box)
        self._work = Routing(picture, boxes, style, dict(lines.drawn), readable=readable)
        self.mark_shift = 0.0
        """The distance of the initial state's mark below the middle of its node (scene units)."""
        self._former: FormerLines | None = None
        if former is not None:
            held = FormerLines(former, self._work)
            self._former = held if held.fits else None
        lines.former = seats.former = loops.former = self._former
        states = self._draw_lines()
        self.pieces = LinePieces(lines.shapes)
        """The pieces of all lines."""
        self._place_first()
        self._draw_loops(states)
        self._place_labels()
        lines.former = seats.former = loops.former = None
        self.routing = self._kept()
        """The result, for the picture after the next edit."""

    def _draw_lines(self) -> list[int]:
        """Draw all lines but loops. Returns the states with loops."""
        lines, picture = self._lines, self._lines.picture
        self._take_over()
        held = set(lines.shapes)
        passing: list[Passing] = []
        looping: dict[int, None] = {}
        back, hidden = picture.bundles.back, picture.bundles.hidden
        ends = zip(picture.source.tolist(), picture.target.tolist(), strict=True)
        for edge, (a, b) in enumerate(ends):
            if edge in hidden or lines.is_planned(edge):
                continue
            if edge in lines.drawn and (by_hand := lines.by_hand(edge)) is not None:
                lines.shapes[edge] = by_hand
            elif a == b:
                looping[a] = None
            elif edge in back:
                continue
            elif b >= 0 and self._passes(a, b):
                passing.append(Passing(edge, a, b))
            else:
                lines.plan(edge)
                self._work.note_plain(lines.pair(a, b) if b >= 0 else None)
        if passing:
            boxes = list(map(lines.box, range(len(picture))))
            lines.shapes |= in_lanes(passing, boxes, lines.style.unit, lines.obstacles)
        lines.draw(one.edge for one in passing)
        own = [edge for edge in back if edge not in hidden and edge not in lines.drawn]
        lines.shapes |= lines.ways_back(own)
        lines.draw(own)
        if self._former is not None:
            same, shapes = self._former.shape, lines.shapes
            shapes |= {edge: same(edge, s) for edge, s in shapes.items() if edge not in held}
            self._former.lines_known(shapes)
        return list(looping)

    def _take_over(self) -> None:
        """Take over the lines of pairs that the edit did not touch, or look at all pairs."""
        lines, work, picture = self._lines, self._work, self._lines.picture
        if self._former is not None:
            lines.shapes |= work.keep(self._former.plain_pairs(lines.box))
            lines.take_pairs(work.plain)
            lines.clears.known |= work.clear
            lines.bent |= work.bent
        elif picture.careful and not lines.style.far:
            lines.clears.look([lines.pair(a, b) for a, b in picture.pairs()])

    def _passes(self, a: int, b: int) -> bool:
        """Return whether a line needs a lane, because nodes stand between its own in a row."""
        lines = self._lines
        return in_row(lines.box(a), lines.box(b)) and not lines.is_clear(lines.pair(a, b))

    def _place_first(self) -> None:
        """Place the mark of the initial state, and the labels that somebody has moved."""
        lines, seats = self._lines, self._seats
        places = seats.begin(self._work.readable)
        places.lines = self.pieces
        state = lines.picture.index.get(lines.picture.branch.initial, -1)
        if state >= 0:
            found = initial_mark.placed(lines.box(state), self.pieces, lines.style.unit)
            self.mark_shift, self._work.mark = found
            places.take(found[1])
            if self._former is not None:
                self._former.mark_known(found[1])
        for edge, layout in lines.drawn.items():
            if layout.label is not None and edge in lines.shapes:
                seats.place(edge)

    def _draw_loops(self, states: list[int]) -> None:
        for state in states:
            self._loops.draw(state)
        if states:
            self.pieces = self._seats.places.lines = LinePieces(self._lines.shapes)
            self._loops.give_way()

    def _place_labels(self) -> None:
        """Place all labels that have no place yet, in the order of their ranks."""
        seats, shapes, former = self._seats, self._lines.shapes, self._former
        ranks = {edge: labels.rank_of(edge, shape) for edge, shape in shapes.items()}
        order = [edge for edge in sorted(ranks, key=ranks.__getitem__) if edge not in seats.rects]
        kept = frozenset[int]()
        if former is not None:
            sizes = {edge: seats.size(edge) for edge in order}
            former.look_at_labels({edge: shapes[edge] for edge in order}, sizes)
            kept = former.kept_labels()
        seats.prepare(edge for edge in order if edge not in kept)
        for edge in order:
            if former is None or edge not in kept:
                seats.place(edge)
                kept = kept if former is None else former.kept_labels()
            else:
                rect = seats.rects[edge] = former.label(edge)
                if rect is not None:
                    seats.places.take_label(shapes[edge], rect)

    def _kept(self) -> Routing:
        """Return the result in copies that a drag does not change."""
        work, lines, seats = self._work, self._lines, self._seats
        work.shapes, work.labels, work.sizes = lines.shapes, seats.rects, seats.sizes
        work.clear, work.bent = lines.clears.known, lines.bent
        return work.copied()
