"""Handles: where an operation can be drawn from, at the border of each state."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF

from smsl_studio.studio.base.canvas.sheet import Sheet

OUT = 6.0
"""How far a handle's middle stands outside the border (pixels)."""


def handles(sheet: Sheet, state: int) -> dict[str, QPointF]:
    """Where the handles of a state stand, by side (scene points)."""
    x, y = sheet.at[state].tolist()
    w, h = sheet.halves()[state].tolist()
    out = OUT / sheet.zoom
    return {
        "right": QPointF(x + w + out, y),
        "left": QPointF(x - w - out, y),
        "top": QPointF(x, y - h - out),
        "bottom": QPointF(x, y + h + out),
    }


def nearest(sheet: Sheet, state: int, point: QPointF) -> QPointF:
    """The handle on the side of a node that is nearest to a point."""
    x, y = sheet.at[state].tolist()
    w, h = sheet.halves()[state].tolist()
    dx, dy = point.x() - x, point.y() - y
    away = {
        "right": abs(w - dx),
        "left": abs(w + dx),
        "bottom": abs(h - dy),
        "top": abs(h + dy),
    }
    return handles(sheet, state)[min(away, key=lambda side: away[side])]


def pending_ends(
    sheet: Sheet, state: int, at: QPointF, goal: QRectF | None
) -> tuple[QPointF, QPointF]:
    """Where a pending operation leaves its source, and where it ends: at a point or a node."""
    aim = goal.center() if goal is not None else at
    x, y = sheet.at[state].tolist()
    w, h = sheet.halves()[state].tolist()
    dx, dy = aim.x() - x, aim.y() - y
    across = abs(dx) / w >= abs(dy) / h
    side = ("right" if dx > 0 else "left") if across else ("bottom" if dy > 0 else "top")
    start = handles(sheet, state)[side]
    if goal is None:
        return start, at
    step = goal.center() - start
    # From the border of the target, not from its middle.
    reach = min(
        (goal.width() / 2 + 3.0) / max(abs(step.x()), 1e-6),
        (goal.height() / 2 + 3.0) / max(abs(step.y()), 1e-6),
    )
    return start, goal.center() - step * min(reach, 0.9)
