"""Two canvases with the same zoom and position."""

from __future__ import annotations

from PySide6.QtCore import QObject, QPointF, QRectF

from smsl_studio.studio.base.canvas.canvas import Canvas

DOTS = 0.2
"""At a zoom below this, no text can be read."""
AROUND = 170, 100
"""The width and height of a state with some space around it (scene units)."""


class LinkedViews(QObject):
    """Keeps zoom and centre of two canvases equal; both use the same positions for their states."""

    def __init__(self, one: Canvas, other: Canvas, parent: QObject) -> None:
        super().__init__(parent)
        self._pair = one, other
        self._following = False
        for canvas, follower in ((one, other), (other, one)):
            canvas.camera.motion = False
            canvas.view_moved.connect(lambda c=canvas, f=follower: self._follow(c, f))
            canvas.zoom_changed.connect(lambda _, c=canvas, f=follower: self._follow(c, f))

    def fit(self) -> None:
        """Fit the drawings of both sides."""
        sides = [c for c in self._pair if c.sheet is not None and len(c.sheet.at)]
        for canvas in sides:
            self._following = True
            canvas.fit(smooth=False)
            self._following = False
        if len(sides) == 2:
            # The side with the smaller zoom leads, so that both fit.
            leader = min(sides, key=lambda canvas: canvas.zoom)
            self._follow(leader, sides[0] if leader is sides[1] else sides[1])
        # Very long names of operations can leave no room for the states, which then are dots.
        least = min((_zoom_of_states(canvas) for canvas in sides), default=0.0)
        if least > DOTS and any(canvas.zoom < DOTS for canvas in sides):
            sides[0].camera.go(_middle(sides[0]), least, smooth=False)

    def _follow(self, canvas: Canvas, follower: Canvas) -> None:
        if self._following:
            return
        self._following = True
        try:
            follower.camera.keep(canvas.camera.keeps, canvas.camera.fitted)
            follower.camera.go(canvas.camera.centre, canvas.zoom, smooth=False)
        finally:
            self._following = False


def _box(canvas: Canvas) -> QRectF:
    """The rectangle of the middles of all states, in scene units."""
    places = list(canvas.positions.values())
    left, top = (min(place[axis] for place in places) for axis in (0, 1))
    right, foot = (max(place[axis] for place in places) for axis in (0, 1))
    return QRectF(QPointF(left, top), QPointF(right, foot))


def _middle(canvas: Canvas) -> QPointF:
    return _box(canvas).center()


def _zoom_of_states(canvas: Canvas) -> float:
    """The zoom at which all states are visible, without names of operations. At most 1."""
    box = _box(canvas)
    across = canvas.width() / (box.width() + AROUND[0])
    down = canvas.height() / (box.height() + AROUND[1])
    return min(across, down, 1.0)
