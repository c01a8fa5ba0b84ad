"""Handles: the points at the border of a state from which an operation can be drawn."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtWidgets import QGraphicsView

from smsl_studio.studio.base.canvas.gesture_layer import HANDLE_RADIUS
from smsl_studio.studio.base.canvas.sheet import Sheet

OUT = 6.0
"""Distance from the node's border to the middle of a handle (pixels)."""
RIM = 1 / 18
"""A handle takes presses in a rim of this share of the node's shorter side: 3 of 54 pixels."""

TAIL = 8.0
"""Distance along a line from its beginning to its tail (pixels)."""
SHORT = 36.0
"""A shorter line has no tail (pixels)."""


def handles(sheet: Sheet, state: int) -> dict[str, QPointF]:
    """The handles of a state as scene points: right, left, top, bottom."""
    x, y = sheet.at[state].tolist()
    w, h = sheet.halves(state).tolist()
    out = OUT / sheet.zoom
    return {
        "right": QPointF(x + w + out, y),
        "left": QPointF(x - w - out, y),
        "top": QPointF(x, y - h - out),
        "bottom": QPointF(x, y + h + out),
    }


def nearest(sheet: Sheet, state: int, point: QPointF) -> QPointF:
    """The handle on that side of a node which is nearest to a scene point."""
    x, y = sheet.at[state].tolist()
    w, h = sheet.halves(state).tolist()
    dx, dy = point.x() - x, point.y() - y
    away = {
        "right": abs(w - dx),
        "left": abs(w + dx),
        "bottom": abs(h - dy),
        "top": abs(h + dy),
    }
    return handles(sheet, state)[min(away, key=lambda side: away[side])]


def takes(view: QGraphicsView, sheet: Sheet, state: int, handle: QPointF, at: QPointF) -> bool:
    """Whether a press at a scene point takes the handle of a state. Otherwise it moves the state.

    A handle lies outside the node. Inside the node it takes presses only in a thin rim, so that
    small nodes can still be moved.
    """
    (x, y), (w, h) = sheet.at[state].tolist(), sheet.halves(state).tolist()
    deep = min(w - abs(at.x() - x), h - abs(at.y() - y))
    return deep <= 2 * min(w, h) * RIM and is_near(view, at, handle, HANDLE_RADIUS + 1.0)


def tail_of(sheet: Sheet, edge: int) -> QPointF | None:
    """Where the line of an operation is taken to let it start from another state (scene point).

    It lies at the beginning of the line, so far out that a press there does not take the state.
    None if the line is too short for two ends.
    """
    shape = sheet.geometry.shape(edge)
    if shape.length * sheet.zoom < SHORT:
        return None
    return QPointF(*shape.at(TAIL / sheet.zoom))


def is_near(view: QGraphicsView, a: QPointF, b: QPointF | None, pixels: float) -> bool:
    """Whether two scene points are at most so far apart on the screen."""
    if b is None:
        return False
    step = (a - b) * view.transform().m11()
    return step.x() ** 2 + step.y() ** 2 <= pixels**2


def pending_ends(
    sheet: Sheet, state: int, at: QPointF, goal: QRectF | None
) -> tuple[QPointF, QPointF]:
    """The two ends (scene points) of an operation that is being named.

    It ends at ``at``, or at the border of the rectangle ``goal``.
    """
    aim = goal.center() if goal is not None else at
    x, y = sheet.at[state].tolist()
    w, h = sheet.halves(state).tolist()
    dx, dy = aim.x() - x, aim.y() - y
    across = abs(dx) / w >= abs(dy) / h
    side = ("right" if dx > 0 else "left") if across else ("bottom" if dy > 0 else "top")
    start = handles(sheet, state)[side]
    if goal is None:
        return start, at
    step = goal.center() - start
    # The line ends at the border of the target, not in its middle.
    reach = min(
        (goal.width() / 2 + 3.0) / max(abs(step.x()), 1e-6),
        (goal.height() / 2 + 3.0) / max(abs(step.y()), 1e-6),
    )
    return start, goal.center() - step * min(reach, 0.9)
