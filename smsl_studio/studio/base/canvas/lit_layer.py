"""LitLayer: the layer above the nodes that paints highlighted edges and their labels."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from smsl_studio.picture.labels import Rect
from smsl_studio.picture.levels import COMPACT_SIZE, FULL_SIZE, Level
from smsl_studio.studio.base.canvas.bundle_layer import (
    chosen_bundles,
    paint_bundles,
    paint_counts,
)
from smsl_studio.studio.base.canvas.hidden_marks import NameMarks
from smsl_studio.studio.base.canvas.lane_hover import LaneHover
from smsl_studio.studio.base.canvas.lit_labels import LitLabel, LitLabels, by_weight, lit_boxes
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.edge_paint import (
    LineInk,
    paint_label,
    paint_line,
    paint_pill,
    paint_sign,
)
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN
from smsl_studio.studio.base.paint.node_paint import paint_goal


class LitLayer(QGraphicsItem):
    """Paints edges that are selected, hovered, on a route or with a finding, above the nodes."""

    def __init__(self, z: float) -> None:
        super().__init__()
        self.sheet: Sheet | None = None
        self._rect = QRectF()
        self.setZValue(z)
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemUsesExtendedStyleOption)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        self.labels = LitLabels()
        self._marks = NameMarks()
        self.lane = LaneHover()
        self.view: Rect = (0.0, 0.0, 0.0, 0.0)
        """The visible part of the scene: left, top, right, bottom (scene units)."""

    def cover(self, rect: QRectF) -> None:
        """Set the part of the scene that this layer covers."""
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect

    def boundingRect(self) -> QRectF:
        """The part of the scene that ``cover`` has set."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the exposed part, if the sheet has states."""
        if self.sheet is not None and len(self.sheet.picture):
            exposed = option.exposedRect
            self._paint_sheet(painter, self.sheet, exposed)

    def shown(self) -> dict[int, LitLabel]:
        """The labels that are painted now, by the number of their edge."""
        if self.sheet is None or not len(self.sheet.picture):
            return {}
        return {label.edge: label for label in self.labels.of(self.sheet, self.view)}

    def _paint_sheet(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the highlighted edges, then their labels; the most important one is last."""
        geometry, looks, unit = sheet.geometry, sheet.looks, sheet.unit
        order = by_weight(sheet)
        ink = LineInk(sheet.ink, unit, sheet.compact)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.save()
        self._spare_names(painter, sheet, exposed)
        for edge in order:
            shape = geometry.shape(edge)
            paint_line(painter, shape, looks.edge(edge), ink)
        chosen = chosen_bundles(sheet) if sheet.level >= Level.COMPACT else []
        paint_bundles(painter, sheet, chosen, chosen=True)
        if sheet.level >= Level.COMPACT:
            self.lane.paint(painter, sheet)
        painter.restore()
        painter.save()
        painter.scale(unit, unit)
        # A way along the lane lies on its chip.
        lane = sheet.picture.bundles.lane
        over = looks.own_lines or looks.hovered_state >= 0
        crossed = [lane] if lane >= 0 and lane not in chosen and over else []
        paint_counts(painter, sheet, crossed if sheet.level >= Level.COMPACT else [])
        paint_counts(painter, sheet, chosen, chosen=True)
        for edge in order:
            look, shape = looks.edge(edge), geometry.shape(edge)
            if look.pruned or look.held_back or look.risky:
                x, y = shape.at(shape.length / 2)
                paint_sign(painter, x / unit, y / unit, look, sheet.ink)
        shown = self.labels.of(sheet, self.view)
        if sheet.level >= Level.COMPACT and not looks.marks.dimmed:
            # A line that is lit would strike through the mark on it.
            self._marks.paint_hidden(painter, sheet, order)
        self._marks.paint(painter, sheet, {one.edge: one.rect for one in shown})
        for label in shown:
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
        """Keep lines off the names of highlighted nodes.

        In a far picture lines end at dots, but these nodes are larger.
        """
        boxes = lit_boxes(sheet)
        if boxes:
            outside, inside = QPainterPath(), QPainterPath()
            outside.addRect(exposed)
            inside.setFillRule(Qt.FillRule.WindingFill)
            for left, top, right, bottom in boxes:
                inside.addRect(left, top, right - left, bottom - top)
            painter.setClipPath(outside.subtracted(inside), Qt.ClipOperation.IntersectClip)
