"""The background of a canvas: edges without a highlight, and nodes that have no item.

Qt keeps the painted background until a part of it is invalidated. At a small zoom edges and nodes
are painted in batches from numpy buffers. At a readable zoom edges are painted one by one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from smsl_studio.legible import plain_text
from smsl_studio.picture import labels
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.levels import Level
from smsl_studio.picture.shape import Floats, Point
from smsl_studio.studio.base.canvas.bundle_layer import (
    bundles_among,
    lines_alone,
    paint_bundles,
    paint_counts,
    paint_stubs,
)
from smsl_studio.studio.base.canvas.edge_reaches import Numbers
from smsl_studio.studio.base.canvas.hidden_marks import NameMarks
from smsl_studio.studio.base.canvas.lit_layer import LitLayer
from smsl_studio.studio.base.canvas.sheet import MANY_EDGES, Sheet
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.paint.edge_paint import (
    LineInk,
    paint_label,
    paint_plain,
    polyline,
)

SMOOTH_EDGES, SMOOTH_NODES = 3000, 1500
"""From this number in view on, edges (nodes) are painted without antialiasing."""


def _sides(rect: QRectF) -> Rect:
    return rect.left(), rect.top(), rect.right(), rect.bottom()


def _cosmetic(pen: QPen) -> QPen:
    pen.setCosmetic(True)
    return pen


class EdgePainter:
    """Paints all edges without a highlight, below the nodes.

    The number of edges in view decides how: one by one or in a batch, with or without antialiasing.
    """

    def __init__(self, over: LitLayer) -> None:
        """``over`` is the layer above, whose labels can hide names of this layer."""
        self._marks, self._over = NameMarks(), over
        self._near = self._smooth = True

    def look_at(self, sheet: Sheet, view: Rect) -> bool:
        """Take the visible part of the scene.

        Returns whether edges must now be painted differently.
        """
        before, seen = (self._near, self._smooth), sheet.edges_in(*view)
        self._near = sheet.level >= Level.COMPACT and len(seen) <= MANY_EDGES
        source, target = sheet.picture.source[seen], sheet.picture.target[seen]
        self._smooth = int(((target >= 0) & (source != target)).sum()) < SMOOTH_EDGES
        return before != (self._near, self._smooth)

    def paint(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the exposed edges: one by one if near and few, else in one batch."""
        edges = sheet.edges_in(*_sides(exposed))
        if self._near:
            self._paint_near(painter, sheet, edges.tolist(), exposed)
        elif len(edges):
            self._paint_far(painter, sheet, edges)

    def _paint_near(
        self, painter: QPainter, sheet: Sheet, edges: list[int], exposed: QRectF
    ) -> None:
        geometry, looks = sheet.geometry, sheet.looks
        geometry.prepare(edges)
        rest = [e for e in lines_alone(sheet, edges) if not looks.is_lit(e)]
        ink = LineInk(sheet.ink, sheet.unit, sheet.compact)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        quiet = [e for e in rest if e in looks.quiet] if looks.quiet else []
        for some, look in ((quiet, looks.dim), (_without(rest, quiet), looks.plain)):
            if some or look is looks.plain:
                paint_plain(painter, [geometry.shape(e) for e in some], look, ink)
        paint_bundles(painter, sheet, bundles_among(sheet, edges))
        room = 12.0 * sheet.unit
        paint_stubs(painter, sheet, _sides(exposed.adjusted(-room, -room, room, room)))

    def paint_names(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the names of the exposed edges, if these are painted one by one."""
        looks, unit = sheet.looks, sheet.unit
        if not self._near or looks.marks.dimmed:
            return
        edges = sheet.edges_in(*_sides(exposed)).tolist()
        rest = [edge for edge in lines_alone(sheet, edges) if not looks.is_lit(edge)]
        painter.save()
        painter.scale(unit, unit)
        names = self.names(sheet, rest)
        # Without room, a mark lies below the names.
        self._marks.paint_hidden(painter, sheet, edges)
        self._marks.paint(painter, sheet, names)
        for edge, rect in names.items():
            centre = QPointF((rect[0] + rect[2]) / 2 / unit, (rect[1] + rect[3]) / 2 / unit)
            paint_label(painter, sheet.text(edge), centre, looks.edge(edge), sheet.ink)
        paint_counts(painter, sheet, bundles_among(sheet, edges))
        painter.restore()

    def names(self, sheet: Sheet, edges: Iterable[int]) -> dict[int, Rect]:
        """The rectangles of these edges' names. A name below the label of a change is left out."""
        label = sheet.geometry.label
        found = {edge: rect for edge in edges if (rect := label(edge)) is not None}
        if not sheet.looks.marks.changes:
            return found
        lit = self._over.shown().values()
        over = [one.rect for one in lit if sheet.edge_look(one.edge).change]
        return {e: r for e, r in found.items() if not any(labels.meet(r, one) for one in over)}

    def _paint_far(self, painter: QPainter, sheet: Sheet, edges: Numbers) -> None:
        """Paint straight lines with heads of two strokes.

        Opposite edges share one line at the level of dots.
        """
        tokens = sheet.ink.tokens
        back = sheet.picture.bundles.back
        edges = edges[~np.isin(edges, back)] if back else edges
        self._paint_lane(painter, sheet)
        source, target = sheet.picture.source[edges], sheet.picture.target[edges]
        bends = {e: layout.bends for e, layout in sheet.lines.items() if layout.bends}
        keep = (target >= 0) & (source != target)
        if bends:
            keep |= (target >= 0) & np.isin(edges, list(bends))
        source, target = source[keep], target[keep]
        colour = tokens.dim if sheet.looks.marks.dimmed else tokens.edge
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._smooth)
        painter.setPen(_cosmetic(QPen(colour, 1.0)))
        a, b = sheet.at[source], sheet.at[target]
        if bends:
            # The last piece of a bent line is drawn as the other lines are.
            batch.draw_lines(painter, _first_pieces(edges[keep], a, bends))
        if sheet.level is Level.DOT:
            once = sheet.picture.drawn_once[edges][keep] | bool(bends)
            batch.draw_lines(painter, np.hstack([a[once], b[once]]))
            return
        step = b - a
        length = np.maximum(np.hypot(step[:, 0], step[:, 1]), 1e-6)[:, None]
        along = step / length
        across = np.column_stack([-along[:, 1], along[:, 0]])
        shift = across * 2.5 * sheet.unit
        half = sheet.halves()[target] if len(target) else step
        # The distance from the target's centre to its border along the line.
        reach = np.minimum(
            half[:, 0] / np.maximum(np.abs(along[:, 0]), 1e-6),
            half[:, 1] / np.maximum(np.abs(along[:, 1]), 1e-6),
        )[:, None]
        tip = b - along * (reach + sheet.unit) + shift
        size = 4.0 * sheet.unit
        batch.draw_lines(
            painter,
            np.vstack(
                [
                    np.hstack([a + shift, tip]),
                    np.hstack([tip, tip - along * size + across * size * 0.5]),
                    np.hstack([tip, tip - along * size - across * size * 0.5]),
                ]
            ),
        )

    @staticmethod
    def _paint_lane(painter: QPainter, sheet: Sheet) -> None:
        """Paint the lane back to the start, without a head."""
        lane = sheet.picture.bundles.lane
        if lane >= 0:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(_cosmetic(QPen(sheet.ink.tokens.edge, 2.0)))
            painter.drawPolyline(polyline(sheet.geometry.shape(lane).points))


def _without(edges: list[int], others: list[int]) -> list[int]:
    """These edges without the others."""
    left_out = set(others)
    return [edge for edge in edges if edge not in left_out] if others else edges


def _first_pieces(edges: Numbers, starts: Floats, bends: Mapping[int, Sequence[Point]]) -> Floats:
    """The pieces of bent lines up to their last bends, (n, 4); ``starts`` moves to these bends."""
    pieces: list[tuple[float, ...]] = []
    for row in np.nonzero(np.isin(edges, list(bends)))[0].tolist():
        corners = [tuple(starts[row].tolist()), *bends[int(edges[row])]]
        pieces += [(*a, *b) for a, b in pairwise(corners)]
        starts[row] = corners[-1]
    return np.array(pieces).reshape(-1, 4)


class FarNodePainter:
    """Paints nodes that have no item: dots, boxes, or too many compact nodes."""

    def __init__(self) -> None:
        self.near: frozenset[int] = frozenset()
        """States that have a node item, if not all states in view have one."""
        self._whole, self._smooth = True, True

    def look_at(self, sheet: Sheet, view: Rect, near: frozenset[int], whole: bool) -> bool:
        """Take the visible part of the scene; returns whether all nodes must be painted anew.

        ``whole`` says that every state in view has an item. Otherwise those in ``near`` have one.
        """
        before = self._whole, self._smooth
        seen = 0 if whole else sum(1 for state in sheet.states_in(*view) if state not in near)
        self.near, self._whole, self._smooth = near, whole, seen < SMOOTH_NODES
        return before != (self._whole, self._smooth)

    def paint(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint dots or boxes for the exposed states that have no node item."""
        if self._whole:
            return
        states = sheet.states_in(*_sides(exposed))
        tokens = sheet.ink.tokens
        rows = np.array([s for s in states if s not in self.near], dtype=np.int64)
        if not len(rows):
            return
        if sheet.level is Level.DOT:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._smooth)
            size = min(6.0, max(1.6, sheet.spacing.pitch * sheet.zoom * 0.42))
            dots = QPen(tokens.slate, size)
            dots.setCapStyle(Qt.PenCapStyle.RoundCap if self._smooth else Qt.PenCapStyle.SquareCap)
            painter.setPen(_cosmetic(dots))
            batch.draw_points(painter, sheet.at[rows])
            return
        half = sheet.halves()[rows]
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._smooth)
        painter.setPen(_cosmetic(QPen(tokens.nl, 1.2)))
        painter.setBrush(tokens.surf)
        batch.draw_rects(painter, np.hstack([sheet.at[rows] - half, half * 2]))
        if sheet.level is Level.COMPACT:
            self._texts(painter, sheet, rows.tolist())

    def _texts(self, painter: QPainter, sheet: Sheet, rows: list[int]) -> None:
        unit, type_ = sheet.unit, sheet.ink.short
        painter.save()
        painter.scale(unit, unit)
        painter.setFont(type_.font)
        painter.setPen(sheet.ink.tokens.tx)
        for row in rows:
            text = type_.elided(sheet.picture.face(row).short, float(sheet.compact_widths[row]) - 8)
            x, y = sheet.at[row] / unit
            painter.drawText(QPointF(x - type_.width(text) / 2, y + type_.rise), plain_text(text))
        painter.restore()
