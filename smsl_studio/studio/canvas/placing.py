"""Placing: where new states and floating fields stand, clear of what is there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QPointF, QRect
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.canvas.gestures import GRID
from smsl_studio.studio.canvas.overlays.connect_card import ConnectCard

if TYPE_CHECKING:
    from smsl_studio.studio.canvas.canvas import Canvas

Position = tuple[float, float]


def clear_place(canvas: Canvas, card: ConnectCard, at: QPoint) -> QPoint:
    """A place around a point of the view where a card covers no state."""
    sheet = canvas.sheet
    w, h, off = card.width(), card.height(), 16
    # A new state is shown where it will stand; the card stands beside it.
    aside = 16 if card.target.isHidden() else int(54 * max(canvas.zoom, 0.5)) + 14
    inside = canvas.rect().adjusted(6, 6, -6, -6)
    places = [
        QPoint(at.x() + aside, at.y() - 20),
        QPoint(at.x() - aside - w, at.y() - 20),
        QPoint(at.x() + aside, at.y() - h // 2),
        QPoint(at.x() - aside - w, at.y() - h // 2),
        QPoint(at.x() - w // 2, at.y() + 40),
        QPoint(at.x() - w // 2, at.y() - 40 - h),
        QPoint(at.x() + off, at.y() - off - h),
        QPoint(at.x() - off - w, at.y() - off - h),
    ]
    places += [QPoint(p.x(), inside.bottom() - h) for p in places[:4]]
    for place in places:
        if sheet is None or not inside.contains(QRect(place, card.size())):
            continue
        a, b = canvas.mapToScene(place), canvas.mapToScene(place + QPoint(w, h))
        if not sheet.states_in(a.x(), a.y(), b.x(), b.y()):
            return place
    return places[0]


def place_near(widget: QWidget, area: QWidget, at: QPoint) -> None:
    """Put a widget at a point of an area, wholly inside it."""
    widget.adjustSize()
    x = min(max(at.x(), 8), max(area.width() - widget.width() - 8, 8))
    y = min(max(at.y(), 8), max(area.height() - widget.height() - 8, 8))
    widget.move(x, y)


def on_grid(at: QPointF) -> Position:
    return round(at.x() / GRID) * GRID, round(at.y() / GRID) * GRID


def free_place(places: Mapping[str, Position], source: str) -> Position:
    """A free place right of a state, or below it."""
    x, y = places[source]
    for dx, dy in ((218, 0), (0, 172), (218, 172), (-218, 0), (0, -172), (436, 0), (218, -172)):
        at = (x + dx, y + dy)
        if all(abs(at[0] - ox) > 120 or abs(at[1] - oy) > 70 for ox, oy in places.values()):
            return at
    return x + 109, y + 86
