"""FoundLayer: the lens signs at the hits of a search, above nodes and labels."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from smsl_studio.picture.levels import COMPACT_SIZE, Level
from smsl_studio.studio.base.canvas.edge_reaches import Numbers
from smsl_studio.studio.base.canvas.lit_labels import lit_boxes
from smsl_studio.studio.base.canvas.lit_layer import LitLayer
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.paint.ink import pen
from smsl_studio.studio.base.theme import Tokens

RADIUS = 7.0
"""Of a lens sign, in mark pixels."""
MANY = 300
"""With more hits than this, boxes have a dot in place of a lens. Dots always have one."""
REACH = 40.0
"""How far from its element a sign can be (mark pixels)."""


class FoundLayer(QGraphicsItem):
    """Paints a lens at each state and operation that a search has found, except the shown hit.

    From the compact level on, operations have one beside their label.
    """

    def __init__(self, under: LitLayer) -> None:
        """``under`` is the layer with the sheet and with the labels of highlighted edges."""
        super().__init__()
        self._under, self._rect = under, QRectF()
        self._kept: tuple[object, object, Numbers, Numbers] = (None, None, _NONE, _NONE)
        self.setZValue(24.0)
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemUsesExtendedStyleOption)
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)

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
        """Paint the signs in the exposed part."""
        sheet = self._under.sheet
        if sheet is None or not sheet.looks.marks.found:
            return
        states, edges = self._numbers(sheet)
        reach = REACH * sheet.unit
        area = option.exposedRect.adjusted(-reach, -reach, reach, reach)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if sheet.level < Level.COMPACT:
            states = _uncovered(sheet, states)
        if sheet.level is Level.DOT or (sheet.level is Level.BOX and len(states) > MANY):
            dots = pen(sheet.ink.tokens.acc, 5.0)
            dots.setCosmetic(True)
            dots.setCapStyle(Qt.PenCapStyle.RoundCap)
            painter.setPen(dots)
            batch.draw_points(painter, sheet.at[states])
            return
        painter.save()
        painter.scale(sheet.unit, sheet.unit)
        places = self._at_states(sheet, states, area)
        if sheet.level >= Level.COMPACT:
            places += self._at_edges(sheet, edges, area)
        for x, y in places:
            paint_lens(painter, QPointF(x, y) / sheet.unit, sheet.ink.tokens)
        painter.restore()

    def _numbers(self, sheet: Sheet) -> tuple[Numbers, Numbers]:
        """The numbers of the states and edges with a sign."""
        marks, picture = sheet.looks.marks, sheet.picture
        found, of, states, edges = self._kept
        if found is not marks.found or of is not picture:
            nodes = (picture.node(one) for one in marks.found if not one.operation)
            states = np.array([at for at in nodes if at >= 0], dtype=np.intp)
            lines = (picture.edge(one) for one in marks.found if one.operation)
            edges = np.array([at for at in lines if at >= 0], dtype=np.intp)
            self._kept = marks.found, picture, states, edges
        if marks.hit is not None:
            states = states[states != picture.node(marks.hit)]
            edges = edges[edges != picture.edge(marks.hit)]
        return states, edges

    @staticmethod
    def _at_states(sheet: Sheet, states: Numbers, area: QRectF) -> list[tuple[float, float]]:
        """The places of the signs at the upper right corners of states, in scene units."""
        seen = set(sheet.states_in(area.left(), area.top(), area.right(), area.bottom()))
        half, unit = sheet.halves(), sheet.unit
        places = []
        for state in states.tolist():
            if state not in seen:
                continue
            look = sheet.node_look(state)
            (x, y), (w, h) = sheet.at[state].tolist(), half[state].tolist()
            if look.lit and sheet.level < Level.COMPACT:
                w = sheet.compact_widths[state] / 2 * unit
                h = COMPACT_SIZE[1] / 2 * unit
            aside = 24.0 if look.finding or look.change else 8.0
            places.append((x + w - min(aside * unit, 2 * w), y - h - 2.0 * unit))
        return places

    def _at_edges(self, sheet: Sheet, edges: Numbers, area: QRectF) -> list[tuple[float, float]]:
        """The places of the signs at the left of labels, or on lines without a label."""
        sides = area.left(), area.top(), area.right(), area.bottom()
        shown, geometry = self._under.shown(), sheet.geometry
        near = np.intersect1d(edges, sheet.edges_in(*sides)).tolist()
        geometry.prepare(near)
        places = []
        for edge in near:
            lit = shown.get(edge)
            label = lit.rect if lit is not None else geometry.label(edge)
            if label is not None:
                places.append((label[0] - 5.0 * sheet.unit, (label[1] + label[3]) / 2))
            else:
                shape = geometry.shape(edge)
                places.append(shape.at(shape.length / 2))
        return places


def _uncovered(sheet: Sheet, states: Numbers) -> Numbers:
    """The states that no highlighted node hides; these nodes are larger than the others."""
    x, y = sheet.at[states].T
    hidden = np.zeros(len(states), dtype=bool)
    for left, top, right, bottom in lit_boxes(sheet):
        hidden |= (left <= x) & (x <= right) & (top <= y) & (y <= bottom)
    return states[~hidden]


_NONE: Numbers = np.zeros(0, dtype=np.intp)


def paint_lens(painter: QPainter, at: QPointF, tokens: Tokens) -> None:
    """Paint the sign of a hit: a lens in a disc, centred on a point (mark pixels)."""
    painter.setPen(pen(tokens.accl, 1.0))
    painter.setBrush(tokens.accs)
    painter.drawEllipse(at, RADIUS, RADIUS)
    painter.setPen(pen(tokens.acc, 1.3))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawEllipse(at + QPointF(-0.8, -0.8), 2.6, 2.6)
    painter.drawLine(at + QPointF(1.2, 1.2), at + QPointF(3.4, 3.4))
