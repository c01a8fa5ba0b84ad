"""Where a callout stands beside the control that it points at."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QPoint, QRect, QSize

GAP = 10
"""Pixels between the control and the callout."""
LOW = 40
"""Pixels below a callout that points at nothing."""


@dataclass(frozen=True)
class BesideControl:
    """A place for a callout: its box, and its side of the control; empty if it points at none."""

    box: QRect
    side: str = ""


def beside(target: QRect, size: QSize, room: QRect) -> BesideControl:
    """The first place inside ``room`` where a callout does not cover ``target``: below it, above
    it, at its right or at its left."""
    wide, high = size.width(), size.height()
    middle = target.center() - QPoint(wide // 2, high // 2)
    corners = {
        "below": QPoint(middle.x(), target.bottom() + GAP),
        "above": QPoint(middle.x(), target.top() - GAP - high),
        "right": QPoint(target.right() + GAP, middle.y()),
        "left": QPoint(target.left() - GAP - wide, middle.y()),
    }
    for side, corner in corners.items():
        box = QRect(corner, size)
        box.moveLeft(max(room.left(), min(box.left(), room.right() - wide)))
        box.moveTop(max(room.top(), min(box.top(), room.bottom() - high)))
        if not box.intersects(target):
            return BesideControl(box, side)
    return without_control(size, room)


def without_control(size: QSize, room: QRect) -> BesideControl:
    """The place of a callout that points at nothing: low in the middle of ``room``."""
    box = QRect(QPoint(), size)
    box.moveCenter(room.center())
    box.moveBottom(room.bottom() - LOW)
    return BesideControl(box)
