"""Places of cards over the canvas, where they cover as little as possible (pixels of the view)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPoint, QRect, QSize

from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.canvas import Canvas

EDGE = 14
STEP = 16
"""The distance between the places that are tried."""
CROWD = 500
"""With more states than this in view, no free place is searched for."""


def is_clear(canvas: Canvas, area: QRect) -> bool:
    """Whether an area of the view has no state, no note and no title of a group."""
    sheet = canvas.sheet
    if sheet is None:
        return True
    box = canvas.mapToScene(area).boundingRect()
    sides = box.left(), box.top(), box.right(), box.bottom()
    return not sheet.states_in(*sides) and not sheet.drawn.touches(*sides)


def free_of_all(
    canvas: Canvas, size: QSize, near: QPoint, spared: Sequence[QRect]
) -> QPoint | None:
    """The place nearest to a point where a message covers no state, no note, and nothing else.

    None if there is no such place.
    """
    at, hidden = _best(canvas, size, near, spared)
    return at if not hidden else None


def least_covering(
    canvas: Canvas, size: QSize, near: QPoint, spared: Sequence[QRect] = ()
) -> QPoint:
    """The nearest place to a point where a card covers the fewest states and notes.

    If possible, the card covers no floating part and nothing of ``spared``. If that is not
    possible, it covers a floating part before it covers anything of ``spared``.
    """
    return _best(canvas, size, near, spared)[0]


def _best(
    canvas: Canvas, size: QSize, near: QPoint, spared: Sequence[QRect]
) -> tuple[QPoint, float]:
    """The best place for a card, and how much it covers there."""
    spots = _spots(canvas, size)
    drawn = _drawn_in_view(canvas)
    if not len(spots) or len(drawn) > CROWD:
        return near, 1.0
    floats, kept = _sides(canvas.overlays.floats()), _sides(spared)
    # A floating part counts more than all states, and a spared part counts more than both.
    part = len(drawn) + 1
    hidden = (
        _covered(drawn, spots, size)
        + part * _covered(floats, spots, size)
        + part * (len(floats) + 1) * _covered(kept, spots, size)
    )
    ways = np.abs(spots - (near.x(), near.y())).sum(axis=1)
    best = int(np.lexsort((ways, hidden))[0])
    x, y = spots[best].tolist()
    return QPoint(int(x), int(y)), float(hidden[best])


def _spots(canvas: Canvas, size: QSize) -> Floats:
    """The possible upper left corners of a card fully inside the view, (n, 2), row by row."""
    across = np.arange(EDGE, canvas.width() - EDGE - size.width() + 1, STEP, dtype=np.float64)
    down = np.arange(EDGE, canvas.height() - EDGE - size.height() + 1, STEP, dtype=np.float64)
    x, y = np.meshgrid(across, down)
    spots: Floats = np.column_stack([x.ravel(), y.ravel()])
    return spots


def selected_places(canvas: Canvas) -> list[QRect]:
    """The places of the selected states and labels."""
    rects = [canvas.rect_of(address) for address in canvas.marks.selection[:CROWD]]
    return [canvas.mapFromScene(rect).boundingRect() for rect in rects if rect is not None]


def _sides(rects: Sequence[QRect]) -> Floats:
    """Left, top, right and bottom of rectangles, shape (n, 4)."""
    sides = [(one.x(), one.y(), one.x() + one.width(), one.y() + one.height()) for one in rects]
    return np.array(sides, dtype=np.float64).reshape(-1, 4)


def _covered(rects: Floats, spots: Floats, size: QSize) -> Floats:
    """The number of rectangles that a card covers at each place of ``spots``, (n,)."""
    x, y = spots.T[:, :, None]
    left, top, right, bottom = rects.T
    across = (left < x + size.width()) & (right > x)
    found: Floats = np.sum(across & (top < y + size.height()) & (bottom > y), axis=1, dtype=float)
    return found


def _drawn_in_view(canvas: Canvas) -> Floats:
    """Left, top, right and bottom of the nodes and notes in the view, in pixels, shape (n, 4)."""
    sheet = canvas.sheet
    if sheet is None:
        return np.empty((0, 4))
    box = canvas.mapToScene(canvas.viewport().rect()).boundingRect()
    seen = sheet.states_in(box.left(), box.top(), box.right(), box.bottom())
    at, half, way = sheet.at[seen], sheet.halves()[seen], canvas.viewportTransform()
    rects = np.vstack([np.hstack([at - half, at + half]), sheet.drawn.note_rects])
    return rects * way.m11() + [way.dx(), way.dy()] * 2
