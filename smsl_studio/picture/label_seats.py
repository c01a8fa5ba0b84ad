"""LabelSeats: the places of a picture's labels, each chosen when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from smsl_studio.picture import bends, labels
from smsl_studio.picture.edge_lines import EdgeLines
from smsl_studio.picture.former import FormerLines
from smsl_studio.picture.label_choice import LabelChoice
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.readable import readable_of
from smsl_studio.picture.shape import EdgeShape

Size = tuple[float, float]
STEEP = 0.35
"""A line is steep if it leads at most this share of its height to the side."""
LabelSize = Callable[[int], Size]
"""Returns the size of an edge's label in scene units, (0, 0) for none."""


class LabelSeats:
    """The place of each label, by edge number. The line of an edge must be there before its label.

    ``rects`` has the places that are chosen, None for a label without room.
    """

    def __init__(self, lines: EdgeLines, label_size: LabelSize) -> None:
        self._lines, self._label_size = lines, label_size
        self.rects: dict[int, Rect | None] = {}
        self.sizes: dict[int, Size] = {}
        """The sizes of labels that were asked for."""
        self.dragged = False
        """During a drag no label stands away from its line: the search for such a place takes more
        time than all the rest of a step, and the drop places all labels again.
        """
        self.former: FormerLines | None = None
        """The labels before an edit, while those that it did not touch are taken over."""
        self._places: labels.LabelPlaces | None = None
        self._choice: LabelChoice | None = None

    def size(self, edge: int) -> Size:
        """Return the size of an edge's label (scene units)."""
        found = self.sizes.get(edge)
        if found is None:
            found = self.sizes[edge] = self._label_size(edge)
        return found

    @property
    def places(self) -> labels.LabelPlaces:
        """What no further label may cover."""
        if self._places is None:
            self._places = self.fresh_places()
        return self._places

    @property
    def begun(self) -> bool:
        """Whether any label has been placed."""
        return self._places is not None

    def fresh_places(self, readable: Sequence[Rect] | None = None) -> labels.LabelPlaces:
        """Return what no label may cover, as far as it is known. ``readable`` is what
        ``readable_of`` returns, if the caller has it.
        """
        lines = self._lines
        places = labels.LabelPlaces(lines.boxes, lines.style.unit)
        if readable is None:
            readable = readable_of(lines.picture, lines.boxes, lines.style, lines.box)
        for words in readable:
            places.take(words)
        for edge, rect in self.rects.items():
            if rect is not None:
                places.take_label(lines.shapes[edge], rect)
        bends.keep_clear(lines.drawn.values(), places)
        return places

    def begin(self, readable: Sequence[Rect]) -> labels.LabelPlaces:
        """Begin to place the labels of a whole picture. Returns what they may not cover."""
        self._places = self.fresh_places(readable)
        return self._places

    def prepare(self, edges: Iterable[int]) -> None:
        """Work out the possible places of labels together, which is much quicker."""
        if anew := [edge for edge in edges if edge not in self.rects]:
            self._choice = self._choice_of(anew)

    def forget(self, edge: int) -> None:
        """Drop the place of a label whose line has changed."""
        self.rects.pop(edge, None)
        self.sizes.pop(edge, None)
        self._choice = None

    def place(self, edge: int) -> None:
        """Choose the place of an edge's label, unless it has one."""
        if edge in self.rects:
            return
        size, shape, drawn = self.size(edge), self._lines.shapes[edge], self._lines.drawn
        if size[0] <= 0.0:
            self.rects[edge] = None
            return
        places, at = self.places, drawn[edge].label if edge in drawn else None
        if at is not None:
            rect = labels.by_hand(shape, at, size)
            places.take_label(shape, rect)
            self._note(edge, rect)
            return
        choice = self._choice
        if choice is None or not choice.knows(edge):
            choice = self._choice_of([edge])
        self._note(edge, choice.take(edge))

    def _note(self, edge: int, rect: Rect | None) -> None:
        self.rects[edge] = rect
        if self.former is not None:
            self.former.label_moved(edge, rect)

    def _choice_of(self, edges: Iterable[int]) -> LabelChoice:
        """Return the choice of label places for these edges, whose lines are known."""
        lines = self._lines
        shapes = {edge: lines.shapes[edge] for edge in edges}
        sizes, away = list(map(self.size, shapes)), lines.picture.careful and not self.dragged
        style = lines.style
        found = LabelChoice(shapes, sizes, self.places, style.compact, away, self._waits)
        if not lines.picture.small:
            found.beside = self._beside
        return found

    def _waits(self, edge: int) -> bool:
        """Return whether an edge has exactly one other line between its two states, and the label
        of that one has no place yet.
        """
        picture = self._lines.picture
        a, b = int(picture.source[edge]), int(picture.target[edge])
        if a == b or b < 0:
            return False
        pair = self._lines.pair(a, b)
        others = [one for one in (*pair.there, *pair.back) if one != edge]
        return len(others) == 1 and self.rects.get(others[0]) is None

    def _beside(self, edge: int) -> list[EdgeShape]:
        """Return the other lines between the states of an edge, as far as they are drawn.

        Between compact nodes one above the other there are none: names beside such lines would make
        the drawing so wide that fewer names have room.
        """
        lines, picture = self._lines, self._lines.picture
        a, b = int(picture.source[edge]), int(picture.target[edge])
        if a == b or b < 0:
            return []
        dx, dy = np.abs(lines.boxes[b, :2] - lines.boxes[a, :2]).tolist()
        if lines.style.compact and dx <= STEEP * dy:
            return []
        pair, shapes = lines.pair(a, b), lines.shapes
        others = (other for other in (*pair.there, *pair.back) if other != edge)
        return [shapes[other] for other in others if other in shapes]
