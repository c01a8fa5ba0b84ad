"""Frames: which part of a sheet a view shows by itself, and at which zoom."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF

from smsl_studio.picture.levels import Level, level_at, readable_zoom, unit_at
from smsl_studio.studio.base.canvas.camera import fit_zoom
from smsl_studio.studio.base.canvas.sheet import Sheet

Room = tuple[float, float]
MARGIN = (28.0, 20.0)
"""Pixels left free: left and right together, top and bottom together."""
FAR_MARKS = (56.0, 64.0)
"""Pixels that compact nodes, the initial dot and labels need beyond the node centres."""
INITIAL_MARK = 28.0
"""Pixels that the initial dot and its arrow need at the left of a node."""
RIM = 4.0
"""Pixels around a node that belong to it."""
FULL_FROM = 0.70


def frame_of(sheet: Sheet, room: Room) -> tuple[QPointF, float]:
    """The scene point for the middle and the zoom (100 % at most) that show a whole sheet.

    ``room`` is the free width and height in pixels.
    """
    before = sheet.zoom
    try:
        if not sheet.picture.small:
            centres = _centres(sheet)
            widest = float(sheet.compact_widths.max())
            marks = widest + FAR_MARKS[0], FAR_MARKS[1]
            return centres.center(), fit_zoom(centres, marks, room)
        if sheet.spacing.roomy:
            sheet.set_zoom(1.0)
            whole = bounds_of(sheet)
            zoom = fit_zoom(whole, MARGIN, room)
            if zoom >= FULL_FROM:
                return whole.center(), zoom
        return _compact_frame(sheet, room)
    finally:
        sheet.set_zoom(before)


def opening_of(sheet: Sheet, room: Room, whole: float) -> tuple[QPointF, float] | None:
    """The middle and zoom for the first look at an SB that is too large to be read as a whole.

    ``whole`` is the zoom that shows everything. The initial state is in view, with as little empty
    space around the drawing as possible. None if the SB can be read at ``whole``.
    """
    zoom = readable_zoom(sheet.spacing)
    if whole >= zoom:
        return None
    initial = sheet.picture.index.get(sheet.picture.branch.initial, 0)
    widest, unit = float(sheet.compact_widths.max()), unit_at(zoom, level_at(zoom, sheet.spacing))
    across, down = (widest + FAR_MARKS[0]) / 2 * unit, FAR_MARKS[1] / 2 * unit
    extent = _centres(sheet).adjusted(-across, -down, across, down)
    x, y = sheet.at[initial]
    wide, high = room[0] / zoom, room[1] / zoom
    return QPointF(
        _held(x, wide, extent.left(), extent.right()),
        _held(y, high, extent.top(), extent.bottom()),
    ), zoom


def _held(at: float, size: float, low: float, high: float) -> float:
    """The middle of a view of this size, as near to ``at`` as possible without passing low or
    high."""
    if size >= high - low:
        return (low + high) / 2
    return min(max(at, low + size / 2), high - size / 2)


def _compact_frame(sheet: Sheet, room: Room) -> tuple[QPointF, float]:
    """The frame of compact nodes.

    Labels and signs keep their size on the screen. So a second step corrects the zoom of the first
    one. If there is no space for labels, the frame is that of a far picture, which has none.
    """
    centres = _centres(sheet)
    most = FULL_FROM - 0.01 if sheet.spacing.roomy else 1.0
    # Mostly no line leads farther out than nodes and marks. Then the second step finds a zoom with
    # the same lines, and nothing is laid out twice.
    outside = MARGIN[0] + float(sheet.compact_widths.max()) + 2 * RIM, FAR_MARKS[1]
    initial = sheet.picture.index.get(sheet.picture.branch.initial, -1)
    if initial >= 0 and sheet.at[initial][0] <= centres.left():
        outside = outside[0] + INITIAL_MARK - RIM, outside[1]
    zoom = fit_zoom(centres, outside, room, most)
    left = 2 if len(sheet.picture.operations) <= 120 else 1
    while left:
        left -= 1
        sheet.set_zoom(zoom)
        whole, far = bounds_of(sheet), sheet.level < Level.COMPACT
        least = FAR_MARKS if far else (0.0, 0.0)
        marks = (
            max((whole.width() - centres.width()) * zoom + MARGIN[0], least[0]),
            max((whole.height() - centres.height()) * zoom + MARGIN[1], least[1]),
        )
        near = readable_zoom(sheet.spacing)
        zoom = fit_zoom(centres, marks, room, min(most, near - 0.01) if far else most)
        if not left and not far and level_at(zoom, sheet.spacing) < Level.COMPACT:
            left = 1
    middle = centres.center() + (whole.center() - centres.center()) * (sheet.zoom / zoom)
    return middle, zoom


def _centres(sheet: Sheet) -> QRectF:
    low, high = sheet.extent()
    return QRectF(QPointF(*low), QPointF(*high)).united(sheet.drawn.extent())


def about(sheet: Sheet) -> QRectF:
    """About the rectangle that a sheet covers at its zoom (scene units). Lines and names of a large
    one are not looked at, because that takes seconds.
    """
    if sheet.picture.small:
        return bounds_of(sheet)
    across = (float(sheet.compact_widths.max()) + FAR_MARKS[0]) / 2 * sheet.unit
    down = FAR_MARKS[1] / 2 * sheet.unit
    return _centres(sheet).adjusted(-across, -down, across, down)


def bounds_of(sheet: Sheet) -> QRectF:
    """The rectangle that nodes, lines and labels cover at the sheet's zoom (scene units).

    A far picture has lines and labels for highlighted operations only.
    """
    half, unit = sheet.halves(), sheet.unit
    low, high = (sheet.at - half).min(axis=0), (sheet.at + half).max(axis=0)
    whole = QRectF(QPointF(*low), QPointF(*high)).adjusted(
        -RIM * unit, -RIM * unit, RIM * unit, RIM * unit
    )
    initial = sheet.picture.index.get(sheet.picture.branch.initial, -1)
    if initial >= 0:
        x, y = sheet.at[initial] - half[initial]
        whole = whole.united(QRectF(x - INITIAL_MARK * unit, y, INITIAL_MARK * unit, 10.0 * unit))
    for goal in sheet.looks.marks.goals & sheet.picture.index.keys():
        # The word "goal" stands below the node.
        x, y = sheet.at[sheet.picture.index[goal]]
        below = y + half[sheet.picture.index[goal]][1]
        whole = whole.united(QRectF(x, below, 1.0, 24.0 * unit))
    whole = whole.united(sheet.drawn.extent())
    far = sheet.level < Level.COMPACT
    for edge in sheet.looks.lit_edges if far else range(len(sheet.picture.operations)):
        geometry = sheet.geometry
        # Hidden labels count too, because a run may highlight each of them.
        for rect in (geometry.shape(edge).bounds, geometry.label(edge)):
            if rect is not None:
                left, top, right, bottom = rect
                whole = whole.united(QRectF(left, top, right - left, bottom - top))
    return whole
