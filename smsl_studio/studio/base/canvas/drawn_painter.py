"""DrawnPainter: paints notes and groups into the background of a canvas."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter

from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.canvas.found_layer import paint_lens
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.drawn_paint import (
    NoteLook,
    paint_group,
    paint_note,
    paint_title,
)
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN

MARGIN = 9.0
"""How far the line around a chosen note or group, or its lens, reaches beyond it (pixels)."""
PALE = 0.62
"""The opacity of notes and groups where everything without a mark is pale."""


class DrawnPainter:
    """Paints the groups of a sheet below its edges, and their titles and its notes above them."""

    def __init__(self) -> None:
        self.chosen: DrawnKey | None = None
        """The note or group that is selected."""
        self.found: frozenset[DrawnKey] = frozenset()
        """Those that a search has found."""

    def paint_groups(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the exposed groups."""
        with self._scaled(painter, sheet):
            for number, rect in self._frames(sheet, sheet.drawn.group_rects, exposed):
                paint_group(painter, rect, sheet.drawn.bar, self._is_lit(sheet, number), sheet.ink)
                key = DrawnKey("group", sheet.drawn.parts.group_keys[number])
                self._paint_lens(painter, key, rect.topLeft(), sheet, sheet.unit)

    def paint_titles(self, painter: QPainter, sheet: Sheet, exposed: QRectF) -> None:
        """Paint the titles of the exposed groups, on a ground that covers lines."""
        drawn = sheet.drawn
        if not drawn.bar:
            return
        with self._scaled(painter, sheet):
            for number, rect in self._frames(sheet, drawn.title_rects, exposed):
                title, lit = drawn.parts.groups[number].title, self._is_lit(sheet, number)
                paint_title(painter, rect, title, drawn.bar, lit, sheet.ink)

    def _frames(self, sheet: Sheet, rects: Floats, exposed: QRectF) -> list[tuple[int, QRectF]]:
        """The numbers of the exposed groups, each with its one of these rectangles (mark
        pixels)."""
        found = []
        for number in _exposed(rects, exposed, MARGIN / sheet.zoom):
            left, top, right, bottom = (rects[number] / sheet.unit).tolist()
            found.append((number, QRectF(left, top, right - left, bottom - top)))
        return found

    def _is_lit(self, sheet: Sheet, number: int) -> bool:
        """Whether a group is selected, or would get a state that is being dragged."""
        drawn = sheet.drawn
        chosen = DrawnKey("group", drawn.parts.group_keys[number]) == self.chosen
        return chosen or number in drawn.gains

    @contextmanager
    def _scaled(self, painter: QPainter, sheet: Sheet) -> Iterator[None]:
        """Paint in mark pixels, pale during a run."""
        painter.save()
        painter.scale(sheet.unit, sheet.unit)
        painter.setOpacity(PALE if sheet.looks.marks.dimmed else 1.0)
        yield
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
            key = DrawnKey("note", parts.note_keys[number])
            rect = QRectF(left, top, right - left, bottom - top)
            look = NoteLook(sheet.zoom, key == self.chosen, end)
            paint_note(painter, rect, parts.notes[number], look, sheet.ink)
            self._paint_lens(painter, key, rect.topLeft(), sheet, 1.0)
        painter.restore()
        painter.setPen(NO_PEN)
        painter.setBrush(NO_BRUSH)

    def _paint_lens(
        self, painter: QPainter, key: DrawnKey, at: QPointF, sheet: Sheet, unit: float
    ) -> None:
        """Paint the lens of a hit at a corner, if it is one and not the one that is shown."""
        if key in self.found and key != self.chosen:
            painter.save()
            painter.translate(at)
            painter.scale(1.0 / (sheet.zoom * unit), 1.0 / (sheet.zoom * unit))
            paint_lens(painter, QPointF(0.0, 0.0), sheet.ink.tokens)
            painter.restore()


def _exposed(rects: Floats, exposed: QRectF, pad: float) -> list[int]:
    """The numbers of the rectangles that touch a part of the scene."""
    low = (exposed.left() - pad, exposed.top() - pad)
    high = (exposed.right() + pad, exposed.bottom() + pad)
    found: list[int] = np.nonzero(((rects[:, 2:] >= low) & (rects[:, :2] <= high)).all(axis=1))[
        0
    ].tolist()
    return found
