"""The place of a message over the canvas: beside everything that somebody works on."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QFrame, QWidget

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.overlays.card import Card
from smsl_studio.studio.features.draw.canvas.card_places import (
    free_of_all,
    is_clear,
    selected_places,
)

GAP = 6
"""A message keeps so far off what it must not cover (pixels)."""
NEAR_POINTER = 40
"""A message keeps so far off the pointer, which is about to click there (pixels)."""


class MessageSeat:
    """Finds places for the messages over ``body``, which holds the canvas."""

    def __init__(self, canvas: Canvas, body: QWidget) -> None:
        self._canvas, self._body = canvas, body

    def __call__(self, wanted: QRect, now: QRect) -> QPoint | None:
        """The place for a message: that where it is ``now``, else the one nearest to ``wanted``,
        where it covers nothing. None if there is none. Both are in pixels of the body.
        """
        canvas = self._canvas
        if not canvas.isVisible() or canvas.sheet is None:
            return wanted.topLeft()
        corner = canvas.mapTo(self._body, QPoint())
        spared = self._spared()
        for place in (now, wanted):
            here = place.translated(-corner)
            if not place.isEmpty() and canvas.rect().contains(here) and self._is_free(here, spared):
                return place.topLeft()
        gap = QPoint(GAP, GAP)
        size = wanted.size() + QSize(2 * GAP, 2 * GAP)
        found = free_of_all(canvas, size, wanted.topLeft() - corner - gap, spared)
        return found + gap + corner if found is not None else None

    def _is_free(self, area: QRect, spared: list[QRect]) -> bool:
        canvas, area = self._canvas, area.adjusted(-GAP, -GAP, GAP, GAP)
        if canvas.overlays.floats_in(area) or any(area.intersects(one) for one in spared):
            return False
        return is_clear(canvas, area)

    def _spared(self) -> list[QRect]:
        """The areas that a message should not cover.

        They are the selected element, open fields and cards, a drawer over the canvas, and the
        pointer.
        """
        canvas = self._canvas
        cards = [c.geometry() for c in canvas.findChildren(Card) if c.isVisible()]
        at = canvas.mapFromGlobal(QCursor.pos())
        pointer = QRect(at, at).adjusted(-NEAR_POINTER, -NEAR_POINTER, NEAR_POINTER, NEAR_POINTER)
        return [*selected_places(canvas), *cards, *self._drawers(), pointer]

    def _drawers(self) -> list[QRect]:
        """The areas of the panels that lie over the canvas now, in pixels of the canvas."""
        window, direct = self._canvas.window(), Qt.FindChildOption.FindDirectChildrenOnly
        found = [one for one in window.findChildren(QFrame, options=direct) if one.isVisible()]
        floats = [one for one in found if one.property("role") == "float"]
        return [QRect(self._canvas.mapFrom(window, one.pos()), one.size()) for one in floats]
