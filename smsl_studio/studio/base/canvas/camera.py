"""Camera: zoom, pan and fit of a canvas, with the short movements between them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from PySide6.QtCore import (
    QEasingCurve,
    QObject,
    QPointF,
    QRectF,
    QTimer,
    QVariantAnimation,
    Signal,
)
from PySide6.QtGui import QTransform
from PySide6.QtWidgets import QGraphicsView

from smsl_studio.studio.base.calm import is_calm

LEAST, MOST = 0.02, 4.0
DURATION = 200
STEP = 1.2
"""The factor of one notch of the wheel and of the zoom buttons."""
REST = 120
"""The time after the last turn of the wheel (ms) until the zoom is at rest."""


@dataclass(frozen=True)
class CameraStand:
    """What a camera shows: the scene point in the middle, the zoom, and what it keeps (see
    ``Camera``)."""

    centre: QPointF
    zoom: float
    keeps: str
    fitted: bool


class Camera(QObject):
    """The scene point in the middle of a view, and the zoom.

    ``fitted`` says that the whole picture is in view. ``keeps`` says what to show again after the
    view changed its size: "fit" (the whole), "opening" (what an SB opens with), or empty after the
    user zoomed or panned.
    """

    zoom_changed = Signal(float)
    arrived = Signal()
    """A movement, or a jump without movement, has ended."""
    moved = Signal()
    """One step has ended, after ``moving`` was true."""
    rested = Signal()
    """The zoom is at rest, after ``turning`` was true."""

    def __init__(self, view: QGraphicsView) -> None:
        super().__init__(view)
        self._view = view
        self.motion = True
        self.fitted = False
        self.keeps = ""
        self.turning = False
        """Whether another zoom follows at once: the wheel turns, or a movement goes on."""
        self.moving = False
        """Whether one step is being made, of which the view scrolls and zooms one after another."""
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST)
        self._rest.timeout.connect(self.rested)
        self._animation = QVariantAnimation(self)
        self._animation.setDuration(DURATION)
        self._animation.setEasingCurve(QEasingCurve.Type.OutCubic)
        self._animation.setStartValue(0.0)
        self._animation.setEndValue(1.0)
        self._animation.valueChanged.connect(self._frame)
        self._animation.finished.connect(self.arrived)
        self._from = self._to = (QPointF(), 1.0)

    @property
    def zoom(self) -> float:
        """The zoom now; 1.0 is 100 %."""
        return self._view.transform().m11()

    @property
    def centre(self) -> QPointF:
        """The scene point in the middle of the view."""
        return self._view.mapToScene(self._view.viewport().rect()).boundingRect().center()

    @property
    def is_at_rest(self) -> bool:
        """Whether the zoom is at rest, or will not say that it is (see ``rested``)."""
        return not self._rest.isActive()

    def keep(self, what: str, fitted: bool = False) -> None:
        """Set ``keeps`` and ``fitted``."""
        self.keeps, self.fitted = what, fitted

    @property
    def stand(self) -> CameraStand:
        """What the camera shows; during a movement what it will show."""
        self.finish()
        return CameraStand(self.centre, self.zoom, self.keeps, self.fitted)

    def look_back(self, to: CameraStand) -> None:
        """Show again what was shown before."""
        if to != self.stand:
            self.keep(to.keeps, to.fitted)
            self.go(to.centre, to.zoom)

    def zoom_at(self, factor: float, at: QPointF, anchor: QPointF | None = None) -> QPointF:
        """Multiply the zoom; the scene point below ``at`` (viewport pixels) stays there.

        With ``anchor`` that scene point gets there. Returns the point. Many small steps need it,
        because the view stands at whole pixels only.
        """
        self._animation.stop()
        self.keep("")
        zoom = min(max(self.zoom * factor, LEAST), MOST)
        anchor = anchor if anchor is not None else self._scene_point(at)
        middle = QPointF(self._view.viewport().rect().center())
        self._look(anchor + (middle - at) / zoom, zoom, turning=True)
        return anchor

    def pan(self, dx: float, dy: float) -> None:
        """Move the picture by pixels."""
        self._animation.stop()
        self.keep("")
        bars = self._view.horizontalScrollBar(), self._view.verticalScrollBar()
        with self._one_step():
            bars[0].setValue(bars[0].value() - round(dx))
            bars[1].setValue(bars[1].value() - round(dy))

    def go(self, centre: QPointF, zoom: float, smooth: bool = True) -> None:
        """Show a scene point in the middle at this zoom.

        ``smooth`` moves there in a short animation.
        """
        zoom = min(max(zoom, LEAST), MOST)
        self._animation.stop()
        if not (smooth and self.motion and self._view.isVisible()) or is_calm():
            self._look(centre, zoom)
            self.arrived.emit()
            return
        self._from, self._to = (self.centre, self.zoom), (centre, zoom)
        self._animation.start()

    def finish(self) -> None:
        """Jump to the end of a movement."""
        if self._animation.state() is QVariantAnimation.State.Running:
            self._animation.stop()
            self._look(*self._to)

    def _frame(self, share: float) -> None:
        (a, za), (b, zb) = self._from, self._to
        zoom = za * (zb / za) ** share
        self._look(a + (b - a) * share, zoom, turning=share < 1.0)

    def _look(self, centre: QPointF, zoom: float, turning: bool = False) -> None:
        # A zoom close to 100 % becomes exactly 1.0, so that texts are sharp.
        if abs(zoom - 1.0) < 0.004:
            zoom = 1.0
        view = self._view
        with self._one_step():
            if zoom != self.zoom:
                self.turning = turning
                view.setTransform(QTransform.fromScale(zoom, zoom))
                self.zoom_changed.emit(zoom)
                self.turning = False
                if turning:
                    self._rest.start()
                else:
                    self._rest.stop()
            view.centerOn(centre)

    @contextmanager
    def _one_step(self) -> Iterator[None]:
        """What the view does in here is one step: who follows it looks once, at the end."""
        self.moving = True
        try:
            yield
        finally:
            self.moving = False
        self.moved.emit()

    def _scene_point(self, at: QPointF) -> QPointF:
        inverse, _ = self._view.viewportTransform().inverted()
        return inverse.map(at)


def fit_zoom(
    extent: QRectF, marks: tuple[float, float], room: tuple[float, float], most: float = 1.0
) -> float:
    """The zoom at which a picture fills a room.

    ``extent`` is in scene units. ``marks`` is what the signs around it need in addition and
    ``room`` is the free size, both (width, height) in pixels. ``most`` is the largest zoom.
    """
    width = max(extent.width(), 1.0)
    height = max(extent.height(), 1.0)
    free_w, free_h = max(room[0] - marks[0], 40.0), max(room[1] - marks[1], 40.0)
    return min(max(min(free_w / width, free_h / height), LEAST), most)
