"""The part of a drawing that looks different after an edit, so that only this part is painted."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

from PySide6.QtCore import QRectF

from smsl_studio.picture.hidden_names import RADIUS, HiddenMarks
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.levels import Level
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.node_paint import MARGIN

AROUND = 34.0
"""The room around a line or label for arrowheads and signs (mark pixels)."""
Key = TypeVar("Key")
Edge = tuple[str, str]
"""The source and the name of an operation."""


class PaintedParts:
    """What the states, operations and marks of a small drawing look like, by their names.

    Create it after the layout of the drawing is done. A later drag makes it invalid.
    """

    def __init__(self, sheet: Sheet) -> None:
        self.sheet, self._when = sheet, (sheet.version, sheet.unit, sheet.level)
        picture, geometry = sheet.picture, sheet.geometry
        names, ends = picture.names, picture.source.tolist()
        faces, halves = map(picture.face, range(len(names))), sheet.halves().tolist()
        self.nodes: dict[str, tuple[Hashable, ...]] = {
            name: (face, *at, *half, geometry.mark_shift if face.initial else 0.0)
            for name, face, at, half in zip(names, faces, sheet.at.tolist(), halves, strict=True)
        }
        self.edges: dict[Edge, tuple[Hashable, ...]] = {
            (names[source], operation): (
                geometry.shape(edge), geometry.label(edge), sheet.text(edge)
            )
            for edge, (source, operation) in enumerate(zip(ends, picture.operations, strict=True))
        }  # fmt: skip
        self.hidden = {
            tuple(map(picture.address, names.edges)): names.at
            for names in HiddenMarks(geometry).of(range(len(ends)))
        }

    def is_of(self, sheet: Sheet) -> bool:
        """Whether these are the parts of a sheet as it is now."""
        return self.sheet is sheet and self._when == (sheet.version, sheet.unit, sheet.level)


class ChangedArea:
    """Where a drawing of an SB differs from the one before, and which states look the same.

    ``rect`` is the part of the scene with all differences, None if they may be anywhere. It is
    told for small pictures in which only states and operations are drawn, each by itself.
    ``parts`` are those of the new drawing, if it is such a picture.
    """

    def __init__(
        self, before: Sheet | None, after: Sheet | None, known: PaintedParts | None
    ) -> None:
        """``known`` are the parts of the drawing before, when it was shown."""
        self.rect: QRectF | None = None
        self.kept: dict[int, int] = {}
        """The states that look the same: their numbers after the edit by those before it."""
        self.parts = PaintedParts(after) if after is not None and _is_plain(after) else None
        if before is None or after is None or self.parts is None or not _is_plain(before):
            return
        if _is_alike(before, after):
            if known is None or not known.is_of(before):
                known = PaintedParts(before) if _is_laid_out(before) else None
            if known is not None:
                self.rect = QRectF()
                self._compare(known, self.parts)

    def _compare(self, old: PaintedParts, new: PaintedParts) -> None:
        sheets = old.sheet, new.sheet
        looks = [{n: one.node_look(i) for n, i in one.picture.index.items()} for one in sheets]
        states = {*_different(old.nodes, new.nodes), *_different(*looks)}
        lit = [{_key(one, e): one.edge_look(e) for e in one.looks.lit_edges} for one in sheets]
        edges = {*_different(old.edges, new.edges), *_different(*lit)}
        for one in sheets:
            for name in states:
                self._add(one, _node_sides(one, name), MARGIN)
            for edge in edges:
                self._add(one, _edge_sides(one, edge), AROUND)
        for names in _different(old.hidden, new.hidden):
            for parts in (old, new):
                if (at := parts.hidden.get(names)) is not None:
                    self._add(parts.sheet, (*at, *at), 2.0 * RADIUS)
        was, now = (one.picture.index for one in sheets)
        self.kept = {was[n]: now[n] for n in old.nodes if n in new.nodes and n not in states}

    def _add(self, sheet: Sheet, sides: Rect | None, pad: float) -> None:
        """Add a rectangle with so much room around it (mark pixels)."""
        if sides is not None and self.rect is not None:
            left, top, right, bottom = sides
            room = pad * sheet.unit
            rect = QRectF(left, top, right - left, bottom - top)
            self.rect |= rect.adjusted(-room, -room, room, room)


def _is_plain(sheet: Sheet) -> bool:
    """Whether only states and operations are drawn, each by itself, and nothing runs."""
    picture, looks = sheet.picture, sheet.looks
    if not picture.small or picture.collapsed or sheet.level < Level.COMPACT or looks.quiet:
        return False
    plain = replace(looks.marks, selection=(), findings={}) == Marks()
    return plain and not sheet.drawn.listed()


def _is_laid_out(sheet: Sheet) -> bool:
    """Whether lines and labels lie where they were laid out, and no drag has moved them."""
    geometry, routing = sheet.geometry, sheet.geometry.routing
    shape, label = geometry.shape, geometry.label
    return routing is not None and all(
        shape(edge) is routing.shapes.get(edge) and label(edge) == routing.labels.get(edge)
        for edge in range(len(sheet.picture.operations))
    )


def _is_alike(before: Sheet, after: Sheet) -> bool:
    """Whether what is the same in two sheets is painted in the same way."""
    views = [(one.zoom, one.level, one.unit, one.ink) for one in (before, after)]
    return views[0] == views[1] and before.is_of(after.picture.branch.name)


def _different(old: Mapping[Key, object], new: Mapping[Key, object]) -> Iterator[Key]:
    """The keys with other values."""
    yield from (key for key, value in new.items() if old.get(key) != value)
    yield from (key for key in old if key not in new)


def _key(sheet: Sheet, edge: int) -> Edge:
    picture = sheet.picture
    return picture.names[picture.source[edge]], picture.operations[edge]


def _node_sides(sheet: Sheet, name: str) -> Rect | None:
    state = sheet.picture.index.get(name, -1)
    if state < 0:
        return None
    (x, y), (w, h) = sheet.at[state].tolist(), sheet.halves(state).tolist()
    return x - w, y - h, x + w, y + h


def _edge_sides(sheet: Sheet, key: Edge) -> Rect | None:
    """The rectangle around the line and the label of an operation."""
    edge, geometry = sheet.picture.numbered(*key), sheet.geometry
    if edge < 0:
        return None
    one, other = geometry.shape(edge).bounds, geometry.label(edge) or geometry.fallback(edge)
    (left, top), (right, bottom) = map(min, one[:2], other[:2]), map(max, one[2:], other[2:])
    return left, top, right, bottom
