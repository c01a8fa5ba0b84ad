"""Stage: the scene of a canvas. It shows an SB from a sheet and repaints what changed.

It knows no gestures and no floating widgets; ``Canvas`` adds these.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import ceil, floor

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QFrame, QGraphicsScene, QGraphicsView, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.levels import Level
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.canvas.camera import Camera
from smsl_studio.studio.base.canvas.changed_area import LastPainting
from smsl_studio.studio.base.canvas.found_layer import FoundLayer
from smsl_studio.studio.base.canvas.gesture_layer import GestureLayer
from smsl_studio.studio.base.canvas.glide import Glide
from smsl_studio.studio.base.canvas.ground import Ground
from smsl_studio.studio.base.canvas.lit_labels import LitLabel
from smsl_studio.studio.base.canvas.lit_layer import LitLayer
from smsl_studio.studio.base.canvas.node_item import NodePool
from smsl_studio.studio.base.canvas.sheet import POOL, Position, Sheet
from smsl_studio.studio.base.paint.ink import Ink
from smsl_studio.studio.base.theme import Tokens

STEP = 400.0
"""The scene grows and shrinks in such steps (pixels), because Qt paints all of it again then."""


class Stage(QGraphicsView):
    """A view with a cached background, two layers, and a pool of node items, for one sheet."""

    picture_changed = Signal()
    """States moved or changed their look."""
    view_moved = Signal()
    """The visible part of the scene has changed."""
    zoom_changed = Signal(float)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._ink = Ink(tokens)
        self._marks = Marks()
        self._sheet: Sheet | None = None
        self._painting = LastPainting()
        self._ready = self._scrolled = False
        self.settled = False
        """Whether the view has its size, without which the zoom of a picture is not known."""
        self.camera = Camera(self)
        self.pool = NodePool()
        self.glide = Glide(self.pool, self._glided, self)
        scene = QGraphicsScene(self)
        self.tools_high = 0
        """The height (pixels) at the top where tools lie, so that no lit name goes there."""
        self.lit_layer = LitLayer(20.0)
        self.ground = Ground(self.lit_layer)
        self.drawn = self.ground.drawn
        self.gestures = GestureLayer(self)
        self.found_layer = FoundLayer(self.lit_layer)
        for layer in (self.lit_layer, self.found_layer, self.gestures):
            scene.addItem(layer)
        self.setScene(scene)
        self._set_up()
        self._ready = True

    def _set_up(self) -> None:
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setViewportUpdateMode(QGraphicsView.ViewportUpdateMode.MinimalViewportUpdate)
        # Qt keeps a picture of the background and scrolls it. It repaints only invalidated parts.
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheBackground)
        self.setTransformationAnchor(QGraphicsView.ViewportAnchor.NoAnchor)
        self.setResizeAnchor(QGraphicsView.ViewportAnchor.NoAnchor)
        self.setOptimizationFlag(QGraphicsView.OptimizationFlag.DontSavePainterState)
        self.camera.zoom_changed.connect(self._zoomed)
        self.camera.rested.connect(self._rested)
        self.camera.moved.connect(self._moved)

    # What is shown

    @property
    def sheet(self) -> Sheet | None:
        """The sheet that is shown; None for none."""
        return self._sheet

    def show_sheet(self, sheet: Sheet | None) -> None:
        """Show another sheet in the same view. Only what looks different is painted."""
        self.glide.end()
        known = self._painting.parts(self._sheet, self._sides) if self.settled else None
        labels = self.lit_layer.shown()
        if sheet is not None:
            sheet.set_zoom(self.camera.zoom)
        changed = self._painting.change(known, sheet, self._sides)
        self.pool.keep(sheet, changed.kept)
        self._sheet = self.lit_layer.sheet = sheet
        self.gestures.clear()
        self.cover()
        self.refresh_pool()
        self._repaint(changed.rect)
        self.update_lit(labels)

    @property
    def ink(self) -> Ink:
        """The fonts and colours for painting."""
        return self._ink

    @property
    def tokens(self) -> Tokens:
        """The colours of the present theme."""
        return self._ink.tokens

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._ink = self.gestures.ink = Ink(tokens)
        if self._sheet is not None:
            self._sheet.ink = self._ink
        self.setBackgroundBrush(tokens.canvas)
        self._repaint()
        self.viewport().update()

    @property
    def marks(self) -> Marks:
        """The marks on states and operations."""
        return self._marks

    def set_marks(self, marks: Marks) -> None:
        """Show other marks; only what looks different now is painted again."""
        if marks.found or self._marks.found:
            self.found_layer.update()
        self._marks = marks
        sheet = self._sheet
        if sheet is None:
            return
        labels = self.lit_layer.shown()
        states, edges = sheet.change_marks(marks)
        self.refresh_pool()
        if len(states) > POOL or len(edges) > POOL:
            self.pool.refresh(sheet)
            self._repaint()
        else:
            for state in states:
                self.update_node(state)
            self.update_edges(edges)
            self.update_lit(labels)
        if self.settled:
            self._painting.renew(sheet, self._sides)
        self.picture_changed.emit()

    @property
    def zoom(self) -> float:
        """The zoom; 1.0 is 100 %."""
        return self.camera.zoom

    @property
    def seen(self) -> QRectF:
        """The visible part of the scene."""
        return self.mapToScene(self.viewport().rect()).boundingRect()

    @property
    def _sides(self) -> Rect:
        """The left, top, right and bottom of the visible part of the scene."""
        seen = self.seen
        return seen.left(), seen.top(), seen.right(), seen.bottom()

    # Where things are

    def rect_of(self, address: Address) -> QRectF | None:
        """The rectangle of a state's node or an operation's label (scene units).

        None for neither.
        """
        sheet = self._sheet
        if sheet is None:
            return None
        edge = sheet.picture.edge(address)
        if edge >= 0:
            left, top, right, bottom = sheet.geometry.label(edge) or sheet.geometry.fallback(edge)
            return QRectF(left, top, right - left, bottom - top)
        state = sheet.picture.node(address)
        if state < 0:
            return None
        x, y = sheet.at[state]
        w, h = sheet.halves(state)
        return QRectF(x - w, y - h, 2 * w, 2 * h)

    def address_at(self, at: QPointF) -> Address | None:
        """The element at a scene point: a state before an operation; None for none or a bundle."""
        sheet = self._sheet
        if sheet is None:
            return None
        state = sheet.state_at(at.x(), at.y())
        if state >= 0:
            return sheet.address_of_state(state)
        edge = sheet.operation_at(at.x(), at.y())
        return sheet.picture.address(edge) if edge >= 0 else None

    # Painting again

    def _dirty(self, states: list[int], edges: list[int] | None = None) -> QRectF:
        """The part of the scene that these states and edges cover.

        All in view if there are many.
        """
        sheet = self._sheet
        assert sheet is not None
        if len(states) > POOL or sheet.level < Level.COMPACT:
            return self.seen
        rect = QRectF()
        geometry = sheet.geometry
        half = sheet.halves()
        pad = 34.0 * sheet.unit
        if edges is None:
            edges = [e for s in states for e in sheet.picture.edges_of(s)]
        for state in states:
            (x, y), (w, h) = sheet.at[state], half[state]
            rect = rect.united(QRectF(x - w, y - h, 2 * w, 2 * h))
        for edge in edges:
            left, top, right, bottom = geometry.shape(edge).bounds
            rect = rect.united(QRectF(left, top, right - left, bottom - top))
            place = geometry.label(edge) or geometry.fallback(edge)
            rect = rect.united(QRectF(place[0], place[1], place[2] - place[0], place[3] - place[1]))
        return rect.adjusted(-pad, -pad, pad, pad)

    def update_edges(self, edges: Iterable[int]) -> None:
        """Repaint these edges."""
        numbers = list(edges)
        if numbers and self._sheet is not None:
            self._repaint(self._dirty([], numbers))

    def update_lit(self, before: Mapping[int, LitLabel]) -> None:
        """Repaint the labels of highlighted edges that differ from ``before``."""
        sheet = self._sheet
        if sheet is None:
            return
        after = self.lit_layer.shown()
        if sheet.looks.marks.found and before != after:
            self.found_layer.update()
        for edge in before.keys() | after.keys():
            old, new = before.get(edge), after.get(edge)
            if old == new:
                continue
            for label in (old, new):
                if label is not None:
                    left, top, right, bottom = label.rect
                    rect = QRectF(left, top, right - left, bottom - top)
                    # The label of a change hides names below it. They appear again when it moves.
                    pad = (160.0 if sheet.looks.marks.changes else 4.0) * sheet.unit
                    self._repaint(rect.adjusted(-pad, -pad, pad, pad))

    def update_node(self, state: int) -> None:
        """Repaint this node."""
        item = self.pool.used.get(state)
        if item is not None and self._sheet is not None:
            item.show_state(self._sheet, state)

    # Inside

    def cover(self) -> None:
        """Make scene and layers much larger than the drawing, so that the user can pan freely."""
        rect = QRectF(-600.0, -400.0, 1200.0, 800.0)
        if self._sheet is not None and len(self._sheet.at):
            low, high = self._sheet.extent()
            rect = rect.united(QRectF(QPointF(*low), QPointF(*high)))
            rect = rect.united(self._sheet.drawn.extent())
        zoom = self.zoom
        wide = max(self.viewport().width(), 400) / zoom + 300.0
        high_ = max(self.viewport().height(), 300) / zoom + 300.0
        rect = _on_steps(rect.adjusted(-wide, -high_, wide, high_), STEP / zoom)
        for layer in (self.lit_layer, self.found_layer, self.gestures):
            layer.cover(rect)
        if rect != self.sceneRect():
            self.scene().setSceneRect(rect)
            self.setSceneRect(rect)

    def _zoomed(self, zoom: float) -> None:
        sheet = self._sheet
        self.cover()
        if sheet is not None:
            sheet.set_zoom(zoom, self.camera.turning)
            if self.camera.moving:
                self._scrolled = True
            else:
                self.refresh_pool()
            self.pool.refresh(sheet)
            self.glide.hold()
        self._repaint()
        self.zoom_changed.emit(zoom)

    def _rested(self) -> None:
        """Give all marks the sizes of the zoom, now that it is at rest."""
        self._zoomed(self.zoom)
        self.picture_changed.emit()

    def refresh_pool(self) -> None:
        """Give items to near and highlighted nodes, and free those that left the view.

        It does nothing while the sheet has another zoom than the view: during a zoom the view
        scrolls first, and all states would count as near. ``_zoomed`` calls it again right after.
        """
        sheet = self._sheet
        if sheet is None or sheet.zoom != self.zoom:
            return
        states: list[int] = []
        view = self.seen
        labels = self.lit_layer.shown() if self._marks.running is not None else {}
        top = view.top() + self.tools_high / self.zoom
        self.lit_layer.view = view.left(), top, view.right(), view.bottom()
        self.update_lit(labels)
        pad = 40.0 * sheet.unit
        view.adjust(-pad, -pad, pad, pad)
        seen = sheet.states_in(view.left(), view.top(), view.right(), view.bottom())
        whole = sheet.level is Level.FULL
        whole = whole or (sheet.level is Level.COMPACT and len(seen) <= POOL)
        if whole:
            states = seen
        lit = sheet.looks.lit_states
        if len(lit) <= 2 * POOL:
            states = list(dict.fromkeys([*states, *lit]))
        for item in self.pool.show(sheet, states):
            self.scene().addItem(item)
        self.glide.hold()
        self._look_at(self.seen, frozenset() if whole else frozenset(self.pool.used), whole)

    def _look_at(self, view: QRectF, near: frozenset[int], whole: bool) -> None:
        """Repaint the background where it depends on what is in view."""
        sheet = self._sheet
        assert sheet is not None
        sides = view.left(), view.top(), view.right(), view.bottom()
        before = self.ground.far_nodes.near
        if self.ground.look_at(sheet, sides, near, whole) or len(before ^ near) > POOL:
            self._repaint()
        else:
            half, pad = sheet.halves(), 4.0 * sheet.unit
            for state in before ^ near:
                if state < len(sheet.at):
                    (x, y), (w, h) = sheet.at[state], half[state] + pad
                    self._repaint(QRectF(x - w, y - h, 2 * w, 2 * h))

    def _repaint(self, rect: QRectF | None = None) -> None:
        """Repaint a part of the scene or all of it, including the cached background."""
        if rect is not None:
            # Qt would have all of a rectangle painted, also what is far outside the view.
            shown = rect.intersected(self.seen)
            if not shown.isEmpty():
                self.scene().invalidate(shown)
            return
        # ``QGraphicsScene.invalidate`` without a rectangle leaves the cached background as it is.
        self.resetCachedContent()
        self.viewport().update()

    def drawBackground(self, painter: QPainter, rect: QRectF | object) -> None:
        """Paint everything that has no highlight."""
        area = QRectF(rect)  # type: ignore[arg-type]
        shown = self._sheet if not self.glide.running else None
        self.ground.paint(painter, area, self._ink.tokens, self.zoom, shown)
        self.glide.paint_lines(painter)

    def glide_from(self, before: Mapping[str, Position]) -> None:
        """Let the states move from other places (scene points) to where they stand, unless the
        person wants no movement."""
        if self._sheet is not None and self.camera.motion and self.isVisible():
            self.glide.begin(self._sheet, before)

    def _glided(self) -> None:
        """Paint a movement of the states, or what is there after it."""
        self.lit_layer.setVisible(not self.glide.running)
        if not self.glide.running and self._sheet is not None:
            self.pool.refresh(self._sheet)
        self._repaint()

    def scrollContentsBy(self, dx: int, dy: int) -> None:
        """Scroll, give items to the nodes that came into view, and emit ``view_moved``."""
        super().scrollContentsBy(dx, dy)
        if not self.devicePixelRatioF().is_integer():
            # At a scale such as 1.5 Qt scrolls by whole pixels, so strips of the old view would
            # stay on the screen.
            self._repaint()
        self._scrolled = True
        if self._ready and not self.camera.moving:
            self._moved()

    def _moved(self) -> None:
        """Show what came into view, if the view scrolled or zoomed."""
        if self._scrolled:
            self._scrolled = False
            self.refresh_pool()
            self.view_moved.emit()


def _on_steps(rect: QRectF, step: float) -> QRectF:
    """The smallest rectangle around another one whose sides are multiples of a step."""
    left, top = floor(rect.left() / step) * step, floor(rect.top() / step) * step
    right, bottom = ceil(rect.right() / step) * step, ceil(rect.bottom() / step) * step
    return QRectF(left, top, right - left, bottom - top)
