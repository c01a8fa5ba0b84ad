"""Layers: a few items that paint everything that is not a near node.

Far below a readable size edges and nodes are painted in batches from numpy buffers. Near, edges
are painted one by one from their shapes; what is lit lies in a layer of its own above the nodes.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.picture import labels
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.levels import COMPACT_SIZE, FULL_SIZE, Level
from smsl_studio.picture.picture import Ints
from smsl_studio.studio.base.canvas.lit_labels import LitLabel, LitLabels, by_weight, lit_boxes
from smsl_studio.studio.base.canvas.sheet import Numbers, Sheet
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.paint.edge_paint import (
    EdgeShapes,
    LineInk,
    paint_label,
    paint_line,
    paint_pill,
    paint_sign,
)
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN
from smsl_studio.studio.base.paint.node_paint import paint_goal

Bools = NDArray[np.bool_]
MANY_EDGES = 700
"""Beyond so many edges in view they are painted in a batch."""


class Layer(QGraphicsItem):
    """A layer over the whole sheet; subclasses paint the part that is exposed."""

    def __init__(self, z: float) -> None:
        super().__init__()
        self.sheet: Sheet | None = None
        self._rect = QRectF()
        self.setZValue(z)
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemUsesExtendedStyleOption)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)

    def cover(self, rect: QRectF) -> None:
        """Take this rectangle as the layer's extent."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect

    def boundingRect(self) -> QRectF:
        """The whole sheet, in scene units."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the part that is exposed, where there is a sheet with states."""
        if self.sheet is not None and len(self.sheet.picture):
            exposed = option.exposedRect
            self.paint_sheet(painter, self.sheet, exposed)

    def paint_sheet(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint what this layer shows of the exposed part (scene units); subclasses must."""
        raise NotImplementedError


def _edges(rect: QRectF) -> tuple[float, float, float, float]:
    return rect.left(), rect.top(), rect.right(), rect.bottom()


def _cosmetic(pen: QPen) -> QPen:
    pen.setCosmetic(True)
    return pen


class EdgeLayer(Layer):
    """All edges that are not lit, below the nodes."""

    def __init__(self, z: float) -> None:
        super().__init__(z)
        self._drawn = EdgeShapes()
        self.over: LitLayer | None = None
        """What is painted above this layer."""

    def paint_sheet(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint edges one by one where they are near and few, else in one batch."""
        edges = sheet.edges_in(*_edges(exposed))
        if sheet.level >= Level.COMPACT and len(edges) <= MANY_EDGES:
            self._near(painter, sheet, edges.tolist())
        elif len(edges):
            self._far(painter, sheet, edges)

    def _near(self, painter: QPainter, sheet: Sheet, edges: list[int]) -> None:
        geometry, looks, drawn = sheet.geometry, sheet.looks, self._drawn
        rest = [e for e in edges if not looks.is_lit(e)]
        ink = LineInk(sheet.ink, sheet.unit, sheet.compact)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for edge in rest:
            look, shape = looks.edge(edge), geometry.shape(edge)
            paint_line(painter, shape, look, ink, drawn)
        if looks.marks.dimmed:
            return
        unit = sheet.unit
        painter.save()
        painter.scale(unit, unit)
        for edge, rect in self.names(sheet, rest).items():
            centre = QPointF((rect[0] + rect[2]) / 2 / unit, (rect[1] + rect[3]) / 2 / unit)
            paint_label(painter, sheet.text(edge), centre, looks.edge(edge), sheet.ink)
        painter.restore()

    def names(self, sheet: Sheet, edges: Iterable[int]) -> dict[int, Rect]:
        """Where the names of these edges stand; one that the label of a change covers hides."""
        found = {edge: rect for edge in edges if (rect := sheet.geometry.label(edge)) is not None}
        if self.over is None or not sheet.looks.marks.changes:
            return found
        lit = self.over.shown().values()
        over = [one.rect for one in lit if sheet.edge_look(one.edge).change]
        return {e: r for e, r in found.items() if not any(labels.meet(r, one) for one in over)}

    def _far(self, painter: QPainter, sheet: Sheet, edges: Numbers) -> None:
        """Straight lines; opposite edges lie on each other, heads are two strokes."""
        tokens = sheet.ink.tokens
        source, target = sheet.picture.source[edges], sheet.picture.target[edges]
        keep = (target >= 0) & (source != target)
        source, target = source[keep], target[keep]
        colour = tokens.dim if sheet.looks.marks.dimmed else tokens.edge
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, len(source) < 3000)
        painter.setPen(_cosmetic(QPen(colour, 1.0)))
        a, b = sheet.at[source], sheet.at[target]
        if sheet.level is Level.DOT:
            once = source < target
            # An edge whose opposite is missing is drawn in either direction.
            once |= ~_has_opposite(source, target, len(sheet.picture))
            batch.draw_lines(painter, np.hstack([a[once], b[once]]))
            return
        step = b - a
        length = np.maximum(np.hypot(step[:, 0], step[:, 1]), 1e-6)[:, None]
        along = step / length
        across = np.column_stack([-along[:, 1], along[:, 0]])
        shift = across * 2.5 * sheet.unit
        half = sheet.halves()[target] if len(target) else step
        # Where the line meets the target's box.
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


def _has_opposite(source: Ints, target: Ints, count: int) -> Bools:
    forward = source.astype(np.int64) * count + target
    back = target.astype(np.int64) * count + source
    found: Bools = np.isin(back, forward)
    return found


class FarNodeLayer(Layer):
    """Nodes that are dots, boxes, or too many to be items."""

    def __init__(self, z: float) -> None:
        super().__init__(z)
        self.near: frozenset[int] = frozenset()
        """States that are shown by an item of their own."""

    def paint_sheet(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint dots or boxes for the states that have no node item."""
        states = sheet.states_in(*_edges(exposed))
        if sheet.level is Level.FULL or (sheet.level is Level.COMPACT and self.near >= set(states)):
            return
        tokens = sheet.ink.tokens
        rows = np.array([s for s in states if s not in self.near], dtype=np.int64)
        if not len(rows):
            return
        if sheet.level is Level.DOT:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, len(rows) < 1500)
            size = min(6.0, max(1.6, sheet.spacing.pitch * sheet.zoom * 0.42))
            dots = QPen(tokens.slate, size)
            dots.setCapStyle(
                Qt.PenCapStyle.RoundCap if len(rows) < 1500 else Qt.PenCapStyle.SquareCap
            )
            painter.setPen(_cosmetic(dots))
            batch.draw_points(painter, sheet.at[rows])
            return
        half = sheet.halves()[rows]
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, len(rows) < 1500)
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


class LitLayer(Layer):
    """Edges that are selected, hovered, on a route or have a finding: above the nodes."""

    def __init__(self, z: float) -> None:
        super().__init__(z)
        self.labels = LitLabels()
        self.view: Rect = (0.0, 0.0, 0.0, 0.0)
        """What of the scene is in view."""

    def shown(self) -> dict[int, LitLabel]:
        """The labels by edge, as they are painted now."""
        if self.sheet is None or not len(self.sheet.picture):
            return {}
        return {label.edge: label for label in self.labels.of(self.sheet, self.view)}

    def paint_sheet(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the lit edges and then their labels, the most important one last."""
        geometry, looks, unit = sheet.geometry, sheet.looks, sheet.unit
        order = by_weight(sheet)
        ink = LineInk(sheet.ink, unit, sheet.compact)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.save()
        self._spare_names(painter, sheet, exposed)
        for edge in order:
            shape = geometry.shape(edge)
            paint_line(painter, shape, looks.edge(edge), ink)
        painter.restore()
        painter.save()
        painter.scale(unit, unit)
        for edge in order:
            look, shape = looks.edge(edge), geometry.shape(edge)
            if look.pruned or look.held_back or look.risky:
                x, y = shape.at(shape.length / 2)
                paint_sign(painter, x / unit, y / unit, look, sheet.ink)
        for label in self.labels.of(sheet, self.view):
            left, top, right, bottom = (value / unit for value in label.rect)
            middle = QPointF((left + right) / 2, (top + bottom) / 2)
            if label.pill:
                at = QPointF(left, middle.y())
                paint_pill(painter, label.text.text, label.pill.strip(), at, sheet.ink)
            else:
                look = looks.edge(label.edge)
                paint_label(painter, label.text, middle, look, sheet.ink, label.ground)
        half = (COMPACT_SIZE if sheet.compact else FULL_SIZE)[1] / 2
        for goal in looks.marks.goals & sheet.picture.index.keys():
            x, y = sheet.at[sheet.picture.index[goal]] / unit
            paint_goal(painter, float(x), float(y) + half, sheet.ink)
        painter.restore()
        painter.setPen(NO_PEN)
        painter.setBrush(NO_BRUSH)

    @staticmethod
    def _spare_names(painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """In a far picture lines end at dots; they must not cross the names of lit nodes."""
        boxes = lit_boxes(sheet)
        if boxes:
            outside, inside = QPainterPath(), QPainterPath()
            outside.addRect(exposed)
            inside.setFillRule(Qt.FillRule.WindingFill)
            for left, top, right, bottom in boxes:
                inside.addRect(left, top, right - left, bottom - top)
            painter.setClipPath(outside.subtracted(inside), Qt.ClipOperation.IntersectClip)
