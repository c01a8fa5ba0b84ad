"""Two canvases that look at the same place: who moves one moves the other."""

from __future__ import annotations

from PySide6.QtCore import QObject

from smsl_studio.studio.base.canvas.canvas import Canvas


class LinkedViews(QObject):
    """Keeps zoom and place of two canvases equal; they show the same states at one place."""

    def __init__(self, one: Canvas, other: Canvas, parent: QObject) -> None:
        super().__init__(parent)
        self._pair = one, other
        self._following = False
        for canvas, follower in ((one, other), (other, one)):
            canvas.camera.motion = False
            canvas.view_moved.connect(lambda c=canvas, f=follower: self._follow(c, f))
            canvas.zoom_changed.connect(lambda _, c=canvas, f=follower: self._follow(c, f))

    def fit(self) -> None:
        """Show everything of both sides."""
        sides = [c for c in self._pair if c.sheet is not None and len(c.sheet.at)]
        for canvas in sides:
            self._following = True
            canvas.fit(smooth=False)
            self._following = False
        if len(sides) == 2:
            # The one that needs to stand further away leads.
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
