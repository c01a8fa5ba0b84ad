"""Where an arrow key leads on the start page."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRect, Qt

from smsl_studio.studio.features.start.tile import Tile


def nearest(tile: Tile, others: Sequence[Tile], key: int) -> Tile | None:
    """The nearest other tile in the direction of an arrow; None if there is none."""
    keys, here = Qt.Key, _box(tile)

    def far(one: Tile) -> tuple[float, float] | None:
        """How far a tile is, along the direction and across it; None if it is elsewhere."""
        there = _box(one)
        along = {
            keys.Key_Right: there.left() - here.right(),
            keys.Key_Left: here.left() - there.right(),
            keys.Key_Down: there.top() - here.bottom(),
            keys.Key_Up: here.top() - there.bottom(),
        }[Qt.Key(key)]
        if along < 0:
            return None
        off = there.center() - here.center()
        upright = key in (keys.Key_Down, keys.Key_Up)
        meets = (
            there.left() <= here.right() and there.right() >= here.left()
            if upright
            else there.top() <= here.bottom() and there.bottom() >= here.top()
        )
        across = abs(off.x() if upright else off.y())
        return along + (0 if meets else 1000), across

    found = [(far(one), at) for at, one in enumerate(others) if one is not tile]
    best = min(((far_, at) for far_, at in found if far_ is not None), default=None)
    return others[best[1]] if best is not None else None


def _box(tile: Tile) -> QRect:
    return QRect(tile.mapToGlobal(tile.rect().topLeft()), tile.size())
