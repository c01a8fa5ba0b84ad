"""The part of a drawing that looks different after an edit, so that only this part is painted."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple, TypeVar

from PySide6.QtCore import QRectF

from smsl_studio.picture.hidden_names import RADIUS
from smsl_studio.picture.labels import Rect, centred
from smsl_studio.picture.levels import Level
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Face
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.studio.base.canvas.lit_labels import MOST, by_weight
from smsl_studio.studio.base.canvas.sheet import MANY_EDGES, POOL, Sheet
from smsl_studio.studio.base.paint.edge_paint import EdgeText, label_size
from smsl_studio.studio.base.paint.node_paint import MARGIN

AROUND = 34.0
"""The room around a line or label for arrowheads and signs (mark pixels)."""
Key = TypeVar("Key")
Edge = tuple[str, str]
"""The source and the name of an operation."""


class NodePart(NamedTuple):
    """What a node looks like: its sides, its content, and the place of the initial mark."""

    sides: Rect
    face: Face
    shift: float


class EdgePart(NamedTuple):
    """What an edge looks like: its line, the place of its label, and what that says."""

    shape: EdgeShape
    label: Rect | None
    text: EdgeText

    def is_like(self, other: EdgePart) -> bool:
        """Whether another edge looks the same."""
        return self[1:] == other[1:] and self.shape.is_like(other.shape)


class PaintedParts:
    """What the states, operations and marks of a drawing look like, by their names.

    Of a large drawing only what is in view is told. Create it after the layout of the drawing is
    done.
    """

    def __init__(self, sheet: Sheet, view: Rect) -> None:
        self.sheet, self.dragged = sheet, QRectF()
        """``dragged`` is the part of the scene in which drags have changed the drawing since."""
        picture, geometry = sheet.picture, sheet.geometry
        self.view = None if picture.small else view
        self.unit, self.level, self._version = sheet.unit, sheet.level, sheet.version
        names, halves = picture.names, sheet.halves().tolist()
        states = range(len(names)) if picture.small else sheet.states_in(*view)
        self.nodes: dict[str, NodePart] = {}
        self.numbers = {names[state]: state for state in states}
        for name, state in self.numbers.items():
            (x, y), (w, h), face = sheet.at[state].tolist(), halves[state], picture.face(state)
            shift = geometry.mark_shift if face.initial else 0.0
            self.nodes[name] = NodePart((x - w, y - h, x + w, y + h), face, shift)
        edges = range(len(picture.operations)) if picture.small else _edges_in(sheet, view)
        self.edges = {
            _key(sheet, edge): EdgePart(*drawn, sheet.text(edge))
            for edge, drawn in zip(edges, geometry.drawn(edges), strict=True)
        }
        self.hidden = {
            tuple(map(picture.address, names.edges)): names.at
            for names in sheet.labels.hidden.of(edges)
            if names.radius
        }

    def is_of(self, sheet: Sheet, view: Rect) -> bool:
        """Whether these are the parts of a sheet as it is now, except where it was dragged."""
        now = sheet, sheet.version, sheet.unit, sheet.level
        seen = self.view is None or self.view == view
        return seen and (self.sheet, self._version, self.unit, self.level) == now

    def drag(self, area: QRectF) -> None:
        """Note that one step of a drag has changed the drawing inside this part of the scene."""
        if self.sheet.version == self._version + 1:
            self.dragged |= area
            self._version += 1

    def node_sides(self, name: str) -> Rect | None:
        """The rectangle of a node, None if there is none of this name."""
        found = self.nodes.get(name)
        return found.sides if found is not None else None

    def edge_sides(self, key: Edge) -> Rect | None:
        """The rectangle around the line and the label of an operation, None if there is none."""
        if key not in self.edges:
            return None
        shape, label, text = self.edges[key]
        if label is None:
            w, h = label_size(text, self.sheet.ink)
            label = centred(shape.at(shape.length / 2), (w * self.unit, h * self.unit))
        left, top, right, bottom = shape.bounds
        return (
            min(left, label[0]), min(top, label[1]), max(right, label[2]), max(bottom, label[3])
        )  # fmt: skip


class ChangedArea:
    """Where a drawing of an SB differs from the one before, and which states look the same.

    ``rect`` is the part of the view with all differences, None if they may be anywhere. It is told
    for pictures in which only states and operations are drawn, each by itself. ``parts`` are those
    of the new drawing if they were compared. To lay out a picture that is not shown yet, only to
    know its parts, would take as long as to show it.
    """

    def __init__(self, known: PaintedParts | None, after: Sheet | None, view: Rect) -> None:
        """``known`` are the parts of the drawing before, None if they are not known.

        ``view`` is the visible part of the scene.
        """
        self.rect: QRectF | None = None
        self.kept: dict[int, int] = {}
        """The states that look the same: their numbers after the edit by those before it."""
        self.parts: PaintedParts | None = None
        if known is None or after is None or not _are_alike(known, after, view):
            return
        if _is_plain(after, view):
            self.parts = PaintedParts(after, view)
            self.rect = QRectF(known.dragged)
            self._compare(known, self.parts)

    def _compare(self, old: PaintedParts, new: PaintedParts) -> None:
        before, after = old.sheet, new.sheet
        states, edges = {*_different(old.nodes, new.nodes)}, {*_redrawn(old.edges, new.edges)}
        if before is not after:
            states.update(_different(_node_looks(before, after), _node_looks(after, before)))
            lit = [{_key(one, e): one.edge_look(e) for e in one.looks.lit_edges}
                   for one in (before, after)]  # fmt: skip
            edges.update(_different(*lit))
        for parts in (old, new):
            for name in states:
                self._add(parts.node_sides(name), MARGIN * parts.unit)
            for edge in edges:
                self._add(parts.edge_sides(edge), AROUND * parts.unit)
        for names in _different(old.hidden, new.hidden):
            for parts in (old, new):
                if (at := parts.hidden.get(names)) is not None:
                    self._add((*at, *at), 2.0 * RADIUS * parts.unit)
        was, now = old.numbers, new.numbers
        self.kept = {was[n]: now[n] for n in was if n in now and n not in states}

    def _add(self, sides: Rect | None, room: float) -> None:
        """Add a rectangle with so much room around it (scene units)."""
        if sides is not None and self.rect is not None:
            left, top, right, bottom = sides
            rect = QRectF(left, top, right - left, bottom - top)
            self.rect |= rect.adjusted(-room, -room, room, room)


class LastPainting:
    """What a canvas has painted, to tell later what looks different."""

    def __init__(self) -> None:
        self._parts: PaintedParts | None = None

    def parts(self, sheet: Sheet | None, view: Rect) -> PaintedParts | None:
        """What a sheet looks like on the screen. None if this is not known."""
        if sheet is None or not _is_plain(sheet, view):
            return None
        if self._parts is not None and self._parts.is_of(sheet, view):
            return self._parts
        return PaintedParts(sheet, view) if _is_laid_out(sheet) else None

    def renew(self, sheet: Sheet, view: Rect) -> None:
        """Note what a sheet looks like now, after all of it was painted again."""
        self._parts = self.parts(sheet, view)

    def drag(self, area: QRectF) -> None:
        """Note that one step of a drag has changed the drawing inside this part of the scene."""
        if self._parts is not None:
            self._parts.drag(area)

    def change(self, known: PaintedParts | None, after: Sheet | None, view: Rect) -> ChangedArea:
        """What looks different on a sheet, which is painted next. ``known`` is what ``parts`` gave
        before the change.
        """
        changed = ChangedArea(known, after, view)
        self._parts = changed.parts
        return changed


def _is_plain(sheet: Sheet, view: Rect) -> bool:
    """Whether only states and operations are drawn, each by itself, and nothing runs."""
    picture, looks = sheet.picture, sheet.looks
    if picture.collapsed or sheet.level < Level.COMPACT or looks.quiet:
        return False
    plain = replace(looks.marks, selection=(), findings={}) == Marks()
    if not plain or sheet.drawn.listed():
        return False
    few = picture.small or len(sheet.edges_in(*view)) <= MANY_EDGES
    return few and (picture.small or len(sheet.states_in(*view)) <= POOL)


def _is_laid_out(sheet: Sheet) -> bool:
    """Whether lines and labels lie where they were laid out, and no drag has moved them."""
    geometry = sheet.geometry
    if not sheet.picture.small:
        return not geometry.dragged
    edges, routing = range(len(sheet.picture.operations)), geometry.routing
    return routing is not None and all(
        shape is routing.shapes.get(edge) and label == routing.labels.get(edge)
        for edge, (shape, label) in zip(edges, geometry.drawn(edges), strict=True)
    )


def _edges_in(sheet: Sheet, view: Rect) -> list[int]:
    """The edges in view. Their labels choose their places: the highlighted ones first."""
    edges: list[int] = sheet.edges_in(*view).tolist()
    sheet.geometry.prepare(edges)
    lit = by_weight(sheet)
    for edge in reversed(lit if len(lit) <= MOST else []):
        sheet.geometry.label(edge)
    return edges


def _are_alike(old: PaintedParts, after: Sheet, view: Rect) -> bool:
    """Whether what is the same in a drawing and in the one after it is painted in the same way."""
    before = old.sheet
    if (before.zoom, before.ink) != (after.zoom, after.ink):
        return False
    looked_at = None if after.picture.small else view
    views = (old.unit, old.level, old.view), (after.unit, after.level, looked_at)
    return views[0] == views[1] and before.is_of(after.picture.branch.name)


def _different(old: Mapping[Key, object], new: Mapping[Key, object]) -> Iterator[Key]:
    """The keys with other values."""
    yield from (key for key, value in new.items() if old.get(key) != value)
    yield from (key for key in old if key not in new)


def _redrawn(old: Mapping[Edge, EdgePart], new: Mapping[Edge, EdgePart]) -> Iterator[Edge]:
    """The operations that look different."""
    for key, part in new.items():
        before = old.get(key)
        if before is None or not before.is_like(part):
            yield key
    yield from old.keys() - new.keys()


def _node_looks(sheet: Sheet, other: Sheet) -> dict[str, Hashable]:
    """The looks of the states with a highlight on one of two sheets. All others look plain."""
    index, both = sheet.picture.index, (sheet, other)
    names = [one.picture.names[state] for one in both for state in one.looks.marked_states]
    return {name: sheet.node_look(index[name]) for name in names if name in index}


def _key(sheet: Sheet, edge: int) -> Edge:
    picture = sheet.picture
    return picture.names[picture.source[edge]], picture.operations[edge]
