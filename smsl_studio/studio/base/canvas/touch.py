"""Touchpad and pen on a canvas: what a wheel event or a gesture of the system asks for.

A mouse wheel turns in notches and zooms. A touchpad tells a way in pixels, or a phase of the
fingers, and two fingers pan. Two fingers that spread zoom, about the place between them.
"""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QInputDevice, QNativeGestureEvent, QWheelEvent

from smsl_studio.studio.base.canvas.camera import STEP, Camera

NOTCH = 120.0
"""The angle of one notch of a wheel, in eighths of a degree."""
WAY = 0.6
"""How far one eighth of a degree pans (pixels)."""
LEAST_FACTOR, MOST_FACTOR = 0.2, 5.0
"""The limits of one step of a pinch, so that a wild event does not throw the drawing away."""

ENDS = (Qt.NativeGestureType.BeginNativeGesture, Qt.NativeGestureType.EndNativeGesture)
"""A pinch begins or ends."""


def turn(camera: Camera, event: QWheelEvent) -> None:
    """Zoom or pan by a wheel event.

    Two fingers pan; with Ctrl they zoom. A wheel zooms; with Ctrl it pans up and down, with Shift
    sideways.
    """
    modifiers, angle, pixels = event.modifiers(), event.angleDelta(), event.pixelDelta()
    control = bool(modifiers & Qt.KeyboardModifier.ControlModifier)
    if is_fingers(event):
        way = QPointF(pixels) if not pixels.isNull() else QPointF(angle) * WAY
        if control:
            camera.zoom_at(STEP ** (way.y() / (NOTCH * WAY)), event.position())
        else:
            camera.pan(way.x(), way.y())
        return
    delta = angle.y() or angle.x()
    if modifiers & Qt.KeyboardModifier.ShiftModifier:
        camera.pan(delta * WAY, 0.0)
    elif control:
        camera.pan(0.0, delta * WAY)
    else:
        camera.zoom_at(STEP ** (delta / NOTCH), event.position())


def is_fingers(event: QWheelEvent) -> bool:
    """Whether a wheel event comes from fingers on a touchpad.

    X11 calls many touchpads a mouse; then the way in pixels or the phase tells it.
    """
    if event.device().type() == QInputDevice.DeviceType.TouchPad:
        return True
    return not event.pixelDelta().isNull() or event.phase() != Qt.ScrollPhase.NoScrollPhase


class Pinch:
    """Two fingers that spread or close. The scene point between them stays between them."""

    def __init__(self, camera: Camera) -> None:
        self._camera = camera
        self._anchor: QPointF | None = None
        self._seen = (QPointF(), 1.0)

    def take(self, event: QNativeGestureEvent) -> bool:
        """Zoom or pan by a gesture of the system; False if the event is none that is used here."""
        kind, camera = event.gestureType(), self._camera
        if kind is Qt.NativeGestureType.ZoomNativeGesture:
            # The drawing may have been moved otherwise since the last step.
            same = self._seen == (camera.centre, camera.zoom)
            factor = min(max(1.0 + event.value(), LEAST_FACTOR), MOST_FACTOR)
            anchor = self._anchor if same else None
            self._anchor = camera.zoom_at(factor, event.position(), anchor)
            self._seen = camera.centre, camera.zoom
        elif kind is Qt.NativeGestureType.PanNativeGesture:
            camera.pan(event.delta().x(), event.delta().y())
        elif kind in ENDS:
            self._anchor = None
        else:
            return False
        return True
