"""Hand: turns mouse and key events into gestures, and tracks what is under the pointer."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QCursor, QKeyEvent, QMouseEvent

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.canvas import keys
from smsl_studio.studio.base.canvas.accessible import edge_tip
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.connect_tool import ConnectTool
from smsl_studio.studio.base.canvas.drawn_gestures import press_drawn
from smsl_studio.studio.base.canvas.gesture_layer import HANDLE_RADIUS
from smsl_studio.studio.base.canvas.gestures import (
    Band,
    Connect,
    DragStates,
    Gesture,
    Pan,
    Retarget,
    selection_after,
)
from smsl_studio.studio.base.canvas.handles import handles, nearest
from smsl_studio.studio.base.canvas.line_handles import LineHandles
from smsl_studio.studio.base.canvas.overlays import Overlays
from smsl_studio.studio.base.chips import fact_words
from smsl_studio.studio.base.paint.node_paint import chip_places
from smsl_studio.studio.base.tips import tip_text

REACH = 15.0
"""How far outside a node the pointer still counts as on it (pixels), so that it can reach the
handle."""
GRIP = 10.0
"""A press within this distance takes the grip (pixels)."""
CLEAR = 32.0
"""The smallest distance between the middles of a handle and the grip (pixels)."""


class Hand:
    """The gesture in progress, the hovered state or edge, and whether Space is held."""

    def __init__(self, canvas: BranchView, overlays: Overlays) -> None:
        self._canvas, self._overlays = canvas, overlays
        self._gesture: Gesture | None = None
        self._space = False
        self.line = LineHandles(canvas)

    @property
    def busy(self) -> bool:
        """Whether a gesture is in progress."""
        return self._gesture is not None

    def reset(self) -> None:
        """Drop the gesture and hide what belongs to it, because another picture is shown."""
        self._gesture = None
        self._canvas.gestures.clear()
        self._overlays.forget()
        self._cursor()

    # Mouse

    def press(self, event: QMouseEvent) -> None:
        """Take the keyboard focus, and begin the gesture that fits the button and what is below."""
        canvas = self._canvas
        left = event.button() is Qt.MouseButton.LeftButton
        if left and self._gesture is None and self._is_picked(event):
            return
        canvas.setFocus(Qt.FocusReason.MouseFocusReason)
        self._overlays.hush()
        self._overlays.pad.go()
        canvas.pressed.emit()
        if self._gesture is not None:
            self._use_tool(ConnectTool.press, event)
            return
        if event.button() is Qt.MouseButton.MiddleButton or (left and self._space):
            self._gesture = Pan(canvas, event)
        elif left and canvas.sheet is not None:
            self._gesture = self._left_press(event)
        elif event.button() is Qt.MouseButton.RightButton:
            self._select_for_menu(event)

    def _left_press(self, event: QMouseEvent) -> Gesture | None:
        canvas, sheet = self._canvas, self._canvas.sheet
        assert sheet is not None
        at = canvas.mapToScene(event.position().toPoint())
        if canvas.editing:
            if self.line.edge >= 0 and self._near(at, canvas.gestures.grip, GRIP):
                return Retarget(canvas, self, event, self.line.edge)
            on_line = self.line.press(event, at)
            if on_line is not None:
                return on_line
            handle = canvas.gestures.handle
            if handle is not None and self._near(at, handle, HANDLE_RADIUS + 1.0):
                return Connect(canvas, self, event, sheet.looks.hovered_state, handle)
        state = sheet.state_at(at.x(), at.y())
        if state >= 0:
            if not canvas.editing:
                canvas.node_clicked.emit(sheet.address_of_state(state))
            return DragStates(canvas, self, event, state)
        drawn = canvas.drawn_at(at) if canvas.editing else None
        if drawn is not None:
            return press_drawn(canvas, event, drawn)
        edge = sheet.edge_at(at.x(), at.y())
        if edge >= 0:
            address = sheet.picture.address(edge)
            chosen = selection_after(canvas.extended(), address, event.modifiers())
            canvas.selection_wanted.emit(chosen)
            if not canvas.editing:
                canvas.edge_clicked.emit(address)
            self.show_grip()
            return self.line.press_line(event, at)
        return Band(canvas, event) if canvas.editing else Pan(canvas, event)

    def _is_picked(self, event: QMouseEvent) -> bool:
        """Whether an open card takes the state below the pointer."""
        address = self._canvas.address_at(self._canvas.mapToScene(event.position().toPoint()))
        return address is not None and not address.operation and self._canvas.state_pick(address)

    def begin_connect(self, address: Address | None = None) -> None:
        """Draw an operation to the next click, from a state or first from a click; Esc cancels."""
        sheet = self._canvas.sheet
        state = sheet.picture.node(address) if sheet is not None and address is not None else -1
        if sheet is not None and (state >= 0 or address is None):
            self._drop_gesture()
            self._canvas.setFocus()
            self._gesture = ConnectTool(self._canvas, self, state)
            self._cursor()

    def _drop_gesture(self) -> bool:
        """Cancel the gesture; whether there was one."""
        gesture, self._gesture = self._gesture, None
        if gesture is not None:
            gesture.cancel()
            self._cursor()
        return gesture is not None

    def _use_tool(
        self, act: Callable[[ConnectTool, QMouseEvent], None], event: QMouseEvent
    ) -> bool:
        """Let the tool that connects act; False if it is not in use."""
        tool = self._gesture
        if not isinstance(tool, ConnectTool):
            return False
        act(tool, event)
        self._leave_tool(tool)
        return True

    def _leave_tool(self, tool: ConnectTool) -> None:
        """Forget the tool once it is done."""
        if tool.done:
            self._gesture = None
            self._cursor()
            self.look_again()

    def move(self, event: QMouseEvent) -> None:
        """Continue the gesture; without one update what is hovered."""
        if self._gesture is not None:
            self._gesture.move(event)
        else:
            self._hover(event.position())

    def release(self, event: QMouseEvent) -> None:
        """End the gesture, if there is one. The tool that connects goes on to its next click."""
        if self._use_tool(ConnectTool.release, event):
            return
        gesture, self._gesture = self._gesture, None
        if gesture is not None:
            gesture.release(event)
            self._cursor()
            self._hover(event.position())

    def double_click(self, event: QMouseEvent) -> None:
        """Enter a sub-SB, or rename what is below; on empty canvas ask for a new state."""
        canvas, sheet = self._canvas, self._canvas.sheet
        if self._use_tool(ConnectTool.press, event):
            return
        if event.button() is not Qt.MouseButton.LeftButton:
            return
        self._gesture = None
        at = canvas.mapToScene(event.position().toPoint())
        if sheet is None:
            if canvas.editing:
                canvas.add_state_wanted.emit(at)
            return
        if self.line.double_click(at):
            return
        state = sheet.state_at(at.x(), at.y())
        if state >= 0:
            sub = self.sub_at(state, at)
            if sub:
                canvas.enter_wanted.emit(sub)
            elif canvas.editing:
                canvas.rename_wanted.emit(sheet.address_of_state(state))
            return
        edge = sheet.edge_at(at.x(), at.y())
        if not canvas.editing:
            return
        drawn = canvas.drawn_at(at)
        if drawn is not None:
            canvas.drawn_edit_wanted.emit(drawn)
        elif edge >= 0:
            canvas.rename_wanted.emit(sheet.picture.address(edge))
        else:
            canvas.add_state_wanted.emit(at)

    def sub_at(self, state: int, at: QPointF) -> str:
        """The sub-SB of the fact whose chip is at a scene point; empty for none."""
        sheet, digit = self._canvas.sheet, self.fact_at(state, at)
        return sheet.picture.face(state).chips[digit].sub if sheet and digit >= 0 else ""

    def fact_at(self, state: int, at: QPointF) -> int:
        """The digit of the fact whose chip is at a scene point; -1 for none."""
        sheet = self._canvas.sheet
        if sheet is None or sheet.level is not Level.FULL:
            return -1
        face = sheet.picture.face(state)
        here = QPointF(at.x() - sheet.at[state, 0], at.y() - sheet.at[state, 1])
        places = chip_places(face, sheet.ink, float(sheet.full_widths[state]))
        for digit, (_, place) in enumerate(zip(face.chips, places, strict=False)):
            if place.adjusted(-2, -2, 2, 5).contains(here):
                return digit
        return -1

    def _select_for_menu(self, event: QMouseEvent) -> None:
        """Select the element of a right click, unless it is selected already."""
        canvas = self._canvas
        address = canvas.address_at(canvas.mapToScene(event.position().toPoint()))
        if address is not None and address not in canvas.marks.selection:
            canvas.selection_wanted.emit((address,))

    def look_again(self) -> None:
        """Update what is hovered: the picture changed below a pointer that did not move."""
        viewport = self._canvas.viewport()
        if self._gesture is None and viewport.underMouse():
            self._hover(QPointF(viewport.mapFromGlobal(QCursor.pos())))

    def left(self) -> None:
        """The pointer has left the canvas: hover nothing."""
        if self._gesture is None:
            self._set_hover(-1, -1)

    # Hover

    def _hover(self, at: QPointF) -> None:
        canvas, sheet = self._canvas, self._canvas.sheet
        if sheet is None:
            return
        point = canvas.mapToScene(at.toPoint())
        state = sheet.state_at(point.x(), point.y())
        if state < 0 and canvas.editing:
            state = self._kept_hover(point)
        drawn = canvas.drawn_at(point) if state < 0 else None
        edge = -1 if state >= 0 or drawn is not None else sheet.edge_at(point.x(), point.y())
        self._set_hover(state, edge)
        if state >= 0 and canvas.editing and sheet.level >= Level.COMPACT:
            handle = nearest(sheet, state, point)
            # A handle near the grip or a bend would cover it and take its clicks.
            hidden = self._near(handle, canvas.gestures.grip, CLEAR)
            hidden = hidden or self.line.bend_at(point) >= 0
            canvas.gestures.put("handle", None if hidden else handle)
        elif canvas.gestures.handle is not None:
            canvas.gestures.put("handle", None)
        self._tip(state, edge, self.fact_at(state, point) if state >= 0 else -1)
        if drawn is not None:
            canvas.viewport().setToolTip(tip_text(sheet.drawn.tip(drawn)))
        if self.line.bend_at(point) >= 0:
            canvas.viewport().setToolTip(tip_text("Drag to move, double-click to remove"))
        self._cursor()

    def _kept_hover(self, point: QPointF) -> int:
        """The state beside the pointer, if the pointer is outside it but near its handle.

        -1 for none.
        """
        sheet = self._canvas.sheet
        assert sheet is not None
        near = sheet.state_at(point.x(), point.y(), REACH)
        if near < 0:
            return -1
        handle = nearest(sheet, near, point)
        kept = near == sheet.looks.hovered_state
        return near if kept or self._near(point, handle, HANDLE_RADIUS + 2.0) else -1

    def handles(self, state: int) -> dict[str, QPointF]:
        """The handles of a state as scene points, by side."""
        sheet = self._canvas.sheet
        return handles(sheet, state) if sheet is not None else {}

    def _set_hover(self, state: int, edge: int) -> None:
        canvas, sheet = self._canvas, self._canvas.sheet
        if sheet is None:
            return
        looks = sheet.looks
        before = looks.hovered_state, looks.hovered_edge
        if before == (state, edge):
            return
        labels = canvas.lit_layer.shown()
        looks.hovered_state, looks.hovered_edge = state, edge
        canvas.update_lit(labels)
        canvas.update_edges({e for e in (before[1], edge) if 0 <= e < len(sheet.picture.source)})
        for node in (before[0], state):
            canvas.update_node(node)
        if state < 0:
            canvas.gestures.put("handle", None)
        address = None
        if state >= 0:
            address = sheet.address_of_state(state)
        elif edge >= 0:
            address = sheet.picture.address(edge)
        self._overlays.hover(address)
        canvas.hover_changed.emit(address)

    def hover_target(self, address: Address | None) -> None:
        """Highlight the state that would become the target; None removes the highlight."""
        sheet = self._canvas.sheet
        if sheet is not None:
            self._set_hover(sheet.picture.node(address) if address is not None else -1, -1)

    def hush(self) -> None:
        """Hide the sentence at the pointer."""
        self._overlays.hush()

    def _tip(self, state: int, edge: int, digit: int) -> None:
        """Set the tooltip: what the value of a fact means, the full name of a state, or the words
        of an operation.
        """
        sheet = self._canvas.sheet
        assert sheet is not None
        tip = ""
        if digit >= 0:
            branch, name = sheet.picture.branch, sheet.picture.names[state]
            tip = fact_words(branch, digit, branch.facts(name)[digit])
            sub = branch.subs.get(digit)
            tip += f"\nExpanded by {sub}" if sub else ""
        elif state >= 0:
            face = sheet.picture.face(state)
            tip = face.name if not face.title else f"{face.name}\n{face.title}"
        elif edge >= 0:
            tip = edge_tip(self._canvas, edge)
        if self._canvas.viewport().toolTip() != tip:
            self._canvas.viewport().setToolTip(tip_text(tip))

    def show_grip(self) -> None:
        """Show the grip at the arrowhead, and the bends, if exactly one operation is selected."""
        canvas, sheet = self._canvas, self._canvas.sheet
        edge, place = self.line.edge, None
        self.line.show()
        if sheet is not None and edge >= 0 and canvas.editing:
            place = QPointF(*sheet.geometry.shape(edge).tip)
        if place != canvas.gestures.grip:
            canvas.gestures.put("grip", place)
            self.look_again()

    def _near(self, a: QPointF, b: QPointF | None, pixels: float) -> bool:
        if b is None:
            return False
        step = (a - b) * self._canvas.zoom
        return step.x() ** 2 + step.y() ** 2 <= pixels**2

    def _cursor(self) -> None:
        shape = Qt.CursorShape
        if isinstance(self._gesture, ConnectTool):
            self._canvas.viewport().setCursor(shape.CrossCursor)
        elif self._gesture is None:
            free = shape.OpenHandCursor if self._space else shape.ArrowCursor
            self._canvas.viewport().setCursor(free)

    # Keys

    def key_press(self, event: QKeyEvent) -> bool:
        """Act on a key; returns whether it was used."""
        if event.key() == Qt.Key.Key_Space and not event.modifiers():
            if not event.isAutoRepeat():
                self._space = True
                self._cursor()
            return True
        if event.key() == Qt.Key.Key_Escape and self._drop_gesture():
            return True
        tool = self._gesture
        if isinstance(tool, ConnectTool) and event.key() in keys.ENTER and tool.take_selected():
            self._leave_tool(tool)
            return True
        return self.line.key(event) or keys.press(self._canvas, event)

    def key_release(self, event: QKeyEvent) -> bool:
        """Take the release of Space; returns whether the key was used."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space = False
            self._cursor()
            return True
        return False

    def lost_focus(self) -> None:
        """Treat Space as released, because its release event will not come here."""
        self._space = False
