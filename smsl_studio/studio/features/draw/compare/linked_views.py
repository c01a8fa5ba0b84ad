"""Two canvases with the same zoom and position."""

from __future__ import annotations

from PySide6.QtCore import QObject

from smsl_studio.studio.base.canvas.canvas import Canvas


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

    def _follow(self, canvas: Canvas, follower: Canvas) -> None:
        if self._following:
            return
        self._following = True
        try:
            follower.camera.keep(canvas.camera.keeps, canvas.camera.fitted)
            follower.camera.go(canvas.camera.centre, canvas.zoom, smooth=False)
        finally:
            self._following = False
