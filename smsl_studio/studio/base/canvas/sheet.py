"""Sheet: what the painters read. Picture, positions, level of detail, geometry, looks.

A change of marks, a hover or a drag updates looks and a few shapes; nothing else is computed again.
All lengths are scene units. ``unit`` is the number of scene units in one mark pixel: 1 for full
nodes and from 100 % on, otherwise so many that signs keep their size on the screen.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import chain, repeat

import numpy as np

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture.curves import LineStyle, meets
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.held_routes import Routing
from smsl_studio.picture.labels import meet
from smsl_studio.picture.levels import (
    BOX_SIZE,
    COMPACT_SIZE,
    DOT_SIZE,
    FULL_SIZE,
    Level,
    Spacing,
    level_at,
    spacing_of,
    unit_at,
)
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.name_room import with_room
from smsl_studio.picture.picture import SMALL_STATES, Picture
from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnSheet
from smsl_studio.studio.base.canvas.edge_reaches import EdgeReaches, Numbers
from smsl_studio.studio.base.canvas.label_texts import LabelTexts
from smsl_studio.studio.base.canvas.line_key import LineKey, line_key
from smsl_studio.studio.base.canvas.opened import opened
from smsl_studio.studio.base.paint import edge_paint, node_paint
from smsl_studio.studio.base.paint.edge_paint import EdgeText
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.paint.looks import Looks
from smsl_studio.studio.base.paint.node_paint import compact_width, full_width

Position = tuple[float, float]
MOST_HELD = 3.0
"""How many times as large or as small a picture gets at most while its marks keep their sizes."""
MANY_EDGES = 700
"""With more edges than this in view they are painted in a batch."""
POOL = 320
"""The most near nodes that get an item of their own; if there are more, a layer paints them."""
KEPT_UNITS = 8
"""How many zooms of compact nodes keep their lines and labels."""


class Sheet:
    """One SB as the canvas shows it now. States and edges are known by their numbers."""

    def __init__(
        self,
        picture: Picture,
        positions: Mapping[str, Position],
        ink: Ink,
        marks: Marks,
        former: Sheet | None = None,
    ) -> None:
        """``former`` is the sheet of the same SB before an edit; its routing is reused."""
        self.picture, self.ink = picture, ink
        self.at: Floats = self._places(positions)
        self.lines: dict[int, EdgeLayout] = picture.edge_layouts()
        """The edges whose line or label is drawn by hand."""
        self.looks = Looks(picture, marks)
        self.picture = opened(picture, self.looks)
        self.zoom = self.unit = self._laid_at = 1.0
        self.level = Level.FULL
        self.version = 0
        """Increased whenever lines or labels change their place."""
        self._halves: tuple[tuple[Level, float], Floats] | None = None
        self._measure()
        self.spacing, self.spaced = self._spacing(former)
        """``spaced`` are the places for which the spacing was computed."""
        self._geometry: dict[LineKey, Geometry] = {}
        self._former = former.routings if former is not None else {}
        self._reaches = EdgeReaches(picture)
        self.labels = LabelTexts(self)
        self.set_zoom(1.0)
        self.drawn = DrawnSheet(self)

    def _measure(self) -> None:
        """Compute the widths of all nodes. In a large SB all get the largest width of a sample."""
        count = len(self.picture)
        few = count <= SMALL_STATES
        sample = range(count) if few else range(0, count, count // 50)
        faces = [self.picture.face(i) for i in sample]
        full = np.array([full_width(f, self.ink) for f in faces])
        compact = np.array([compact_width(f, self.ink) for f in faces])
        if not few:
            full, compact = np.full(count, full.max()), np.full(count, compact.max())
        else:
            compact = with_room(self.at, full, compact, faces)
        self.full_widths, self.compact_widths = full, compact

    def _spacing(self, former: Sheet | None) -> tuple[Spacing, Floats]:
        """The spacing and the places for which it is computed.

        They are those of ``former`` if its nodes have the same places and widths.
        """
        pairs = () if former is None else (
            (former.spaced, self.at), (former.full_widths, self.full_widths),
            (former.compact_widths, self.compact_widths))  # fmt: skip
        if former is not None and all(np.array_equal(*pair) for pair in pairs):
            return former.spacing, former.spaced
        return spacing_of(self.at, self.full_widths, self.compact_widths), self.at.copy()

    def is_of(self, branch: str) -> bool:
        """Whether this sheet shows the SB of this name."""
        return self.picture.branch.name == branch

    @property
    def compact(self) -> bool:
        """Whether nodes show less than their full name and facts."""
        return self.level is not Level.FULL

    def set_zoom(self, zoom: float, turning: bool = False) -> None:
        """Set the zoom (1.0 is 100 %), and the level of detail and unit that follow from it.

        While the zoom is ``turning``, a small picture keeps those for which lines are known.
        """
        self.zoom, level = zoom, level_at(zoom, self.spacing)
        unit = unit_at(zoom, level)
        known = line_key(level, unit) in self._geometry
        far = max(zoom / self._laid_at, self._laid_at / zoom) > MOST_HELD
        if known or far or not turning or not self.picture.small:
            self.level, self.unit, self._laid_at = level, unit, zoom

    def move(self, places: Mapping[int, Position]) -> list[int]:
        """Move states during a drag (scene points by number); returns the edges that changed.

        If both states of an edge move by the same way, its bends go along.
        """
        self.version += 1
        present = line_key(self.level, self.unit)
        self._geometry = {k: g for k, g in self._geometry.items() if k == present or not k[0]}
        for edge, layout in self.lines.items():
            ends = int(self.picture.source[edge]), int(self.picture.target[edge])
            if layout.bends and all(end in places for end in ends):
                (x, y), other = (np.array(places[end]) - self.at[end] for end in ends)
                if abs(other[0] - x) < 0.1 and abs(other[1] - y) < 0.1:
                    self.lines[edge] = layout.moved(float(x), float(y))
        for state, place in places.items():
            self.at[state] = place
        edges: dict[int, None] = {}
        for geometry in self._geometry.values():
            for state in places:
                geometry.boxes[state, :2] = self.at[state]
            edges.update(dict.fromkeys(geometry.forget(places)))
        return list(edges)

    def stand(self, positions: Mapping[str, Position]) -> None:
        """Put all states and lines where they belong, after a move or its undo."""
        at = self._places(positions)
        moved = np.nonzero((at != self.at).any(axis=1))[0].tolist()
        self.move({state: tuple(at[state].tolist()) for state in moved})
        self.lines = self.picture.edge_layouts()
        self.picture = opened(self.picture, self.looks)

    def redraw(self, edge: int, layout: EdgeLayout) -> None:
        """Draw a line in another way during a drag."""
        self.version += 1
        self.lines[edge] = layout
        if not layout:
            del self.lines[edge]
        for geometry in self._geometry.values():
            geometry.redraw(edge)

    def _places(self, positions: Mapping[str, Position]) -> Floats:
        """Positions by number."""
        places = map(positions.get, self.picture.names, repeat((0.0, 0.0)))
        return np.fromiter(chain.from_iterable(places), np.float64, 2 * len(self.picture)).reshape(
            -1, 2
        )

    @property
    def routings(self) -> dict[LineKey, Routing]:
        """The routing of a small picture."""
        full = {key: one for key, one in self._former.items() if not key[0]}
        found = ((key, one.routing) for key, one in self._geometry.items())
        return full | {key: one for key, one in found if one is not None}

    def _route_anew(self) -> None:
        self.version += 1
        self._former, self._geometry = self.routings, {}

    def settle(self) -> None:
        """Route and label again, after states were moved."""
        self._route_anew()
        self.spacing, self.spaced = self._spacing(None)
        self.set_zoom(self.zoom)

    def change_marks(self, marks: Marks) -> tuple[set[int], set[int]]:
        """Set other marks; returns the numbers of the states and edges that look different now.

        Findings change the width of labels, so a small picture is labelled again. In a collapsed
        one a selected state opens its bundles.
        """
        relabel = marks.findings != self.looks.marks.findings and self.picture.small
        changed = self.looks.change(marks)
        picture = opened(self.picture, self.looks)
        relabel = relabel or picture is not self.picture
        self.picture = picture
        if relabel:
            self._route_anew()
            return changed[0], set(range(len(self.picture.operations)))
        return changed

    # Nodes

    def width(self, state: int) -> float:
        """The width of a state's node in mark pixels."""
        return float((self.compact_widths if self.compact else self.full_widths)[state])

    @property
    def height(self) -> float:
        """The height of near nodes in mark pixels."""
        return COMPACT_SIZE[1] if self.compact else FULL_SIZE[1]

    def halves(self, states: slice | int = slice(None)) -> Floats:
        """Half the width and height of every node at this level, (n, 2), in scene units; or of
        one state, (2,)."""
        key = self.level, self.unit
        if self._halves is None or self._halves[0] != key:
            self._halves = key, self._all_halves()
        return self._halves[1][states]

    def _all_halves(self) -> Floats:
        """All halves. Nobody may write into them, because they are kept for this zoom."""
        if self.level in (Level.DOT, Level.BOX):
            size = np.array(DOT_SIZE if self.level is Level.DOT else BOX_SIZE)
            size = np.broadcast_to(size, self.at.shape)
        else:
            widths = self.compact_widths if self.compact else self.full_widths
            size = np.stack([widths, np.full_like(widths, self.height)], axis=-1)
        halves = size / 2 * self.unit
        halves.flags.writeable = False
        return halves

    def extent(self) -> tuple[Floats, Floats]:
        """The least and the greatest (x, y) of the states' centres and of all bends."""
        bends = [layout.bends for layout in self.lines.values() if layout.bends]
        points = np.vstack([self.at, *map(np.array, bends)]) if bends else self.at
        return points.min(axis=0), points.max(axis=0)

    def states_in(self, left: float, top: float, right: float, bottom: float) -> list[int]:
        """The states whose nodes touch a rectangle (scene units)."""
        half = self.halves()
        x, y = self.at[:, 0], self.at[:, 1]
        inside = (
            (x + half[:, 0] >= left)
            & (x - half[:, 0] <= right)
            & (y + half[:, 1] >= top)
            & (y - half[:, 1] <= bottom)
        )
        found: list[int] = np.nonzero(inside)[0].tolist()
        return found

    def state_at(self, x: float, y: float, reach: float = 0.0) -> int:
        """The state whose node is at a scene point, -1 for none.

        ``reach`` widens nodes (pixels).
        """
        if not len(self.at):
            return -1
        half = self.halves() + reach * self.unit
        # Highlighted nodes are never smaller than compact, so they are hit in that size.
        if self.level < Level.COMPACT:
            for state in self.looks.lit_states:
                half[state] = (
                    self.compact_widths[state] / 2 * self.unit,
                    COMPACT_SIZE[1] / 2 * self.unit,
                )
        off = np.abs(self.at - (x, y))
        inside = np.nonzero((off <= half).all(axis=1))[0]
        if not len(inside):
            return -1
        near = (off[inside] ** 2).sum(axis=1)
        return int(inside[near.argmin()])

    # Edges

    @property
    def geometry(self) -> Geometry:
        """Lines and labels for the present level and unit, computed when first needed."""
        key = compact, far, unit = line_key(self.level, self.unit)
        found = self._geometry.get(key)
        if found is None:
            self._forget_oldest()
            found = self._geometry[key] = Geometry(
                self.picture,
                self._boxes(unit),
                LineStyle(unit, compact, far=far),
                self.labels.sizes(unit),
                self.lines,
                self._former.pop(key, None),
            )
        return found

    def _forget_oldest(self) -> None:
        """Make room for another geometry of compact nodes.

        The last ones are needed again by a fit to the view and by a wheel that turns to and fro.
        """
        compact = [key for key in self._geometry if key[0]]
        for key in compact[: max(0, len(compact) - KEPT_UNITS + 1)]:
            del self._geometry[key]

    def _boxes(self, unit: float) -> Floats:
        widths = self.compact_widths if self.compact else self.full_widths
        half = np.column_stack([widths, np.full(len(widths), self.height)]) / 2 * unit
        return np.hstack([self.at, half.reshape(-1, 2)])

    def text(self, edge: int) -> EdgeText:
        """The label of an edge."""
        return self.labels.text(edge)

    def edges_in(self, left: float, top: float, right: float, bottom: float) -> Numbers:
        """The numbers of edges whose line, roughly, touches a rectangle."""
        if not len(self.picture.source):
            return np.zeros(0, dtype=np.intp)
        if self._reaches.version != self.version:
            self._reaches.compute(self.version, self.at, self.lines)
        # Parallel lanes, self loops and labels with a leader leave the line between two states.
        room = (170.0 if self.picture.careful else 60.0) * self.unit
        found = self._reaches.touching((left, top, right, bottom), room)
        if not self.picture.bundles.back or self.level < Level.COMPACT:
            return found
        ways = self._ways_in(left, top, right, bottom)
        return np.union1d(found, np.array(ways, dtype=np.intp))

    def _ways_in(self, left: float, top: float, right: float, bottom: float) -> list[int]:
        """The edges that lead back to the start by the lane and through a rectangle."""
        pad, bundles = 12.0 * self.unit, self.picture.bundles
        own = [edge for edge in bundles.back if edge not in bundles.hidden]
        box = left - pad, top - pad, right + pad, bottom + pad
        return [edge for edge in own if meet(self.geometry.shape(edge).bounds, box)]

    def edge_at(self, x: float, y: float, reach: float = 5.0) -> int:
        """The edge whose label or line is at a scene point, -1 for none; ``reach`` is in pixels."""
        if self.level < Level.COMPACT:
            near: Iterable[int] = map(self.picture.line_of, self.looks.lit_edges)
        else:
            r = reach * self.unit
            every = self.edges_in(x - r, y - r, x + r, y + r).tolist()
            near = dict.fromkeys(map(self.picture.line_of, every))
        geometry = self.geometry
        best, distance = -1, reach * self.unit
        for edge in near:
            rect = geometry.label(edge)
            if rect and rect[0] <= x <= rect[2] and rect[1] <= y <= rect[3]:
                return edge
            shape = geometry.shape(edge)
            left, top, right, bottom = shape.bounds
            r = distance
            if left - r <= x <= right + r and top - r <= y <= bottom + r:
                away = shape.distance(x, y)
                if away < distance:
                    best, distance = edge, away
        return best

    def operation_at(self, x: float, y: float) -> int:
        """The one operation whose label or line is at a scene point, -1 for none or a bundle."""
        edge = self.edge_at(x, y)
        return -1 if self.picture.bundles.count(edge) else edge

    def is_drawn_on(self, left: float, top: float, right: float, bottom: float) -> bool:
        """Whether a rectangle (scene units) touches a node, a note, a group's title, or a line of
        a small picture."""
        sides = left, top, right, bottom
        if self.states_in(*sides) or self.drawn.touches(*sides):
            return True
        if not self.picture.small or self.level < Level.COMPACT:
            return False
        box = np.array([[left + right, top + bottom, right - left, bottom - top]]) / 2
        near = self.edges_in(left, top, right, bottom).tolist()
        return any(meets(self.geometry.shape(edge).points, box, (), 0.0) for edge in near)

    # Looks

    def address_of_state(self, state: int) -> Address:
        """The address of the state with this number."""
        return Address(self.picture.branch.name, self.picture.names[state])

    def node_look(self, state: int) -> node_paint.NodeLook:
        """The present look of the state with this number."""
        return self.looks.node(state)

    def edge_look(self, edge: int) -> edge_paint.EdgeLook:
        """The present look of the edge with this number."""
        return self.looks.edge(edge)
