"""DrawnPainter: paints notes and groups into the background of a canvas."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.drawn_paint import NoteLook, paint_group, paint_note
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN

MARGIN = 4.0
"""How far the line around a chosen note or group reaches beyond it (pixels)."""
PALE = 0.62
"""The opacity of notes and groups where everything without a mark is pale."""


class DrawnPainter:
    """Paints the groups of a sheet below its edges, and its notes above them."""

    def __init__(self) -> None:
        self.chosen: DrawnKey | None = None
        """The note or group that is selected."""

    def paint_groups(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the exposed groups."""
        drawn = sheet.drawn
        if not drawn or not drawn.parts.groups:
            return
        rects, unit, parts = drawn.group_rects, sheet.unit, drawn.parts
        painter.save()
        painter.scale(unit, unit)
        painter.setOpacity(PALE if sheet.looks.marks.dimmed else 1.0)
        for number in _exposed(rects, exposed, MARGIN / sheet.zoom):
            left, top, right, bottom = (rects[number] / unit).tolist()
            chosen = self.chosen == DrawnKey("group", parts.group_keys[number])
            rect = QRectF(left, top, right - left, bottom - top)
            paint_group(painter, rect, parts.groups[number].title, drawn.bar, chosen, sheet.ink)
        painter.restore()

    def paint_notes(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the exposed notes, and the lines to the states that they hang on."""
        drawn = sheet.drawn
        if not drawn or not drawn.parts.notes:
            return
        rects, parts = drawn.note_rects, drawn.parts
        reach, hung = rects.copy(), parts.states >= 0
        if hung.any():
            ends = sheet.at[parts.states[hung]]
            reach[hung, :2] = np.minimum(reach[hung, :2], ends)
            reach[hung, 2:] = np.maximum(reach[hung, 2:], ends)
        painter.save()
        painter.setOpacity(PALE if sheet.looks.marks.dimmed else 1.0)
        for number in _exposed(reach, exposed, MARGIN / sheet.zoom):
            left, top, right, bottom = rects[number].tolist()
            state = int(parts.states[number])
            end = tuple(sheet.at[state].tolist()) if state >= 0 else None
            chosen = self.chosen == DrawnKey("note", parts.note_keys[number])
            rect = QRectF(left, top, right - left, bottom - top)
            look = NoteLook(sheet.zoom, chosen, end)
            paint_note(painter, rect, parts.notes[number], look, sheet.ink)
        painter.restore()
        painter.setPen(NO_PEN)
        painter.setBrush(NO_BRUSH)


def _exposed(rects: Floats, exposed: QRectF, pad: float) -> list[int]:
    """The numbers of the rectangles that touch a part of the scene."""
    low = (exposed.left() - pad, exposed.top() - pad)
    high = (exposed.right() + pad, exposed.bottom() + pad)
    found: list[int] = np.nonzero(((rects[:, 2:] >= low) & (rects[:, :2] <= high)).all(axis=1))[
        0
    ].tolist()
    return found
