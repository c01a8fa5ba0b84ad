"""Figure: one SB laid out for a file, with places and sizes of nodes, lines, labels and level of
detail.

A file cannot be zoomed or pointed at. So a small SB is enlarged until every node has room and every
label has a place. A large SB keeps its layout and shows less of each element.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import chain

import numpy as np

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.legible import one_line
from smsl_studio.picture.chip_words import CHIP_TEXT, GAP, text_room
from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.drawn_parts import BAR, DrawnParts
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.labels import AsideRect
from smsl_studio.picture.levels import COMPACT_SIZE, FULL_SIZE, Level, rest_mark, spacing_of
from smsl_studio.picture.node_rows import TITLED
from smsl_studio.picture.picture import Chip, Face, Picture
from smsl_studio.picture.shape import Floats, Point
from smsl_studio.picture.words import elided, mono_width, width
from smsl_studio.stop import heed

Rect = tuple[float, float, float, float]
NAME, LABEL, SHORT = 12.0, 11.0, 12.0
WIDEST, LONGEST_LABEL = 320.0, 260.0
MOST_LINES, MOST_LABELS = 3000, 1500
"""With more operations than these, lines are straight or labels are left out. With more states than
MOST_LINES, states are dots.
"""
DOT_PITCH = 26.0
_LARGER = 1.2
_STEPS = 6
_MOST_FOR_LEADERS = 1.4
"""The scale up to which a picture is enlarged so that fewer labels need leaders."""
MARK = 13.0


class Figure:
    """One SB as it is drawn. ``signed`` has the operations whose label carries a sign."""

    def __init__(
        self, picture: Picture, positions: Mapping[str, Point], signed: frozenset[int] = frozenset()
    ) -> None:
        self.picture = picture
        self.signed = signed
        self.at: Floats = np.array(
            [positions.get(name, (0.0, 0.0)) for name in picture.names], dtype=np.float64
        ).reshape(-1, 2)
        self.level = self._level()
        self.faces = [picture.face(i) for i in range(len(picture))] if self.shows_nodes else []
        self.widths = self._widths()
        self.scale = 1.0
        """How much larger the layout is drawn than the canvas draws it at 100 %."""
        self._draw_out()

    @property
    def shows_nodes(self) -> bool:
        """Whether states are boxes with words. Otherwise they are dots."""
        return self.level in (Level.FULL, Level.COMPACT)

    @property
    def shows_facts(self) -> bool:
        """Whether nodes show values of facts, as chips or as the short form of a name."""
        if self.level is Level.FULL:
            return any(face.chips for face in self.faces)
        return self.level is Level.COMPACT and self.picture.first_shortened >= 0

    @property
    def shows_labels(self) -> bool:
        """Whether operations have labels."""
        return self.shows_nodes and self.picture.line_count <= MOST_LABELS

    def _level(self) -> Level:
        if self.picture.small:
            return Level.FULL
        many = max(len(self.picture), len(self.picture.operations), self.picture.crowd)
        return Level.COMPACT if many <= MOST_LINES else Level.DOT

    def _widths(self) -> Floats:
        if self.level is Level.FULL:
            return np.array([full_width(face) for face in self.faces])
        if self.level is Level.COMPACT:
            return np.array([compact_width(face) for face in self.faces])
        return np.full(len(self.picture), 6.0)

    def _draw_out(self) -> None:
        """Enlarge the layout until nodes are apart and each label of a small SB has a place."""
        if not self.shows_nodes:
            # The layout was made for boxes, and dots need less room.
            self._enlarge(DOT_PITCH / max(self._pitch(), 1.0))
        elif len(self.at) > 1:
            for _ in range(_STEPS):
                if self._is_roomy():
                    break
                self._enlarge(_LARGER)
        self.geometry = self._geometry()
        self._make_room()

    def _make_room(self) -> None:
        """Enlarge a small SB until all labels have a place. Labels away from their lines are a
        reason as long as it makes them half as many, up to a size: some lines have others on both
        sides at any size, and words in a large picture are small on paper.
        """
        hidden, away = self._without_place()
        for _ in range(_STEPS if self.picture.small else 0):
            if not hidden and (not away or self.scale >= _MOST_FOR_LEADERS):
                break
            before, geometry, scale = self.at, self.geometry, self.scale
            self._enlarge(_LARGER)
            self.geometry = self._geometry()
            found = self._without_place()
            if not hidden and (found[0] or 2 * found[1] > away):
                self.at, self.geometry, self.scale = before, geometry, scale
                break
            hidden, away = found

    def _enlarge(self, factor: float) -> None:
        self.at, self.scale = self.at * factor, self.scale * factor

    def _is_roomy(self) -> bool:
        spacing = spacing_of(self.at, self.widths, self.widths)
        return spacing.roomy if self.level is Level.FULL else spacing.compact_zoom <= 0.9

    def _pitch(self) -> float:
        return spacing_of(self.at, self.widths, self.widths).pitch

    def _geometry(self) -> Geometry:
        style = LineStyle(1.0, self.level is not Level.FULL, self.scale)
        found = Geometry(self.picture, self.boxes, style, self.label_size, self.lines)
        if self.shows_nodes:
            found.prepare(range(len(self.picture.operations)))
        return found

    @cached_property
    def _layouts(self) -> dict[int, EdgeLayout]:
        return self.picture.edge_layouts()

    @property
    def lines(self) -> dict[int, EdgeLayout]:
        """The operations whose line or label is drawn by hand, as large as this drawing."""
        if not self._layouts:
            return self._layouts
        return {edge: layout.scaled(self.scale) for edge, layout in self._layouts.items()}

    def _without_place(self) -> tuple[int, int]:
        """Return how many labels are hidden, and how many stand away from their lines."""
        edges = range(len(self.picture.operations))
        places = list(map(self.geometry.label, edges))
        return places.count(None), sum(isinstance(place, AsideRect) for place in places)

    @property
    def height(self) -> float:
        """The height of every node (pixels)."""
        sizes = {Level.FULL: FULL_SIZE[1], Level.COMPACT: COMPACT_SIZE[1]}
        return sizes.get(self.level, 6.0)

    @cached_property
    def named(self) -> dict[int, float]:
        """The states that have their name beside their dot, each with the width of the name
        (pixels).
        """
        branch, index = self.picture.branch, self.picture.index
        chosen = [name for name in (branch.initial, branch.activating) if name in index]
        return {index[n]: width(elided(n, NAME, LONGEST_LABEL), NAME) + 8.0 for n in chosen}

    def label(self, edge: int) -> str:
        """Return the label of an operation, shortened if it is very long."""
        return elided(self.picture.label(edge), LABEL, LONGEST_LABEL)

    def label_size(self, edge: int) -> tuple[float, float]:
        """Return the width and height of an operation's label (pixels), (0, 0) if it has none."""
        if not self.shows_labels:
            return 0.0, 0.0
        picture = self.picture
        if picture.bundles.count(edge):
            return picture.chip_size(edge)
        signs = bool(picture.kind(edge)) + bool(picture.guards(edge)) + (edge in self.signed)
        return width(self.label(edge), LABEL) + MARK * signs + 8.0, 15.0

    @cached_property
    def drawn(self) -> DrawnParts:
        """The notes and groups."""
        return DrawnParts(self.picture.branch, self.picture.index)

    @property
    def bar(self) -> float:
        """The height of the titles of groups (pixels); 0 where states are dots."""
        return BAR if self.shows_nodes else 0.0

    @property
    def note_rects(self) -> Floats:
        """The left, top, right and bottom of each note, (n, 4) (pixels)."""
        return self.drawn.note_rects(self.at, self.scale)

    @property
    def group_rects(self) -> Floats:
        """The left, top, right and bottom of each group, (n, 4) (pixels)."""
        members = chain.from_iterable(own.tolist() for own in self.drawn.members)
        loops = self.geometry.loops_of(members) if self.shows_nodes else {}
        return self.drawn.group_rects(self.boxes, bar=self.bar, loops=loops)

    @property
    def title_rects(self) -> Floats:
        """The rectangles above whose states the titles of groups stand, (n, 4) (pixels)."""
        return self.drawn.group_rects(self.boxes, bar=self.bar)

    @property
    def boxes(self) -> Floats:
        """The centre and half the size of each node, (n, 4) (pixels)."""
        half = np.column_stack([self.widths, np.full(len(self.at), self.height)]) / 2
        return np.hstack([self.at, half]) if len(self.at) else np.zeros((0, 4))

    def rects_of(self, edge: int) -> tuple[Rect, ...]:
        """Return what an operation covers: its line, and its label if that is shown."""
        heed()
        if not self.shows_nodes:
            source, target = int(self.picture.source[edge]), int(self.picture.target[edge])
            ends = self.at[[source, target if target >= 0 else source]]
            if edge in self.lines and self.lines[edge].bends:
                ends = np.vstack([ends, self.lines[edge].bends])
            (left, top), (right, bottom) = ends.min(axis=0).tolist(), ends.max(axis=0).tolist()
            return ((left, top, right, bottom),)
        label = self.geometry.label(edge)
        line = self.geometry.shape(edge).bounds
        return (line,) if label is None else (line, label)

    def bounds(
        self, states: Sequence[int] | None = None, edges: Sequence[int] | None = None
    ) -> Rect:
        """Return the left, top, right and bottom of what is drawn (pixels): of everything, or of
        these states and operations with the notes and groups that belong to these states.
        """
        notes, groups = self.drawn_with(states)
        found = [*self.note_rects[notes].tolist(), *self.group_rects[groups].tolist()]
        states = range(len(self.at)) if states is None else states
        edges = range(len(self.picture.operations)) if edges is None else edges
        if not len(states):
            found.append([0.0, 0.0, 160.0, 20.0])
        else:
            found.extend(self._rects(states, edges))
        rects = np.array(found)
        left, top = rects[:, :2].min(axis=0)
        right, bottom = rects[:, 2:].max(axis=0)
        return float(left), float(top), float(right), float(bottom)

    def drawn_with(self, states: Sequence[int] | None) -> tuple[list[int], list[int]]:
        """Return the numbers of the notes that hang on some states, and of the groups that have no
        others. Without ``states`` all of them.
        """
        drawn = self.drawn
        if states is None or not drawn:
            return list(range(len(drawn.notes))), list(range(len(drawn.groups)))
        notes = np.nonzero(np.isin(drawn.states, list(states)))[0].tolist()
        groups = [n for n, own in enumerate(drawn.members) if np.isin(own, list(states)).all()]
        return notes, groups

    def _rects(self, states: Sequence[int], edges: Sequence[int]) -> list[Sequence[float]]:
        """What some states and operations cover. There are states."""
        boxes = self.boxes[list(states)]
        low = (boxes[:, :2] - boxes[:, 2:]).min(axis=0)
        high = (boxes[:, :2] + boxes[:, 2:]).max(axis=0)
        found: list[Sequence[float]] = [
            (low[0] - 10.0, low[1] - 10.0, high[0] + 10.0, high[1] + 10.0)
        ]
        initial = self.picture.index.get(self.picture.branch.initial, -1)
        if initial in states:
            x, y, w, h = self.boxes[initial]
            found.append((x - w - 30.0, y - h, x - w, y - h))
        if not self.shows_nodes:
            found.extend(self.rects_of(edge)[0] for edge in self.lines if edge in edges)
            for state, wide in self.named.items():
                if state in states:
                    x, y = self.at[state]
                    found.append((x - wide / 2, y - 26.0, x + wide / 2, y))
        else:
            for edge in edges:
                found.extend(self.rects_of(edge))
        return found


def chip_width(chip: Chip) -> float:
    """Return the width of one fact on a node (pixels)."""
    return text_room(chip.text)


def full_width(face: Face) -> float:
    """Return the width of a node with its name and facts (pixels), 108 or more."""
    chips = sum(chip_width(chip) + GAP for chip in face.chips) - GAP
    title = width(one_line(face.title), LABEL)
    words = min(title + 16.0, TITLED) if face.chips else title + 24.0
    wanted = max(width(face.name, NAME) + 24.0, words)
    return min(max(round(wanted), chips + 20.0, FULL_SIZE[0]), WIDEST)


def compact_width(face: Face) -> float:
    """Return the width of a node that shows only its facts (pixels), 46 or more."""
    return min(max(mono_width(face.short, SHORT) + 18.0, COMPACT_SIZE[0]), WIDEST / 2)


def chip_places(face: Face, room: float) -> list[tuple[float, float]]:
    """Return the left side, from the middle of the node, and the width of each chip, in order of
    digits.

    If not all chips fit, there is room after the last one for a mark with the number of the others.
    """
    widths = [chip_width(chip) + GAP for chip in face.chips]
    shown = len(widths)
    while shown and _row(widths, shown) > room - 12.0:
        shown -= 1
    x = -_row(widths, shown) / 2
    places = []
    for wide in widths[:shown]:
        places.append((x, wide - GAP))
        x += wide
    return places


def _row(widths: list[float], shown: int) -> float:
    """Return the width of the first ``shown`` chips and of the mark for the others."""
    rest = len(widths) - shown
    mark = mono_width(rest_mark(rest), CHIP_TEXT) + GAP if rest else 0.0
    return sum(widths[:shown]) + mark - GAP
