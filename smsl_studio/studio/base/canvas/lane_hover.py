"""The way of the state under the pointer back to the start, by the lane of a collapsed drawing."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.picture.start_lane import LaneNodes, StartLane
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.edge_paint import HEAD, paint_head, polyline
from smsl_studio.studio.base.paint.ink import NO_BRUSH, pen

WIDTH = 2.0


class LaneHover:
    """Knows the way of one state, as long as the drawing stays as it is."""

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._way: EdgeShape | None = None

    def way(self, sheet: Sheet) -> EdgeShape | None:
        """The way of the hovered state; None if no operation leads from it by the lane."""
        state, picture = sheet.looks.hovered_state, sheet.picture
        if state < 0 or picture.bundles.lane < 0 or state not in picture.stubs:
            return None
        key = (sheet.geometry, sheet.version, picture, state)
        if key != self._key:
            self._key, self._way = key, _way_of(sheet, state)
        return self._way

    def rect(self, sheet: Sheet) -> QRectF:
        """The part of the scene that the way covers; empty without one."""
        way = self.way(sheet)
        if way is None:
            return QRectF()
        left, top, right, bottom = way.bounds
        pad = HEAD * sheet.unit
        return QRectF(left, top, right - left, bottom - top).adjusted(-pad, -pad, pad, pad)

    def paint(self, painter: QPainter, sheet: Sheet) -> None:
        """Paint the way (scene units)."""
        way = self.way(sheet)
        if way is not None:
            unit, colour = sheet.unit, sheet.ink.tokens.slate
            painter.setBrush(NO_BRUSH)
            painter.setPen(pen(colour, WIDTH * unit))
            painter.drawPolyline(polyline(way.cut(0.0, way.length - (HEAD - 2.0) * unit)))
            paint_head(painter, way, colour, HEAD * unit)


def _way_of(sheet: Sheet, state: int) -> EdgeShape | None:
    """The way of a state; it lies on the lane as that is drawn now."""
    geometry, bundles = sheet.geometry, sheet.picture.bundles
    nodes = LaneNodes(geometry.boxes, geometry.box, Obstacles(geometry.boxes), geometry.style.unit)
    start = int(sheet.picture.target[bundles.lane])
    others = (
        geometry.shape(edge).bounds
        for edge in range(len(sheet.picture.operations))
        if edge not in bundles.hidden and edge not in bundles.back
        and sheet.picture.source[edge] != sheet.picture.target[edge]
    )  # fmt: skip
    lane = StartLane(nodes, start)
    return lane.way(state) if lane.settle(others) else None
