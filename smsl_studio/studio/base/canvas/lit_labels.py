"""Labels of highlighted edges: beside short lines, clear of nodes and of each other.

An edge is lit (highlighted) if a mark or the pointer is on it, see ``EdgeLook.lit``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from smsl_studio.picture import labels
from smsl_studio.picture.label_candidates import aside
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.levels import COMPACT_SIZE, Level
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.studio.base.canvas.bundle_layer import lines_alone
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.edge_paint import (
    EdgeLook,
    EdgeText,
    boxed_width,
    label_size,
    pill_width,
)

MOST = 400
"""The most labels of highlighted edges.

With more such edges only those get a label that say more than their name. Finding a place takes
about a millisecond, and nobody can read thousands of names.
"""


STEPS = 24
"""The number of points of a line that are tested against a rectangle."""


@dataclass(frozen=True)
class LitLabel:
    """The label of a highlighted edge.

    ``ground`` says that it lies on its line and needs a background. ``pill`` has the words of a
    running operation.
    """

    edge: int
    text: EdgeText
    rect: Rect
    ground: bool = True
    pill: str = ""


class LitLabels:
    """The labels of all highlighted edges of a sheet, computed again only after a change."""

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._found: list[LitLabel] = []

    def of(self, sheet: Sheet, view: Rect) -> list[LitLabel]:
        """The labels now.

        ``view`` is the visible part of the scene; running and possible operations get their label
        inside it.
        """
        looks, marks = sheet.looks, sheet.looks.marks
        seen = view if marks.running or marks.possible or marks.planned or marks.trail else None
        key = (sheet, looks.marks, looks.hovered_edge, sheet.version, sheet.level, sheet.unit, seen)
        if key != self._key:
            self._key = key
            self._found = lit_labels(sheet, by_weight(sheet), view)
        return self._found


def by_weight(sheet: Sheet) -> list[int]:
    """The highlighted edges in the order of painting: the most important is last and on top.

    Edges in bundles are left out.
    """
    # If everything is selected in a large SB, 20,000 edges must not be painted one by one.
    lit = lines_alone(sheet, sheet.looks.lit_edges[:2000])
    return sorted(lit, key=lambda e: _weight(sheet.edge_look(e)))


def _weight(look: EdgeLook) -> int:
    order = (
        look.possible,
        look.joined,
        look.out,
        look.pruned,
        look.held_back,
        look.risky,
        look.planned,
        look.selected,
        look.trail,
        bool(look.finding),
        look.running is not None,
    )
    return max((i + 1 for i, holds in enumerate(order) if holds), default=0)


def lit_labels(sheet: Sheet, edges: Iterable[int], view: Rect) -> list[LitLabel]:
    """The labels of these edges.

    The most important edge is the last; the less important may get no label.
    """
    taken = lit_boxes(sheet)
    found: list[LitLabel] = []
    named = list(edges)[::-1]
    if len(named) > MOST:
        named = [edge for edge in named if _says_more(sheet.edge_look(edge))][:MOST]
    for edge in named:
        label = _label(sheet, edge, taken, view)
        if label is not None:
            taken.append(label.rect)
            found.append(label)
    found.reverse()
    return [*_guards(sheet, taken), *found]


def _guards(sheet: Sheet, taken: list[Rect]) -> Iterator[LitLabel]:
    """The labels of edges with required facts in a run, where there is room.

    Other edges show no name during a run.
    """
    looks = sheet.looks
    if not looks.marks.dimmed or sheet.level < Level.COMPACT:
        return
    for edge in looks.guarded_edges[:MOST]:
        rect = None if looks.is_lit(edge) else sheet.geometry.label(edge)
        if rect is not None and not any(labels.meet(rect, other) for other in taken):
            taken.append(rect)
            yield LitLabel(edge, sheet.text(edge), rect)


def _says_more(look: EdgeLook) -> bool:
    """Whether the label says more than that the edge is selected, possible or on a route."""
    marked = look.pruned or look.held_back or look.risky or look.hovered
    return marked or bool(look.finding or look.change or look.conflict) or look.running is not None


def _label(sheet: Sheet, edge: int, taken: list[Rect], view: Rect) -> LitLabel | None:
    look, shape, text = sheet.edge_look(edge), sheet.geometry.shape(edge), sheet.text(edge)
    if edge in sheet.lines and sheet.lines[edge].label is not None and look.running is None:
        return LitLabel(edge, text, sheet.geometry.label(edge) or sheet.geometry.fallback(edge))
    if look.finding:
        w, h = boxed_width(text, sheet.ink) * sheet.unit, 18.0 * sheet.unit
        rect = sheet.geometry.label(edge) or sheet.geometry.fallback(edge)
        x, y = (rect[0] + rect[2]) / 2, (rect[1] + rect[3]) / 2
        rects = [
            (x - w / 2, y + off - h / 2, x + w / 2, y + off + h / 2)
            for off in (step * sheet.unit for step in (0.0, -14.0, 14.0, -24.0, 24.0))
        ]
        return _first(sheet, edge, text, rects, taken, True)
    if look.running is not None:
        return _pill(sheet, edge, shape, taken, view)
    if look.pruned or look.held_back or look.risky:
        if look.pruned:
            text = replace(text, text=f"{text.text} pruned")
        return _first(sheet, edge, text, _near_sign(sheet, edge, text, shape), taken, False)
    if look.conflict or (sheet.compact and look.change):
        rects = _clear_of_names(sheet, edge, text, shape)
        return _first(sheet, edge, text, rects, taken, True)
    if sheet.compact and (look.trail or look.planned or look.possible):
        # A label would cover a short line, so it stands beside it.
        size = _size(sheet, text)
        gap = (4.0 if look.trail else 2.0) * sheet.unit
        rects = [
            labels.outside(shape, shape.length * share, size, gap, side)
            for shares in ((0.5, 0.35, 0.65), (0.2, 0.8))
            for side in (1, -1)
            for share in shares
        ]
        covered = sheet.geometry.covered(edge, rects)
        rects = [rects[at] for at in sorted(range(len(rects)), key=lambda at: covered[at])]
        own = sheet.geometry.label(edge) if sheet.level >= Level.COMPACT else None
        # Its usual place is at no other line. Without any it stands away, with a leader.
        rects = [*([own] if own else []), *rects, *_away(sheet, shape, size)]
        named = sheet.level >= Level.COMPACT and not sheet.looks.marks.dimmed
        if named and not (own and _is_free(sheet, own, taken)):
            rects = _off_names(sheet, edge, rects) or rects
        if not look.hovered:
            rects = [rect for rect in rects if not _is_cut(rect, view)]
        if not (look.trail or look.planned or look.hovered):
            # A merely possible operation is named only where there is room; the list of operations
            # has the rest.
            rects = [
                r
                for r in rects
                if _lies_in(r, view) and _is_free(sheet, r, taken) and not _on_a_way(sheet, edge, r)
            ]
        if sheet.level < Level.COMPACT and not look.hovered:
            rects = [rect for rect in rects if _is_free(sheet, rect, taken)]
        found = _first(sheet, edge, text, rects, taken, False) if rects else None
        return replace(found, ground=True) if found and found.rect == own else found
    return _plain(sheet, edge, taken)


def _away(sheet: Sheet, shape: EdgeShape, size: tuple[float, float]) -> list[Rect]:
    """Places away from a line, the nearest first; none in a far picture."""
    if sheet.level < Level.COMPACT:
        return []
    return [labels.AsideRect(*rect) for rect in aside([shape], [size], sheet.unit)[0][0].tolist()]


def _off_names(sheet: Sheet, edge: int, rects: list[Rect]) -> list[Rect]:
    """Those of some places that cover no name of an edge without a highlight."""
    near = sheet.edges_in(*_all_of(rects)).tolist()[:NAMES]
    names = [sheet.geometry.label(e) for e in near if e != edge and not sheet.looks.is_lit(e)]
    return [rect for rect in rects if not any(labels.meet(rect, name) for name in names if name)]


def _clear_of_names(sheet: Sheet, edge: int, text: EdgeText, shape: EdgeShape) -> list[Rect]:
    """Places beside a line; those that cover no other edge's name come first."""
    size = _size(sheet, text)
    rects = [
        labels.outside(shape, shape.length * share, size, gap * sheet.unit, side)
        for gap in (2.0, 12.0)
        for side in (1, -1)
        for share in (0.5, 0.3, 0.7)
    ]
    if sheet.level < Level.COMPACT:
        return rects
    near = sheet.edges_in(*_all_of(rects)).tolist()[:NAMES]
    names = [sheet.geometry.label(e) for e in near if e != edge and not sheet.looks.is_lit(e)]
    return sorted(rects, key=lambda rect: sum(labels.meet(rect, n) for n in names if n))


def _all_of(rects: list[Rect]) -> Rect:
    """The smallest rectangle around all of these rectangles."""
    left, top, right, bottom = zip(*rects, strict=True)
    return min(left), min(top), max(right), max(bottom)


def lit_boxes(sheet: Sheet) -> list[Rect]:
    """The rectangles of highlighted nodes that are larger than the others in a far picture."""
    states = sheet.looks.lit_states
    if sheet.level >= Level.COMPACT or len(states) > 60:
        return []
    high = COMPACT_SIZE[1] / 2 * sheet.unit
    boxes: list[Rect] = []
    for state in states:
        x, y = (float(value) for value in sheet.at[state])
        wide = float(sheet.compact_widths[state]) / 2 * sheet.unit
        boxes.append((x - wide, y - high, x + wide, y + high))
    return boxes


def _plain(sheet: Sheet, edge: int, taken: list[Rect]) -> LitLabel | None:
    """A label on its line, or one that is hidden while its edge has no highlight."""
    look, rect = sheet.edge_look(edge), sheet.geometry.label(edge)
    hidden = rect is None or any(labels.meet(rect, other) for other in taken)
    if hidden and not (look.selected or look.hovered or look.change or look.conflict):
        return None
    return LitLabel(edge, sheet.text(edge), rect or sheet.geometry.fallback(edge))


def _size(sheet: Sheet, text: EdgeText) -> tuple[float, float]:
    w, h = label_size(text, sheet.ink)
    return (w - 5.0) * sheet.unit, h * sheet.unit


def _first(
    sheet: Sheet,
    edge: int,
    text: EdgeText,
    rects: list[Rect],
    taken: list[Rect],
    ground: bool,
) -> LitLabel | None:
    """The label in the first of these places that covers neither a node nor a label.

    If there is none, the label is hidden until its edge is hovered. A label with ``ground`` must be
    readable, so it takes the first place.
    """
    must = ground or sheet.edge_look(edge).hovered
    free = (r for r in rects if _is_free(sheet, r, taken))
    rect = next(free, rects[0] if must else None)
    return LitLabel(edge, text, rect, ground) if rect is not None else None


def _is_free(sheet: Sheet, rect: Rect, taken: list[Rect]) -> bool:
    left, top, right, bottom = rect
    if sheet.states_in(left, top, right, bottom):
        return False
    return not any(labels.meet(rect, other) for other in taken)


def _on_a_way(sheet: Sheet, edge: int, rect: Rect) -> bool:
    """Whether the path so far or the planned route passes through a rectangle."""
    left, top, right, bottom = rect
    for other in sheet.edges_in(left, top, right, bottom).tolist():
        look = sheet.edge_look(other)
        if other == edge or not (look.trail or look.planned or look.running is not None):
            continue
        shape = sheet.geometry.shape(other)
        for at in range(STEPS + 1):
            x, y = shape.at(shape.length * at / STEPS)
            if left <= x <= right and top <= y <= bottom:
                return True
    return False


def _lies_in(rect: Rect, view: Rect) -> bool:
    return rect[0] >= view[0] and rect[1] >= view[1] and rect[2] <= view[2] and rect[3] <= view[3]


def _is_cut(rect: Rect, view: Rect) -> bool:
    """Whether the view shows only a part of a rectangle: half a name cannot be read."""
    return labels.meet(rect, view) and not _lies_in(rect, view)


def _near_sign(sheet: Sheet, edge: int, text: EdgeText, shape: EdgeShape) -> list[Rect]:
    """Places around the sign in the middle of a line; those that cover least come first."""
    unit = sheet.unit
    x, y = shape.at(shape.length / 2)
    w, h = (value / 2 for value in _size(sheet, text))
    apart = 10.0 * unit
    middles = [
        (x, y + h + apart),
        (x, y + h + apart + 5.0 * unit),
        (x, y + h + apart + 11.0 * unit),
        (x, y - h - apart),
        (x + w + apart, y),
        (x - w - apart, y),
        (x, y - h - apart - 11.0 * unit),
        *((x + sx * (w + apart), y + sy * (h + 3.0 * unit)) for sy in (1, -1) for sx in (1, -1)),
    ]
    rects = [(a - w, b - h, a + w, b + h) for a, b in middles]
    others = (sheet.geometry.label(one) for one in sheet.looks.lit_edges[:MOST] if one != edge)
    names = [name for name in others if name]
    covered = sheet.geometry.covered(edge, rects)
    cost = [n + sum(labels.meet(r, m) for m in names) for r, n in zip(rects, covered, strict=True)]
    return [rects[at] for at in sorted(range(len(rects)), key=lambda at: cost[at])]


def _pill(sheet: Sheet, edge: int, shape: EdgeShape, taken: list[Rect], view: Rect) -> LitLabel:
    """The name and duration of the running operation, beside its line."""
    unit = sheet.unit
    name = sheet.picture.operations[edge]
    words = sheet.looks.marks.running_words.removeprefix(name).strip()
    width, half = pill_width(name, words, sheet.ink) * unit, 13.0 * unit
    x, y = shape.at(shape.length / 2)
    gap = 20.0 * unit
    corners = [
        (x + gap, y - 6.0 * unit),
        (x - gap - width, y - 6.0 * unit),
        (x + gap, y + 26.0 * unit),
        (x + gap, y - 36.0 * unit),
        (x - gap - width, y + 26.0 * unit),
    ]
    # Between two neighbouring nodes there is room only above or below the line, or above or below
    # the nodes.
    corners += [(x - width / 2, y + apart * unit) for apart in (-26.0, 26.0, -50.0, 50.0)]
    corners += _beside_boxes(lit_boxes(sheet), (x, y), (width, half), 5.0 * unit)
    rects = [(a, b - half, a + width, b + half) for a, b in corners]
    # The pixel behind the last one of the view is not seen.
    left, top, right, bottom = view
    seen = left, top, right - 1.0 / sheet.zoom, bottom - 1.0 / sheet.zoom
    inside = [r for r in rects if _lies_in(r, seen)] or rects
    # In a far picture it may cover small states, but none that is lit, and not its target.
    goal = int(sheet.picture.target[edge])
    clear = [r for r in inside if not any(labels.meet(r, other) for other in taken)] or inside
    clear = [r for r in clear if goal not in sheet.states_in(*r)] or clear
    rect = next((r for r in clear if _is_free(sheet, r, taken)), clear[0])
    return LitLabel(edge, EdgeText(name), rect, False, words or " ")


def _beside_boxes(
    boxes: list[Rect], near: tuple[float, float], size: tuple[float, float], gap: float
) -> Iterator[tuple[float, float]]:
    """Places around the two boxes that are nearest to a point: the left edge and the middle of the
    height of something with a width and half a height."""
    width, half = size

    def far(box: Rect) -> float:
        return abs(box[0] + box[2] - 2 * near[0]) + abs(box[1] + box[3] - 2 * near[1])

    for left, top, right, bottom in sorted(boxes, key=far)[:2]:
        middle, centre = (top + bottom) / 2, (left + right) / 2
        yield right + gap, middle
        yield left - gap - width, middle
        yield centre - width / 2, top - gap - half
        yield centre - width / 2, bottom + gap + half


NAMES = 100
"""A label looks for a place beside so many other names."""
