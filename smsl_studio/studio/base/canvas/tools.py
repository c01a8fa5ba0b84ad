"""Hand: turns mouse and key events into gestures."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QCursor, QKeyEvent, QMouseEvent

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas import keys
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.connect_tool import ConnectTool
from smsl_studio.studio.base.canvas.drawn_gestures import press_drawn
from smsl_studio.studio.base.canvas.gestures import (
    Band,
    DragStates,
    Gesture,
    Pan,
    selection_after,
)
from smsl_studio.studio.base.canvas.handles import is_near, tail_of
from smsl_studio.studio.base.canvas.hover import GRIP, Hover
from smsl_studio.studio.base.canvas.line_handles import LineHandles
from smsl_studio.studio.base.canvas.operation_gestures import Connect, MoveSource, Retarget
from smsl_studio.studio.base.canvas.overlays import Overlays

NO_BUNDLE = "No operations are bundled here. The menu View bundles them."
"""The message for the key L if there are no bundles."""


class Hand:
    """The gesture in progress, and whether Space is held.

    ``hover`` is what is under the pointer.
    """

    def __init__(self, canvas: BranchView, overlays: Overlays) -> None:
        self._canvas, self._overlays = canvas, overlays
        self._gesture: Gesture | None = None
        self._space = False
        self.line = LineHandles(canvas)
        self.hover = Hover(canvas, overlays, self.line)

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
        canvas.glide.end()
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
            on_line = self._grip_at(event, at) or self.line.press(event, at)
            if on_line is not None:
                return on_line
            handle = self.hover.handle_at(at)
            if handle is not None:
                return Connect(canvas, self.hover, event, sheet.looks.hovered_state, handle)
        state = sheet.state_at(at.x(), at.y())
        if state >= 0:
            if not canvas.editing:
                canvas.node_clicked.emit(sheet.address_of_state(state))
            return DragStates(canvas, self.hover, event, state)
        drawn = canvas.drawn_at(at) if canvas.editing else None
        if drawn is not None:
            return press_drawn(canvas, event, drawn)
        edge = sheet.edge_at(at.x(), at.y())
        if edge >= 0 and sheet.picture.bundles.count(edge):
            self._overlays.bundle.open(edge)
            return None
        if edge >= 0:
            address = sheet.picture.address(edge)
            chosen = selection_after(canvas.extended(), address, event.modifiers())
            canvas.selection_wanted.emit(chosen)
            if not canvas.editing:
                canvas.edge_clicked.emit(address)
            self.show_grip()
            return self._grip_at(event, at) or self.line.press_line(event, at)
        return Band(canvas, event) if canvas.editing else Pan(canvas, event)

    def _grip_at(self, event: QMouseEvent, at: QPointF) -> Retarget | MoveSource | None:
        """The gesture of a press on the arrowhead of the selected operation, or on its tail.

        A pointer that comes from a state takes its handle at the tail, and a bend there is taken.
        """
        canvas, edge = self._canvas, self.line.edge
        if edge < 0:
            return None
        if is_near(canvas, at, canvas.gestures.grip, GRIP):
            return Retarget(canvas, self.hover, event, edge)
        sheet = canvas.sheet
        free = sheet is not None and sheet.looks.hovered_state < 0 > self.line.bend_at(at)
        if free and is_near(canvas, at, canvas.gestures.tail, GRIP):
            return MoveSource(canvas, self.hover, event, edge)
        return None

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
            self._overlays.pad.go()
            self._gesture = ConnectTool(self._canvas, self.hover, state)
            self._cursor()

    def _drop_gesture(self) -> bool:
        """Cancel the gesture; whether there was one."""
        gesture, self._gesture = self._gesture, None
        if gesture is not None:
            gesture.cancel()
            self._cursor()
        return gesture is not None

    def _close_card(self) -> bool:
        """Close the card of a bundle; whether it was open."""
        open_ = self._overlays.bundle.edge >= 0
        self._overlays.bundle.go()
        return open_

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
            self._look(event.position())

    def release(self, event: QMouseEvent) -> None:
        """End the gesture, if there is one. The tool that connects goes on to its next click."""
        if self._use_tool(ConnectTool.release, event):
            return
        gesture, self._gesture = self._gesture, None
        if gesture is not None:
            gesture.release(event)
            self._cursor()
            self._look(event.position())

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
            sub = self.hover.sub_at(state, at)
            if sub:
                canvas.enter_wanted.emit(sub)
            elif canvas.editing:
                canvas.rename_wanted.emit(sheet.address_of_state(state))
            return
        edge = sheet.edge_at(at.x(), at.y())
        if not canvas.editing or sheet.picture.bundles.count(edge):
            return
        drawn = canvas.drawn_at(at)
        if drawn is not None:
            canvas.drawn_edit_wanted.emit(drawn)
        elif edge >= 0:
            canvas.rename_wanted.emit(sheet.picture.address(edge))
        else:
            canvas.add_state_wanted.emit(at)

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
            self._look(QPointF(viewport.mapFromGlobal(QCursor.pos())))

    def left(self) -> None:
        """The pointer has left the canvas: hover nothing."""
        if self._gesture is None:
            self.hover.clear()

    def _look(self, at: QPointF) -> None:
        """Update what is hovered at a point of the view (pixels), and the pointer."""
        self.hover.look(at)
        self._cursor()

    # What is shown at the selection and the pointer

    def show_grip(self) -> None:
        """Show the grips at both ends, and the bends, if exactly one operation is selected."""
        canvas, sheet = self._canvas, self._canvas.sheet
        edge, place, tail = self.line.edge, None, None
        self.line.show()
        if sheet is not None and edge >= 0 and canvas.editing:
            place = QPointF(*sheet.geometry.shape(edge).tip)
            tail = tail_of(sheet, edge)
        canvas.gestures.put("tail", tail)
        if place != canvas.gestures.grip:
            canvas.gestures.put("grip", place)
            self.look_again()

    def _cursor(self) -> None:
        shape = Qt.CursorShape
        if isinstance(self._gesture, ConnectTool):
            self._canvas.viewport().setCursor(shape.CrossCursor)
        elif self._gesture is None:
            drawn = shape.CrossCursor if self._canvas.gestures.taken else shape.ArrowCursor
            free = shape.OpenHandCursor if self._space else drawn
            self._canvas.viewport().setCursor(free)

    # Keys

    def key_press(self, event: QKeyEvent) -> bool:
        """Act on a key; returns whether it was used."""
        if event.key() == Qt.Key.Key_Space and not event.modifiers():
            if not event.isAutoRepeat():
                self._space = True
                self._cursor()
                if not self._canvas.marks.selection:
                    announce(self._canvas, f"{keys.NOTHING} Space and a drag move the view.")
            return True
        if event.key() == Qt.Key.Key_Escape and (self._drop_gesture() or self._close_card()):
            return True
        tool = self._gesture
        if isinstance(tool, ConnectTool) and event.key() in keys.ENTER and tool.take_selected():
            self._leave_tool(tool)
            return True
        if self._lists_bundle(event):
            return True
        return self.line.key(event) or keys.press(self._canvas, event)

    def _lists_bundle(self, event: QKeyEvent) -> bool:
        """Whether a key opens the card of a bundle: L the next one, Shift+L the previous one."""
        shift = Qt.KeyboardModifier.ShiftModifier
        if event.key() != Qt.Key.Key_L or event.modifiers() & ~shift:
            return False
        self.list_bundle(-1 if event.modifiers() & shift else 1)
        return True

    def list_bundle(self, by: int) -> None:
        """Open the card of the next bundle (1) or the previous one (-1). Say if there is none."""
        if not self._overlays.bundle.step(by):
            self._canvas.say(NO_BUNDLE)

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
