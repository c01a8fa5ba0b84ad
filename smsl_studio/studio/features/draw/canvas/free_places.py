"""Finds free places for new states (scene units) and for floating fields (pixels)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QPoint, QPointF
from PySide6.QtWidgets import QWidget

from smsl_studio.picture.levels import FULL_SIZE, ROOM
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.gestures import GRID

Position = tuple[float, float]


def place_near(widget: QWidget, area: QWidget, at: QPoint) -> None:
    """Move a widget to a point of an area; it stays inside the area."""
    widget.adjustSize()
    x = min(max(at.x(), 8), max(area.width() - widget.width() - 8, 8))
    y = min(max(at.y(), 8), max(area.height() - widget.height() - 8, 8))
    widget.move(x, y)


def on_grid(at: QPointF) -> Position:
    """The grid point nearest to a scene point."""
    return round(at.x() / GRID) * GRID, round(at.y() / GRID) * GRID


APART = (FULL_SIZE[0] + ROOM[0], FULL_SIZE[1] + ROOM[1])
"""The least distance of a new state to others, across and down, in scene units.

One of the two is enough. With less, full nodes would have no room for an arrow, and the drawing
would become compact.
"""
AROUND = ((218, 0), (0, 172), (218, 172), (-218, 0), (0, -172), (436, 0), (218, -172))
"""The offsets from the other state that are tried, best first, in scene units."""
SIBLINGS = ((0, 172), (0, -172), (0, 344), (0, -344), (218, 0))
"""The offsets from a state to others that are reached from the same one, best first."""
STEP = (218.0, 172.0)
"""The largest distance of a place beside a state from the view (scene units)."""
TRIED = 40
"""How many places across, and how many down, are tried in the view."""


def free_place(
    canvas: BranchView, beside: str = "", around: Sequence[Position] = AROUND
) -> Position:
    """A free place for a new state, in scene units.

    It lies beside the state ``beside``, at one of the offsets ``around``. Without such a state it
    lies right of all states. A place may be up to ``STEP`` outside the view, so that a chain of
    states stays in its line. The caller scrolls to it. If all these places are farther away, the
    nearest free place in the view is taken.
    """
    places = canvas.positions
    seen = canvas.clear_view
    if not places:
        return seen.center().x(), seen.center().y()
    x, y = places[beside] if beside in places else max(places.values())
    offsets = around if beside in places else ((218, 0),)
    wishes = [(x + dx, y + dy) for dx, dy in offsets]
    if not seen.contains(QPointF(x, y)):
        x, y = seen.center().x(), seen.center().y()
    across, down = max(APART[0] / 2, seen.width() / TRIED), max(APART[1] / 2, seen.height() / TRIED)
    inside = [
        (seen.left() + i * across, seen.top() + j * down)
        for i in range(int(seen.width() / across) + 1)
        for j in range(int(seen.height() / down) + 1)
    ]
    inside.sort(key=lambda at: (at[0] - x) ** 2 + (at[1] - y) ** 2)
    step = seen.adjusted(-STEP[0], -STEP[1], STEP[0], STEP[1])
    near = [wish for wish in wishes if step.contains(QPointF(*wish))] + inside
    free = [one for one in near if _is_free(canvas, one)]
    at = next((one for one in free[:TRIED] if not _is_drawn_on(canvas, one)), None)
    return (
        at
        or next(iter(free), None)
        or next((one for one in wishes if _is_free(canvas, one)), _right_of_all(places))
    )


def beside_all(canvas: BranchView, states: Sequence[str]) -> Position | None:
    """How far the copies of several states move (scene units), so that they stand beside all of
    them and near no other state. None for one state, and if there is no such place."""
    places = canvas.positions
    own = [places[state] for state in states if state in places]
    if len(own) < 2:
        return None
    across, down = (max(axis) - min(axis) for axis in zip(*own, strict=True))
    wide, high = on_grid(QPointF(across + STEP[0], down + STEP[1]))
    ways = ((0.0, high), (wide, 0.0), (0.0, -high), (-wide, 0.0), (wide, high))
    free = (way for way in ways if all(_is_free(canvas, _moved(at, way)) for at in own))
    return next(free, None)


def _moved(at: Position, way: Position) -> Position:
    return at[0] + way[0], at[1] + way[1]


def _is_free(canvas: BranchView, at: Position) -> bool:
    """Whether no state is too near. The distance grows with the marks when zoomed out."""
    sheet = canvas.sheet
    if sheet is None:
        return True
    wide, high = (max(apart, apart * sheet.unit) for apart in APART)
    off = abs(sheet.at - at)
    return not ((off[:, 0] <= wide) & (off[:, 1] <= high)).any()


def _is_drawn_on(canvas: BranchView, at: Position) -> bool:
    """Whether lines are drawn where the node of a new state would be."""
    sheet = canvas.sheet
    if sheet is None:
        return False
    wide, high = (apart / 2 * max(1.0, sheet.unit) for apart in APART)
    return sheet.is_drawn_on(at[0] - wide, at[1] - high, at[0] + wide, at[1] + high)


def _right_of_all(places: Mapping[str, Position]) -> Position:
    x, y = max(places.values())
    return x + 218.0, y
