"""Finds free places for new notes (scene units)."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import QPointF, QRectF

from smsl_studio.picture.drawn_parts import NOTE_WIDTH
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.gestures import GRID
from smsl_studio.studio.base.canvas.sheet import Sheet

Position = tuple[float, float]
HIGH = 66.0
"""The height of a note of two lines."""
AWAY = 32.0
"""The distance of a note from its state."""
FARTHER = (0.0, 48.0, 96.0, 144.0, 192.0)
"""How much farther away a note is tried, if the places beside its state are taken."""
RINGS = 12
"""How many steps away from the middle of the view a place is sought."""


def place_in_view(canvas: Canvas) -> Position:
    """A place for the upper left corner of a free note, near the middle of the view."""
    middle = canvas.seen.center()
    x, y = middle.x() - NOTE_WIDTH / 2, middle.y() - HIGH / 2
    wishes = sorted(_around(), key=lambda way: way[0] ** 2 + way[1] ** 2)
    places = (_on_grid((x + dx * 48.0, y + dy * 40.0)) for dx, dy in wishes)
    seen = canvas.clear_view
    free = (
        at for at in places
        if seen.contains(QRectF(*at, NOTE_WIDTH, HIGH)) and _is_free(canvas.sheet, at)
    )  # fmt: skip
    return next(free, _on_grid((x, y)))


def place_at(canvas: Canvas, state: str) -> Position:
    """A place for the upper left corner of a note on a state, from the centre of the state."""
    rect_x, rect_y = canvas.positions[state]
    sheet = canvas.sheet
    assert sheet is not None
    half, high = sheet.halves(sheet.picture.index[state]).tolist()
    ways = [way for more in FARTHER for way in _ways(half, high, more)]
    seen = canvas.seen

    def cost(way: Position) -> tuple[bool, bool]:
        """Whether a note would be out of view, or cover something."""
        x, y = _on_grid(way)
        at = rect_x + x, rect_y + y
        return not seen.contains(QRectF(*at, NOTE_WIDTH, HIGH)), not _is_free(sheet, at)

    return _on_grid(min(ways, key=cost))


def _ways(half: float, high: float, more: float) -> Iterator[Position]:
    """Yield places around a state for the upper left corner of a note, from the state's centre.

    ``half`` and ``high`` are half the width and height of the state. ``more`` is added to the usual
    distance.
    """
    across, up, down = half + AWAY + more, -HIGH - high - more, high + more
    for left in (across, -across - NOTE_WIDTH):
        yield left, up
        yield left, down
    yield -NOTE_WIDTH / 2, up - AWAY
    yield -NOTE_WIDTH / 2, down + AWAY
    yield across, -HIGH / 2
    yield -across - NOTE_WIDTH, -HIGH / 2


def near(at: QPointF) -> Position:
    """The grid point nearest to a scene point."""
    return _on_grid((at.x(), at.y()))


def _around() -> Iterator[tuple[int, int]]:
    steps = range(-RINGS, RINGS + 1)
    return ((dx, dy) for dx in steps for dy in steps)


def _on_grid(at: Position) -> Position:
    return round(at[0] / GRID) * GRID, round(at[1] / GRID) * GRID


def _is_free(sheet: Sheet | None, at: Position) -> bool:
    """Whether a note with its corner here covers no node, no line and no other note."""
    if sheet is None:
        return True
    return not sheet.is_drawn_on(at[0], at[1], at[0] + NOTE_WIDTH, at[1] + HIGH)
