"""The picture of the world, drawn from poses, with an orbit camera under the mouse.

A drag turns, Shift-drag or the middle button pans, the wheel zooms, a double click returns to the
chosen view. Without OpenGL the pane says so, and the run goes on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from time import perf_counter

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt, QTimer, Signal
from PySide6.QtGui import (
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.scene.camera import (
    VIEWS,
    WHOLE,
    Corner,
    WorldCamera,
    box_of,
    own_corners,
)
from smsl_studio.studio.running.scene.ghost import GhostPlace
from smsl_studio.studio.running.scene.ghost_paint import paint_ghost_words
from smsl_studio.studio.running.scene.plates import (
    EDGE,
    PLATE,
    paint_names,
    paint_plate,
    paint_sky,
    plates,
)
from smsl_studio.studio.running.scene.renderer import (
    GhostPoses,
    Renderer,
    RenderStyle,
    open_renderer,
)
from smsl_studio.studio.running.scene.things_seen import Seen, thing_at, things_seen
from smsl_studio.world.protocol import Shape

LIMIT = 0.025
"""If a smooth picture takes longer than this (wall seconds), moving pictures are rough."""
REST = 160
"""Milliseconds without a move before a rough picture is drawn smooth."""


class WorldView(QWidget):
    """Shows shapes at poses. ``show_poses`` costs little if nothing moved."""

    thing_chosen = Signal(str)
    """str: the person clicked on the thing with this name; empty for a click beside all."""
    drawn = Signal()
    """A new picture was drawn."""
    came_into_view = Signal()
    """The view is visible now; its poses may be old."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._named = next(iter(VIEWS))
        self._camera = self._home = VIEWS[self._named]
        self._renderer: Renderer | str | None = None
        self._shapes: tuple[Shape, ...] = ()
        self._corners: list[Corner | None] = []
        """The box around each thing with a label, in its own frame (m)."""
        self._poses: tuple[float, ...] = ()
        self._status: tuple[str, ...] = ()
        self._ghost: GhostPlace | None = None
        self._sentence = "Starts with the run"
        self._image: QImage | None = None
        self._drag: QPointF | None = None
        self._pressed = QPointF()
        self._offered, self._chosen = frozenset[str](), frozenset[str]()
        self._frames: list[float] = []
        self._fine = self._quick = True
        self.follows = False
        """Whether the camera goes with the tool: the last thing without a label."""
        self.foot = 0
        """How much of the picture lies under something at the bottom (pixels)."""
        self.patient = False
        """Draw every picture smooth, however long it takes."""
        self._took = 0.0
        self._rest = QTimer(self, singleShot=True, interval=REST)
        self._rest.timeout.connect(self._refine)
        self.setMinimumSize(240, 160)
        self.setAccessibleName("World")
        self.setToolTip("Drag turns, Shift-drag pans, the wheel zooms, a double click comes back")

    @property
    def has_picture(self) -> bool:
        """Whether there are shapes and a renderer."""
        return bool(self._shapes) and isinstance(self._renderer, Renderer)

    @property
    def sentence(self) -> str:
        """The text that is shown instead of a picture; empty if there is a picture."""
        return "" if self.has_picture and self._poses else self._sentence

    def load(self, shapes: Sequence[Shape], world: str) -> None:
        """Show another world. Without shapes a sentence says that there is nothing to draw."""
        self._shapes, self._poses, self._image = tuple(shapes), (), None
        self._ghost = None
        self._know_corners()
        if not shapes:
            self._sentence = (
                f"The {world} world has nothing to draw. The facts beside tell its state"
            )
        else:
            self._renderer = self._renderer or open_renderer()
            if isinstance(self._renderer, Renderer):
                self._renderer.load(self._shapes)
            else:
                self._sentence = "No graphics here. The run goes on"
                self.setToolTip(tip_text(f"OpenGL is not available: {self._renderer}"))
        self.update()

    def offer_things(self, names: frozenset[str]) -> None:
        """Let a click choose the things with these names."""
        if names != self._offered:
            self._offered = names
            self._know_corners()

    def show_chosen(self, names: frozenset[str]) -> None:
        """Frame the things with these names."""
        if names != self._chosen:
            self._chosen = names
            self.update()

    def _know_corners(self) -> None:
        names = self._offered
        self._corners = [
            own_corners(s) if s.label or s.name in names else None for s in self._shapes
        ]

    def clear(self) -> None:
        """Show that there is no run."""
        self.load((), "")
        self._sentence = "Starts with the run"
        self._status = ()

    def show_poses(
        self, poses: tuple[float, ...], status: Mapping[str, str], last: bool = False
    ) -> None:
        """Draw these poses if they changed; ``status`` has the world's words for people.

        While pictures take long, poses are left out. The ``last`` ones of a run never are.
        """
        words = tuple(f"{key.capitalize()} {value}".strip() for key, value in status.items())
        if words != self._status:
            self._status = words
            self.update()
        early = self._frames and perf_counter() - self._frames[-1] < 2 * self._took
        if poses != self._poses and (last or not early):
            first = not self._poses
            self._poses = poses
            if first:
                self.set_view(self._named)
            if self.follows:
                self._camera = self._camera.at(self._followed())
            self._moving()

    def show_ghost(self, place: GhostPlace | None) -> None:
        """Show where a forecast moves things; None shows none. It is left out if it is of another
        world."""
        if place is not None and len(place.poses) != 7 * len(self._shapes):
            place = None
        if place != self._ghost:
            self._ghost = place
            if self._poses:
                self._moving()

    def follow(self, wanted: bool) -> None:
        """Let the camera go with the tool, or stay where it is."""
        self.follows = wanted
        if wanted and self._poses:
            self._look(self._camera.at(self._followed()))

    def _followed(self) -> tuple[float, float, float]:
        """Return where the tool is (m)."""
        at = 7 * self._tool
        x, y, z = self._poses[at : at + 3]
        return x, y, z

    @property
    def _tool(self) -> int:
        """The number of the shape that is the tool."""
        plain = [n for n, shape in enumerate(self._shapes) if not shape.label]
        return plain[-1] if plain else len(self._shapes) - 1

    def picture(self, poses: tuple[float, ...] = ()) -> QImage:
        """Return what is shown, with the names of things, as an opaque image of the view's size.

        ``poses`` take the place of the present ones. The image is empty if there is no picture, or
        if they are poses of another world.
        """
        shown = poses or self._poses
        if not self.has_picture or not shown or len(shown) != 7 * len(self._shapes):
            return QImage()
        assert isinstance(self._renderer, Renderer)
        camera, ratio = self._camera, self.devicePixelRatioF()
        kept, self._poses = self._poses, shown
        if poses and self.follows:
            self._camera = camera.at(self._followed())
        size = round(self.width() * ratio), round(self.height() * ratio)
        style = RenderStyle(*size, self._tokens.dark, True)
        made = QImage(*size, QImage.Format.Format_RGB888)
        made.setDevicePixelRatio(ratio)
        painter = QPainter(made)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_sky(painter, self.rect(), self._tokens)
        painter.drawImage(self.rect(), self._renderer.draw(shown, self._camera, style))
        self._paint_labels(painter)
        painter.end()
        self._poses, self._camera = kept, camera
        return made

    def set_view(self, name: str) -> None:
        """Look from one of the named places in ``VIEWS``."""
        self._named, self._home = name, VIEWS[name]
        if self._poses:
            count = len(self._shapes)
            told = [n for n in range(count) if name == WHOLE or self._shapes[n].label]
            seen = told or list(range(count))
            poses = [part for n in seen for part in self._poses[7 * n : 7 * n + 7]]
            box = box_of([self._shapes[n] for n in seen], poses)
            high = max(self.height(), 1)
            aspect, foot = self.width() / high, min((EDGE + PLATE + 8) / high, 0.25)
            self._home = self._home.framing(box, aspect, foot) if box is not None else self._home
        self._look(self._home)

    def come_back(self) -> None:
        """Return to the named place that was chosen."""
        self._look(self._home)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens, self._image = tokens, None
        self.update()

    def close_graphics(self) -> None:
        """Release the OpenGL context."""
        if isinstance(self._renderer, Renderer):
            self._renderer.close()
        self._renderer = None

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture and its labels; without OpenGL or poses paint a sentence."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_sky(painter, self.rect(), self._tokens)
        if not self.has_picture or not self._poses:
            self._paint_sentence(painter)
            return
        image = self._image or self._render()
        painter.drawImage(self.rect(), image)
        self._paint_labels(painter)
        self._paint_chosen(painter)
        if self._ghost is not None:
            room = QSizeF(self.size())
            paint_ghost_words(painter, room, self._camera, self._ghost, self._tool, self._tokens)
        self._paint_chips(painter)

    def showEvent(self, event: QShowEvent) -> None:
        """Ask for the newest poses: while the view was hidden it was given none."""
        super().showEvent(event)
        self.came_into_view.emit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the chosen view in the new size, if the camera has not been moved."""
        super().resizeEvent(event)
        if self._camera == self._home:
            self.set_view(self._named)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to turn or pan the camera, or to choose a thing."""
        self._drag = self._pressed = event.position()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Turn the camera; pan it with Shift or the middle button."""
        if self._drag is None:
            return
        moved, self._drag = event.position() - self._drag, event.position()
        pan = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        if pan or event.buttons() & Qt.MouseButton.MiddleButton:
            scale = self._camera.distance / max(self.height(), 1)
            self._look(self._camera.panned(-moved.x() * scale, moved.y() * scale))
        else:
            self._look(self._camera.orbited(moved.x() * 0.008, moved.y() * 0.008))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End turning or panning. A click that moved nothing chooses the thing there."""
        if self._drag is not None and self._pressed == event.position() and self._poses:
            seen = [one for one in self._things_seen() if one[0].name in self._offered]
            self.thing_chosen.emit(thing_at(event.position(), seen))
        self._drag = None
        self.unsetCursor()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Return to the named place that was chosen."""
        self.come_back()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom."""
        self._look(self._camera.zoomed(0.999 ** event.angleDelta().y()))
        event.accept()

    def _look(self, camera: WorldCamera) -> None:
        self._camera = camera
        self._moving()

    def _render(self) -> QImage:
        """Draw the picture; smooth if that is fast enough or nothing moves."""
        assert isinstance(self._renderer, Renderer)
        began, ratio = perf_counter(), self.devicePixelRatioF()
        fine = self._quick or self.patient or not self._rest.isActive()
        size = round(self.width() * ratio), round(self.height() * ratio)
        ghost, accent = self._ghost, self._tokens.acc
        colour = accent.redF(), accent.greenF(), accent.blueF()
        drawn = GhostPoses(ghost.poses, colour, ghost.alone) if ghost is not None else None
        image = self._renderer.draw(
            self._poses, self._camera, RenderStyle(*size, self._tokens.dark, fine, drawn)
        )
        image.setDevicePixelRatio(ratio)
        self._image, self._fine = image, fine
        if fine:
            self._quick = perf_counter() - began <= LIMIT
        self._took = perf_counter() - began
        self._frames = [*self._frames[-29:], perf_counter()]
        self.drawn.emit()
        return image

    def _moving(self) -> None:
        """Mark the picture as outdated. It may be rough until nothing moves."""
        self._image = None
        self._rest.start()
        self.update()

    def _refine(self) -> None:
        if not self._fine:
            self._image = None
            self.update()

    def _paint_sentence(self, painter: QPainter) -> None:
        painter.setFont(text_font(13))
        painter.setPen(self._tokens.tx3)
        room = self.rect().adjusted(24, 24, -24, -24)
        flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
        painter.drawText(room, flags, plain_text(self._sentence))

    def _paint_labels(self, painter: QPainter) -> None:
        room = QRectF(self.rect()).adjusted(0, 0, 0, -(EDGE + PLATE + 4))
        things = [(shape.label, seen) for shape, seen in self._things_seen() if shape.label]
        paint_names(painter, things, room, self._tokens)

    def _things_seen(self) -> Iterator[Seen]:
        """Yield the things that have a label or can be chosen, each with what it covers."""
        size = QSizeF(self.size())
        return things_seen(self._shapes, self._corners, self._poses, self._camera, size)

    def _paint_chosen(self, painter: QPainter) -> None:
        """Paint a frame around each chosen thing."""
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self._tokens.acc, 2.0))
        for seen in (seen for shape, seen in self._things_seen() if shape.name in self._chosen):
            painter.drawRoundedRect(seen.adjusted(-5, -5, 5, 5), 6, 6)

    def _paint_chips(self, painter: QPainter) -> None:
        painter.setFont(text_font(12))
        bottom, t = self.height() - EDGE - self.foot, self._tokens
        inks = [t.tx2] * len(self._status)
        told = [*self._status]
        if not self.patient and len(self._frames) > 2 and perf_counter() - self._frames[-1] < 1:
            rate = (len(self._frames) - 1) / max(self._frames[-1] - self._frames[0], 1e-3)
            if rate >= 1.5:
                told.append(f"{rate:.0f} frames/s")
                inks.append(t.tx3)
        # One that has no room is left out, so that none lies under the bar of a forecast.
        for words, box, ink in zip(told, plates(told), inks, strict=True):
            if box.right() <= self.width() - EDGE:
                paint_plate(painter, box.translated(0, bottom - PLATE), words, ink, t)

    @property
    def reach(self) -> float:
        """How far the words of the world reach from the left, with the rate (pixels)."""
        return plates([*self._status, "60 frames/s"])[-1].right()
