"""What a floating widget would cover at a place of a canvas, and the places along its rim."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, QRectF, QSize

from smsl_studio.picture.labels import Rect, meet
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.lit_labels import lit_boxes

SPACE = 6
"""The free room around a floating widget (pixels)."""
MANY = 200
"""With more operations than this near a widget their names are not looked at one by one."""
SHARES = (1.0, 0.0, 0.5, 0.75, 0.25)
"""Where a widget is tried along each side of the view: first at the ends, then between."""


def on_states(canvas: BranchView, corner: QPoint, size: QSize) -> bool:
    """Whether a widget of this size at this corner (pixels) covers a state, a note or a title."""
    sheet = canvas.sheet
    if sheet is None:
        return False
    sides = _sides(canvas, corner, size)
    found = bool(sheet.states_in(*sides)) or sheet.drawn.touches(*sides)
    return found or on_pending(canvas, sides)


def on_fitted(canvas: BranchView, corner: QPoint, size: QSize) -> bool:
    """Whether a widget of this size at this corner (pixels) covers states or lines of a fitted
    picture. In a view that was zoomed or moved it is always False."""
    sheet = canvas.sheet
    if sheet is None or not canvas.camera.fitted:
        return False
    sides = _sides(canvas, corner, size)
    return sheet.is_drawn_on(*sides) or on_pending(canvas, sides)


def on_pending(canvas: BranchView, sides: Rect) -> bool:
    """Whether a part of the scene touches the place of a new state that is being named."""
    left, top, right, bottom = sides
    return canvas.pending.intersects(QRectF(left, top, right - left, bottom - top))


def is_clear_of_dense(canvas: BranchView, corner: QPoint, size: QSize) -> bool:
    """Whether the legend of a dense drawing covers nothing there. It gives way to names that are
    lit in a run only: while one draws, a selection moves none of its buttons."""
    names = not canvas.editing and on_names(canvas, QRect(corner, size))
    return not names and not on_states(canvas, corner, size)


def on_picture(canvas: BranchView, corner: QPoint, size: QSize) -> bool:
    """Whether a widget covers the fitted drawing, or states, notes and titles of any view."""
    if canvas.sheet is None or canvas.camera.fitted:
        return on_fitted(canvas, corner, size)
    return on_states(canvas, corner, size)


def on_drawing(canvas: BranchView, corner: QPoint, size: QSize) -> bool:
    """Whether a widget of this size at this corner (pixels) covers the picture, or names of its
    operations: text on text cannot be read.

    Of an area with very many operations that is believed at once. In a view without its size the
    names have no places yet.
    """
    sheet = canvas.sheet
    if on_picture(canvas, corner, size):
        return True
    if sheet is None or sheet.level < Level.COMPACT or not canvas.settled:
        return False
    sides = _sides(canvas, corner, size)
    near = sheet.edges_in(*sides).tolist()
    if len(near) > MANY:
        return True
    names = filter(None, map(sheet.geometry.label, near))
    return any(meet(name, sides) for name in names)


def on_names(canvas: BranchView, area: QRect) -> bool:
    """Whether an area (pixels) covers the name of an operation that is lit, such as the running
    one, or a lit state of a far picture, such as the active one: it is larger than the others."""
    sheet = canvas.sheet
    if sheet is None:
        return False
    names = [label.rect for label in canvas.lit_layer.shown().values()]
    # A lit state has a ring around it.
    for parts, ring in ((names, 0), (lit_boxes(sheet), SPACE)):
        around = area.adjusted(-ring, -ring, ring, ring)
        for left, top, right, bottom in parts:
            part = QRectF(left, top, right - left, bottom - top)
            if canvas.mapFromScene(part).boundingRect().intersects(around):
                return True
    return False


def along_the_rim(inside: QRect, size: QSize) -> list[QPoint]:
    """The corners for a widget of this size at the foot, the sides and the top of a part of the
    view (pixels)."""
    across, down = inside.width() - size.width(), inside.height() - size.height()
    if across < 0 or down < 0:
        return []
    ends = [(share, side) for side in (1.0, 0.0) for share in SHARES]
    shares = [*ends, *((x, y) for x in (1.0, 0.0) for y in SHARES[2:])]
    return [inside.topLeft() + QPoint(round(across * x), round(down * y)) for x, y in shares]


def _sides(canvas: BranchView, corner: QPoint, size: QSize) -> Rect:
    """The part of the scene below a widget, with some room: left, top, right, bottom."""
    near = canvas.mapToScene(corner - QPoint(SPACE, SPACE))
    far = canvas.mapToScene(corner + QPoint(size.width() + SPACE, size.height() + SPACE))
    return near.x(), near.y(), far.x(), far.y()
