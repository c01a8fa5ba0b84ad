"""Canvas: the view of one SB. It draws and gestures; it never edits a blueprint itself.

What somebody wants is told by signals (``CanvasEditor`` turns them into edits of a session); what
is shown is set by ``show_branch`` and ``set_marks``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QPointF, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import (
    QAccessible,
    QAccessibleEvent,
    QContextMenuEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QFrame, QGraphicsScene, QGraphicsView, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.studio.canvas import batch
from smsl_studio.studio.canvas.camera import STEP, Camera, fit_zoom
from smsl_studio.studio.canvas.gesture_layer import Drawn, GestureLayer
from smsl_studio.studio.canvas.ink import Ink
from smsl_studio.studio.canvas.layers import EdgeLayer, FarNodeLayer, LitLayer
from smsl_studio.studio.canvas.levels import Level
from smsl_studio.studio.canvas.lit_labels import LitLabel
from smsl_studio.studio.canvas.marks import Marks
from smsl_studio.studio.canvas.node_item import NodePool
from smsl_studio.studio.canvas.overlays import Overlays
from smsl_studio.studio.canvas.picture import Picture
from smsl_studio.studio.canvas.sheet import Position, Sheet
from smsl_studio.studio.canvas.tools import Hand
from smsl_studio.studio.theme import Tokens

POOL = 320
"""So many near nodes are items of their own; more are painted by a layer."""
DOT_STEP, DOT = 16.0, 1.5


class Canvas(QGraphicsView):
    """The picture of one SB, with zoom, pan, selection and the gestures that edit.

    ``editing`` is False in Run mode: nothing moves, and a click on an operation asks for it
    (``edge_clicked``). Positions in signals are scene points.
    """

    selection_wanted = Signal(object)
    """tuple[Address]: what shall be selected."""
    add_state_wanted = Signal(QPointF)
    """A state is wanted at this point (double click on empty canvas)."""
    connect_wanted = Signal(object, object, QPointF)
    """(source, target or None, point): an operation is wanted; without target, a state too."""
    retarget_wanted = Signal(object, object)
    """(operation, new target state): the arrowhead was dragged there."""
    rename_wanted = Signal(object)
    """Address whose name shall be edited in place."""
    moved = Signal(object)
    """dict[str, (x, y)]: states that were dragged and let go."""
    enter_wanted = Signal(str)
    """A sub-SB shall be shown."""
    leave_wanted = Signal()
    """The base SB shall be shown."""
    edge_clicked = Signal(object)
    """Address of an operation that was clicked while not editing."""
    node_clicked = Signal(object)
    """Address of a state that was clicked while not editing."""
    context_wanted = Signal(object, object)
    """(Address or None, global point): a context menu is wanted."""
    quick_add_wanted = Signal()
    """Tab or /: an operation shall be added from the selected state."""
    delete_wanted = Signal()
    """Del: the selection shall go."""
    hover_changed = Signal(object)
    """Address under the pointer, or None."""
    zoom_changed = Signal(float)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._ink = Ink(tokens)
        self._marks = Marks()
        self._sheet: Sheet | None = None
        self._ready = False
        self.editing = True
        self.why_not: Callable[[Address, Address], str] = lambda source, target: ""
        """Why an operation from a state to another is impossible; the empty text if it is not."""
        self.camera = Camera(self)
        self.pool = NodePool()
        self._build_scene()
        self.overlays = Overlays(self, tokens)
        self.hand = Hand(self)
        self._set_up_view()
        self.set_tokens(tokens)
        self._ready = True

    def _build_scene(self) -> None:
        scene = QGraphicsScene(self)
        scene.setItemIndexMethod(QGraphicsScene.ItemIndexMethod.BspTreeIndex)
        self._layers = EdgeLayer(0.0), FarNodeLayer(5.0), LitLayer(20.0)
        self.edge_layer, self.far_layer, self.lit_layer = self._layers
        self.gestures = GestureLayer(self)
        for layer in (*self._layers, self.gestures):
            scene.addItem(layer)
        self.setScene(scene)

    def _set_up_view(self) -> None:
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setViewportUpdateMode(QGraphicsView.ViewportUpdateMode.MinimalViewportUpdate)
        self.setTransformationAnchor(QGraphicsView.ViewportAnchor.NoAnchor)
        self.setResizeAnchor(QGraphicsView.ViewportAnchor.NoAnchor)
        self.setOptimizationFlag(QGraphicsView.OptimizationFlag.DontSavePainterState)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setAccessibleName("Canvas")
        self.camera.zoom_changed.connect(self._zoomed)
        self.camera.arrived.connect(self.overlays.fitted)
        self._later = QTimer(self)
        self._later.setSingleShot(True)
        self._later.setInterval(0)
        self._later.timeout.connect(self._refresh_pool)

    # What is shown

    def show_branch(
        self,
        blueprint: Blueprint,
        branch: str,
        positions: Mapping[str, Position] | None = None,
        keep_view: bool = False,
    ) -> None:
        """Show an SB. Without positions they are those of its layout; the view fits it.

        ``keep_view`` leaves zoom and place alone: the same SB after an edit.
        """
        self.hand.reset()
        self.pool.clear()
        if branch not in blueprint.branches:
            self._sheet = None
        else:
            picture = Picture(blueprint, branch)
            if positions is None:
                positions = place_states(picture.branch)
            self._sheet = Sheet(picture, positions, self._ink, self._marks)
            self._sheet.set_zoom(self.camera.zoom)
        for layer in self._layers:
            layer.sheet = self._sheet
        self.gestures.clear()
        self._cover()
        if not keep_view:
            self.fit(smooth=False)
        self._refresh_pool()
        self.overlays.show_branch(blueprint, branch)
        self.scene().update()
        self._describe()

    def show_places(
        self, blueprint: Blueprint, branch: str, positions: Mapping[str, Position]
    ) -> None:
        """Show the same states and operations at other places, after a move or its undo."""
        if self._sheet is None or branch != self._sheet.picture.branch.name:
            self.show_branch(blueprint, branch, positions, keep_view=True)
            return
        self._sheet.picture.blueprint = blueprint
        self._sheet.picture.branch = blueprint[branch]
        index = self._sheet.picture.index
        self._sheet.move({index[n]: at for n, at in positions.items() if n in index})
        self.settle()
        self.hand.show_grip()

    @property
    def sheet(self) -> Sheet | None:
        """What is shown now, None for nothing."""
        return self._sheet

    @property
    def positions(self) -> dict[str, Position]:
        """Where the states stand now."""
        if self._sheet is None:
            return {}
        names = self._sheet.picture.names
        return {n: (x, y) for n, (x, y) in zip(names, self._sheet.at.tolist(), strict=True)}

    @property
    def ink(self) -> Ink:
        return self._ink

    @property
    def tokens(self) -> Tokens:
        return self._ink.tokens

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self._ink = Ink(tokens)
        if self._sheet is not None:
            self._sheet.ink = self._ink
        self.setBackgroundBrush(tokens.canvas)
        self.overlays.set_tokens(tokens)
        self.resetCachedContent()
        self.scene().update()
        self.viewport().update()

    @property
    def marks(self) -> Marks:
        return self._marks

    def set_marks(self, marks: Marks) -> None:
        """Show other marks; only what looks different now is painted again."""
        self._marks = marks
        sheet = self._sheet
        if sheet is None:
            return
        labels = self.lit_layer.shown()
        states, edges = sheet.change_marks(marks)
        self.overlays.show_marks(marks)
        if len(states) > POOL or len(edges) > POOL:
            self._refresh_pool()
            self.pool.refresh(sheet)
            self.scene().update()
            return
        self._refresh_pool()
        for state in states:
            item = self.pool.used.get(state)
            if item is not None:
                item.show_state(sheet, state)
        self.update_edges(edges)
        self.update_lit(labels)
        self.hand.show_grip()
        self.overlays.picture_changed()
        self._describe()

    def show_banner(self, text: str) -> None:
        """Say something across the top, such as "The drawing has moved on"; empty hides it."""
        self.overlays.show_banner(text)

    def show_pending(
        self, source: Address | None, target: Address | None = None, at: QPointF | None = None
    ) -> None:
        """Show an operation that is being named: dashed, to a state or to a new one at a point.

        None takes it away.
        """
        rect = self.rect_of(source) if source is not None else None
        if source is None or rect is None or at is None or source == target:
            self.gestures.put("drawn", None)
            return
        goal = self.rect_of(target) if target is not None else None
        start, end = self.hand.pending_ends(source, at, goal)
        self.gestures.put("drawn", Drawn(start, end, ghost=target is None))

    def say(self, text: str, at: QPointF | None = None) -> None:
        """Say a short sentence at the pointer, or at a scene point."""
        self.overlays.say(text, self.mapFromScene(at) if at is not None else None)

    # Where it looks

    @property
    def zoom(self) -> float:
        return self.camera.zoom

    def zoom_to(self, zoom: float) -> None:
        """Zoom about the middle: 1.0 is 100 %."""
        self.camera.fitted = False
        self.camera.go(self.camera.centre, zoom)

    def zoom_in(self) -> None:
        self.zoom_to(self.zoom * STEP)

    def zoom_out(self) -> None:
        self.zoom_to(self.zoom / STEP)

    def fit(self, smooth: bool = True) -> None:
        """Show everything, at 100 % at most."""
        sheet = self._sheet
        if sheet is None or not len(sheet.at):
            self.camera.fitted = True
            self.camera.go(QPointF(0.0, 0.0), 1.0, smooth)
            return
        top = self.overlays.top_room()
        room = float(self.viewport().width()), float(self.viewport().height() - top)
        extent, marks, zoom = self._extent(room)
        middle = extent.center() + QPointF(marks[0], marks[1]) / 2 / zoom
        self.camera.fitted = True
        self.camera.go(middle - QPointF(0.0, top / 2 / zoom), zoom, smooth)

    def _extent(self, room: tuple[float, float]) -> tuple[QRectF, tuple[float, float], float]:
        """What is to be seen, the shift by marks, and the zoom at which it fits a room."""
        sheet = self._sheet
        assert sheet is not None
        low, high = sheet.at.min(axis=0), sheet.at.max(axis=0)
        centres = QRectF(QPointF(*low), QPointF(*high))
        if sheet.roomy and len(sheet.picture) <= 250:
            whole = self._full_bounds(centres)
            zoom = fit_zoom(whole, (28.0, 20.0), room)
            if zoom >= 0.70:
                return whole, (0.0, 0.0), zoom
        widest = float(sheet.compact_widths.max())
        zoom = fit_zoom(centres, (widest + 56.0, 24.0 + 40.0), room)
        return centres, (0.0, 0.0), zoom

    def _full_bounds(self, centres: QRectF) -> QRectF:
        sheet = self._sheet
        assert sheet is not None
        zoom = sheet.zoom
        sheet.set_zoom(1.0)
        geometry = sheet.geometry
        half = sheet.halves()
        low, high = (sheet.at - half).min(axis=0), (sheet.at + half).max(axis=0)
        whole = QRectF(QPointF(*low), QPointF(*high)).adjusted(-4, -4, 4, 4)
        initial = sheet.picture.index.get(sheet.picture.branch.initial, -1)
        if initial >= 0:
            x, y = sheet.at[initial] - half[initial]
            whole = whole.united(QRectF(x - 28.0, y, 28.0, 10.0))
        for edge in range(len(sheet.picture.operations)):
            left, top, right, bottom = geometry.shape(edge).bounds
            whole = whole.united(QRectF(left, top, right - left, bottom - top))
            rect = geometry.label(edge)
            if rect is not None:
                whole = whole.united(QRectF(rect[0], rect[1], rect[2] - rect[0], rect[3] - rect[1]))
        sheet.set_zoom(zoom)
        return whole

    def reveal(self, address: Address) -> None:
        """Bring a state or operation into view, without zooming, where it is not in view yet."""
        rect = self.rect_of(address)
        if rect is None:
            return
        seen = self.mapToScene(self.viewport().rect().adjusted(40, 56, -40, -56)).boundingRect()
        if not seen.contains(rect.center()):
            self.camera.fitted = False
            self.camera.go(rect.center(), self.zoom)

    def rect_of(self, address: Address) -> QRectF | None:
        """Where a state's node, or an operation's label, lies (scene); None for neither."""
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
        w, h = sheet.halves()[state]
        return QRectF(x - w, y - h, 2 * w, 2 * h)

    def address_at(self, at: QPointF) -> Address | None:
        """What lies at a scene point: a state before an operation."""
        sheet = self._sheet
        if sheet is None:
            return None
        state = sheet.state_at(at.x(), at.y())
        if state >= 0:
            return sheet.address_of_state(state)
        edge = sheet.edge_at(at.x(), at.y())
        return sheet.picture.address(edge) if edge >= 0 else None

    # Moving without rebuilding

    def drag_states(self, places: Mapping[int, Position]) -> None:
        """Show states elsewhere while they are dragged."""
        sheet = self._sheet
        if sheet is None:
            return
        before = self._dirty(list(places))
        edges = sheet.move(places)
        for state in places:
            item = self.pool.used.get(state)
            if item is not None:
                item.show_state(sheet, state)
        self.scene().update(before.united(self._dirty(list(places), edges)))
        self.overlays.picture_changed()

    def _dirty(self, states: list[int], edges: list[int] | None = None) -> QRectF:
        """The part of the scene that states and their edges cover."""
        sheet = self._sheet
        assert sheet is not None
        if len(states) > POOL or sheet.level < Level.COMPACT:
            return self.mapToScene(self.viewport().rect()).boundingRect()
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

    def settle(self) -> None:
        """States have come to rest: route and label anew."""
        if self._sheet is not None:
            self._sheet.settle()
            self._cover()
            self._refresh_pool()
            self.pool.refresh(self._sheet)
            self.scene().update()

    def update_edges(self, edges: set[int]) -> None:
        """Paint these edges again."""
        if edges and self._sheet is not None:
            self.scene().update(self._dirty([], list(edges)))

    def update_lit(self, before: Mapping[int, LitLabel]) -> None:
        """Paint again the labels of lit edges that are not what they were."""
        sheet = self._sheet
        if sheet is None:
            return
        after = self.lit_layer.shown()
        for edge in before.keys() | after.keys():
            old, new = before.get(edge), after.get(edge)
            if old == new:
                continue
            for label in (old, new):
                if label is not None:
                    left, top, right, bottom = label.rect
                    rect = QRectF(left, top, right - left, bottom - top)
                    pad = 4.0 * sheet.unit
                    self.scene().update(rect.adjusted(-pad, -pad, pad, pad))

    def update_node(self, state: int) -> None:
        """Paint this node again."""
        item = self.pool.used.get(state)
        if item is not None and self._sheet is not None:
            item.show_state(self._sheet, state)

    # Inside

    def _cover(self) -> None:
        """Let scene and layers reach far beyond the states, so that one can pan freely."""
        rect = QRectF(-600.0, -400.0, 1200.0, 800.0)
        if self._sheet is not None and len(self._sheet.at):
            low, high = self._sheet.at.min(axis=0), self._sheet.at.max(axis=0)
            rect = rect.united(QRectF(QPointF(*low), QPointF(*high)))
        zoom = self.zoom
        wide = max(self.viewport().width(), 400) / zoom + 300.0
        high_ = max(self.viewport().height(), 300) / zoom + 300.0
        rect = rect.adjusted(-wide, -high_, wide, high_)
        for layer in (*self._layers, self.gestures):
            layer.cover(rect)
        if rect != self.sceneRect():
            self.scene().setSceneRect(rect)
            self.setSceneRect(rect)

    def _zoomed(self, zoom: float) -> None:
        sheet = self._sheet
        self._cover()
        if sheet is not None:
            sheet.set_zoom(zoom)
            self._refresh_pool()
            self.pool.refresh(sheet)
        self.scene().update()
        self.overlays.show_zoom(zoom)
        self.zoom_changed.emit(zoom)

    def _refresh_pool(self) -> None:
        """Give near nodes and lit ones an item, take it from those that left the view."""
        sheet = self._sheet
        if sheet is None:
            return
        states: list[int] = []
        view = self.mapToScene(self.viewport().rect()).boundingRect()
        labels = self.lit_layer.shown() if self._marks.running is not None else {}
        self.lit_layer.view = view.left(), view.top(), view.right(), view.bottom()
        self.update_lit(labels)
        pad = 40.0 * sheet.unit
        view.adjust(-pad, -pad, pad, pad)
        seen = sheet.states_in(view.left(), view.top(), view.right(), view.bottom())
        if sheet.level is Level.FULL or (sheet.level is Level.COMPACT and len(seen) <= POOL):
            states = seen
        lit = sheet.looks.lit_states
        if len(lit) <= 2 * POOL:
            states = list(dict.fromkeys([*states, *lit]))
        for item in self.pool.show(sheet, states):
            self.scene().addItem(item)
        near = frozenset(self.pool.used)
        if near != self.far_layer.near:
            self.far_layer.near = near
            if sheet.level is not Level.FULL:
                self.far_layer.update()

    def _describe(self) -> None:
        """Tell assistive tools what is shown and what is selected."""
        sheet = self._sheet
        if sheet is None or not len(sheet.picture):
            self.setAccessibleDescription("Empty. Double-click to add the first state.")
            return
        words = f"{sheet.picture.branch.name}, {len(sheet.picture)} states"
        chosen = [a for a in self._marks.selection if a.branch == sheet.picture.branch.name]
        if len(chosen) == 1:
            words = self.describe(chosen[0])
        elif chosen:
            words += f", {len(chosen)} selected"
        self.setAccessibleDescription(words)
        if QAccessible.isActive() and chosen:
            event = QAccessibleEvent(self, QAccessible.Event.Focus)
            event.setChild(sheet.picture.node(chosen[-1]))
            QAccessible.updateAccessibility(event)

    def describe(self, address: Address) -> str:
        """A state or operation in words: "State_1100, active, 7 operations out"."""
        from smsl_studio.studio.canvas.accessible import words_for

        return words_for(self, address)

    # Qt's events

    def drawBackground(self, painter: QPainter, rect: QRectF | object) -> None:
        """Canvas colour and a dot every 16 pixels (or the next power of two of the scene)."""
        area = QRectF(rect)  # type: ignore[arg-type]
        tokens = self._ink.tokens
        painter.fillRect(area, tokens.canvas)
        step = DOT_STEP
        while step * self.zoom < 11.0:
            step *= 2.0
        while step * self.zoom > 23.0:
            step /= 2.0
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        batch.draw_grid(painter, area, step, DOT / self.zoom, tokens.dot)

    def scrollContentsBy(self, dx: int, dy: int) -> None:
        super().scrollContentsBy(dx, dy)
        if self._ready:
            self._refresh_pool()
            self.overlays.view_moved()

    def resizeEvent(self, event: QResizeEvent) -> None:
        fitted = self.camera.fitted
        super().resizeEvent(event)
        self._cover()
        self.overlays.place()
        if fitted:
            self.fit(smooth=False)
        else:
            self._refresh_pool()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.overlays.place()
        if self.camera.fitted:
            self.fit(smooth=False)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the pointer; with Ctrl pan up and down, with Shift sideways."""
        angle = event.angleDelta()
        modifiers = event.modifiers()
        delta = angle.y() or angle.x()
        if modifiers & Qt.KeyboardModifier.ShiftModifier:
            self.camera.pan(delta * 0.6, 0.0)
        elif modifiers & Qt.KeyboardModifier.ControlModifier:
            self.camera.pan(0.0, delta * 0.6)
        else:
            self.camera.zoom_at(STEP ** (delta / 120.0), event.position())
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.hand.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self.hand.move(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self.hand.release(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self.hand.double_click(event)

    def leaveEvent(self, event: object) -> None:
        super().leaveEvent(event)  # type: ignore[arg-type]
        self.hand.left()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        at = self.mapToScene(event.pos())
        self.context_wanted.emit(self.address_at(at), event.globalPos())
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not self.hand.key_press(event):
            event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if not self.hand.key_release(event):
            event.ignore()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.hand.lost_focus()

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Tab adds an operation while a state is selected; else it goes on as everywhere."""
        if self.editing and any(a.state for a in self._marks.selection):
            return False
        return super().focusNextPrevChild(forward)
