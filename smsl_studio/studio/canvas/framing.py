"""Framing: what of a sheet is to be seen when everything is to be seen, and at which zoom."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF

from smsl_studio.studio.canvas.camera import fit_zoom
from smsl_studio.studio.canvas.geometry import SMALL
from smsl_studio.studio.canvas.sheet import Sheet

FULL_MARGIN = (28.0, 20.0)
COMPACT_MARGIN = (56.0, 64.0)
"""Pixels left free in all, across and down; compact nodes need more for dot, labels and goal."""


def frame_of(sheet: Sheet, room: tuple[float, float]) -> tuple[QPointF, float]:
    """The middle and the zoom at which a sheet fits a room of so many pixels, 100 % at most."""
    low, high = sheet.at.min(axis=0), sheet.at.max(axis=0)
    centres = QRectF(QPointF(*low), QPointF(*high))
    if sheet.roomy and len(sheet.picture) <= SMALL:
        whole = _full_bounds(sheet)
        zoom = fit_zoom(whole, FULL_MARGIN, room)
        if zoom >= 0.70:
            return whole.center(), zoom
    widest = float(sheet.compact_widths.max())
    marks = widest + COMPACT_MARGIN[0], COMPACT_MARGIN[1]
    return centres.center(), fit_zoom(centres, marks, room)


def _full_bounds(sheet: Sheet) -> QRectF:
    """All that full nodes, their lines and labels cover."""
    zoom = sheet.zoom
    sheet.set_zoom(1.0)
    geometry, half = sheet.geometry, sheet.halves()
    low, high = (sheet.at - half).min(axis=0), (sheet.at + half).max(axis=0)
    whole = QRectF(QPointF(*low), QPointF(*high)).adjusted(-4, -4, 4, 4)
    initial = sheet.picture.index.get(sheet.picture.branch.initial, -1)
    if initial >= 0:
        x, y = sheet.at[initial] - half[initial]
        whole = whole.united(QRectF(x - 28.0, y, 28.0, 10.0))
    for edge in range(len(sheet.picture.operations)):
        for rect in (geometry.shape(edge).bounds, geometry.label(edge)):
            if rect is not None:
                left, top, right, bottom = rect
                whole = whole.united(QRectF(left, top, right - left, bottom - top))
    sheet.set_zoom(zoom)
    return whole
