"""Routing: the lines and labels of a small picture, kept for the picture after the next edit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture.curves import Between, LineStyle
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import EdgeShape, Floats


class HeldPair(NamedTuple):
    """A pair of states whose lines an edit has left alone, with the numbers after the edit.

    Only nodes inside ``around`` can change the lines. ``reach`` is the same for lines that do not
    take the usual way, else None. ``clear`` tells whether no other node is in the way, if known.
    """

    pair: Between
    shapes: dict[int, EdgeShape]
    around: Rect
    reach: Rect | None
    clear: bool | None


@dataclass
class Routing:
    """The routing of a picture, before any state was dragged."""

    picture: Picture
    boxes: Floats
    style: LineStyle
    drawn: Mapping[int, EdgeLayout]
    """The edges whose line or label is drawn by hand."""
    shapes: dict[int, EdgeShape] = field(default_factory=dict)
    labels: dict[int, Rect | None] = field(default_factory=dict)
    sizes: dict[int, tuple[float, float]] = field(default_factory=dict)
    """The sizes of labels for which the places were chosen."""
    clear: dict[tuple[int, int], bool] = field(default_factory=dict)
    """For each pair of states whether the straight line between them meets no other node."""
    bent: dict[tuple[int, int], Rect] = field(default_factory=dict)
    """The pairs whose usual lines meet other nodes. Only nodes inside the rectangle of a pair can
    change its lines.
    """
    plain: dict[tuple[int, int], Between] = field(default_factory=dict)
    """The pairs whose lines are not in lanes and not drawn by hand."""
    rects: dict[tuple[int, int], Rect] = field(default_factory=dict)
    """The rectangles of such pairs in which nodes can change their lines, as far as they are
    known.
    """
    readable: list[Rect] = field(default_factory=list)
    """The rectangles of notes and of the titles of groups."""
    mark: Rect | None = None
    """The rectangle of the mark of the initial state."""

    def note_plain(self, pair: Between | None) -> None:
        """Note a pair whose lines depend on nothing but nodes, unless some are drawn by hand."""
        if pair is None:
            return
        back = self.picture.bundles.back
        if not any(edge in self.drawn or edge in back for edge in (*pair.there, *pair.back)):
            self.plain[pair.a, pair.b] = pair

    def keep(self, pairs: Iterable[HeldPair]) -> dict[int, EdgeShape]:
        """Note what is known of some pairs from before the edit, and return their lines."""
        shapes: dict[int, EdgeShape] = {}
        for held in pairs:
            key = held.pair.a, held.pair.b
            self.plain[key], self.rects[key] = held.pair, held.around
            if held.reach is not None:
                self.bent[key] = held.reach
            if held.clear is not None:
                self.clear[key] = held.clear
            shapes |= held.shapes
        return shapes

    def copied(self) -> Routing:
        """Return a copy that a drag does not change."""
        return replace(
            self,
            boxes=self.boxes.copy(),
            shapes=dict(self.shapes),
            labels=dict(self.labels),
            sizes=dict(self.sizes),
            clear=dict(self.clear),
            bent=dict(self.bent),
            plain=dict(self.plain),
            rects=dict(self.rects),
        )
