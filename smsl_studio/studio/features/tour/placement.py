"""Where a callout stands beside the control that it points at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPoint, QRect, QSize

GAP = 10
"""Pixels between the control and the callout."""
STEP = 20
"""Pixels between the places apart from the control that are tried."""
LOW = 40
"""Pixels below a callout that points at nothing."""


@dataclass(frozen=True)
class BesideControl:
    """A place for a callout: its box, and its side of the control; empty if it points at none."""

    box: QRect
    side: str = ""


def beside(target: QRect, size: QSize, room: QRect, spared: Sequence[QRect] = ()) -> BesideControl:
    """The place of a callout inside ``room``. It never covers ``target``, the control that it
    explains.

    The places below the target, above it, at its right and at its left are tried first, in this
    order. The first place that covers nothing of ``spared`` is taken. If there is none, other
    places in the room are tried, too. Then the place that covers the least of ``spared`` is taken.
    Of several such places the nearest is taken.
    """
    found = list(_sides(target, size, room))
    clear = [one for one in found if not _covered(one.box, spared)]
    if clear:
        return clear[0]
    apart = [BesideControl(box) for box in _apart(target, size, room)]
    best = min(
        [*found, *apart],
        key=lambda one: (_covered(one.box, spared), _way(one.box, target)),
        default=None,
    )
    return best or without_control(size, room)


def _sides(target: QRect, size: QSize, room: QRect) -> Iterator[BesideControl]:
    """The places at the four sides of a control that do not cover it."""
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
            yield BesideControl(box, side)


def _apart(target: QRect, size: QSize, room: QRect) -> Iterator[QRect]:
    """Places all over ``room`` that do not cover the target."""
    for x in range(room.left(), room.right() - size.width() + 1, STEP):
        for y in range(room.top(), room.bottom() - size.height() + 1, STEP):
            box = QRect(QPoint(x, y), size)
            if not box.intersects(target):
                yield box


def _covered(box: QRect, spared: Sequence[QRect]) -> int:
    """How much of some boxes another one covers (square pixels)."""
    common = [box.intersected(one) for one in spared]
    return sum(one.width() * one.height() for one in common if not one.isEmpty())


def _way(box: QRect, target: QRect) -> int:
    return (box.center() - target.center()).manhattanLength()


def without_control(size: QSize, room: QRect) -> BesideControl:
    """The place of a callout that points at nothing: low in the middle of ``room``."""
    box = QRect(QPoint(), size)
    box.moveCenter(room.center())
    box.moveBottom(room.bottom() - LOW)
    return BesideControl(box)
