"""Touchpad and pen on a canvas: what a wheel event or a gesture of the system asks for.

A mouse wheel turns in notches, and zooms or scrolls, as the person has chosen. A touchpad tells a
way in pixels, or a phase of the fingers, and two fingers pan. Two fingers that spread zoom, about
the place between them.
"""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QInputDevice, QNativeGestureEvent, QWheelEvent

from smsl_studio.studio.base.canvas.camera import STEP, Camera
from smsl_studio.studio.base.wheel_habit import wheel_scrolls

CONTROL, SHIFT, ALT = (
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
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

    With Ctrl it always zooms. Two fingers pan. A wheel zooms or scrolls; with Shift it pans
    sideways, with Alt up and down.
    """
    modifiers, angle, pixels = event.modifiers(), event.angleDelta(), event.pixelDelta()
    control, shift, alt = (bool(modifiers & one) for one in (CONTROL, SHIFT, ALT))
    if is_fingers(event):
        way = QPointF(pixels) if not pixels.isNull() else QPointF(angle) * WAY
        if control:
            camera.zoom_at(STEP ** (way.y() / (NOTCH * WAY)), event.position())
        else:
            camera.pan(way.x(), way.y())
        return
    delta = angle.y() or angle.x()
    if control:
        camera.zoom_at(STEP ** (delta / NOTCH), event.position())
    elif shift:
        camera.pan(delta * WAY, 0.0)
    elif alt:
        # Qt turns a wheel with Alt sideways.
        camera.pan(0.0, delta * WAY)
    elif wheel_scrolls():
        camera.pan(angle.x() * WAY, angle.y() * WAY)
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
