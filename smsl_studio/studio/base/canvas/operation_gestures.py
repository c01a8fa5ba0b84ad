"""Gestures that draw an operation: from a state to its target, or one of its ends to another."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF
from PySide6.QtGui import QMouseEvent

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.gesture_layer import DrawnOperation
from smsl_studio.studio.base.canvas.gestures import GestureOwner, is_far
from smsl_studio.studio.base.canvas.handles import pending_ends


class Connect:
    """Draws an operation from a state's handle to a state or to empty canvas."""

    def __init__(
        self,
        canvas: BranchView,
        hand: GestureOwner,
        event: QMouseEvent | None,
        state: int,
        start: QPointF | None = None,
    ) -> None:
        """``event`` is the press that began it, at the handle ``start``.

        Both are None if the line follows the pointer without a button. Then it starts at the side
        of the state where the pointer is.
        """
        sheet = canvas.sheet
        assert sheet is not None
        self._canvas, self._hand, self._sheet = canvas, hand, sheet
        self._state, self._start = state, start
        self._source = sheet.address_of_state(state)
        self._pressed = event.position().toPoint() if event is not None else QPoint()
        self._begun = event is None
        canvas.gestures.put("handle", None)
        if start is not None:
            canvas.gestures.put("drawn", DrawnOperation(start, start))

    def move(self, event: QMouseEvent) -> None:
        """Draw the line to the pointer. If the state below cannot be the target, say why."""
        here = event.position().toPoint()
        self._begun = self._begun or is_far(self._pressed, here)
        at = self._canvas.mapToScene(here)
        target = _state_at(self._canvas, at)
        reason = self._canvas.why_not(self._source, target) if target is not None else ""
        ghost = target is None and self._begun and not self._over_source(at)
        start = self._start or pending_ends(self._sheet, self._state, at, None)[0]
        self._canvas.gestures.put(
            "drawn", DrawnOperation(start, at, refused=bool(reason), ghost=ghost)
        )
        self._hand.hover_target(target)
        if reason:
            self._canvas.say(reason)
        elif self._start is not None:
            self._hand.hush()

    def release(self, event: QMouseEvent) -> None:
        """Ask for an operation to the state below the pointer, or to a new state on empty
        canvas."""
        at = self._canvas.mapToScene(event.position().toPoint())
        target = _state_at(self._canvas, at)
        self.cancel()
        if not self._begun or (target is None and self._over_source(at)):
            return
        reason = self._canvas.why_not(self._source, target) if target is not None else ""
        if reason:
            self._canvas.say(reason)
        else:
            self._canvas.connect_wanted.emit(self._source, target, at)

    def cancel(self) -> None:
        """Remove the line and the sentence at the pointer."""
        self._canvas.gestures.put("drawn", None)
        self._hand.hover_target(None)
        self._hand.hush()

    def _over_source(self, at: QPointF) -> bool:
        rect = self._canvas.rect_of(self._source)
        return rect is not None and rect.adjusted(-20, -20, 20, 20).contains(at)


class Retarget:
    """Drags the arrowhead of the selected operation to another state."""

    def __init__(
        self, canvas: BranchView, hand: GestureOwner, event: QMouseEvent, edge: int
    ) -> None:
        sheet = canvas.sheet
        assert sheet is not None
        self._canvas, self._hand = canvas, hand
        self._address = sheet.picture.address(edge)
        self._pressed = event.position().toPoint()
        self._start = QPointF(*sheet.geometry.shape(edge).at(0.0))
        self._begun = False

    def move(self, event: QMouseEvent) -> None:
        """Draw the line to the pointer. If there is no state below it, say what is missing."""
        here = event.position().toPoint()
        if not self._begun and not is_far(self._pressed, here):
            return
        self._begun = True
        at = self._canvas.mapToScene(here)
        target = _state_at(self._canvas, at)
        self._canvas.gestures.put("grip", None)
        self._canvas.gestures.put("drawn", DrawnOperation(self._start, at, refused=target is None))
        self._hand.hover_target(target)
        if target is None:
            self._canvas.say("An operation needs a target. Let go over a state.")
        else:
            self._hand.hush()

    def release(self, event: QMouseEvent) -> None:
        """Ask for the state below the pointer as the new target."""
        target = _state_at(self._canvas, self._canvas.mapToScene(event.position().toPoint()))
        self.cancel()
        if self._begun and target is not None:
            self._canvas.retarget_wanted.emit(self._address, target)

    def cancel(self) -> None:
        """Remove the line and the sentence at the pointer."""
        self._canvas.gestures.put("drawn", None)
        self._hand.hover_target(None)
        self._hand.hush()


class MoveSource:
    """Drags the beginning of the selected operation to another state."""

    def __init__(
        self, canvas: BranchView, hand: GestureOwner, event: QMouseEvent, edge: int
    ) -> None:
        sheet = canvas.sheet
        assert sheet is not None
        self._canvas, self._hand, self._sheet = canvas, hand, sheet
        self._address = sheet.picture.address(edge)
        self._pressed = event.position().toPoint()
        self._tip = QPointF(*sheet.geometry.shape(edge).tip)
        self._begun = False

    def move(self, event: QMouseEvent) -> None:
        """Draw the line from the pointer. If it cannot start there, say why."""
        here = event.position().toPoint()
        if not self._begun and not is_far(self._pressed, here):
            return
        self._begun = True
        at = self._canvas.mapToScene(here)
        source = _state_at(self._canvas, at)
        reason = self._why_not(source)
        gestures = self._canvas.gestures
        for end in ("grip", "tail"):
            gestures.put(end, None)
        gestures.put("drawn", DrawnOperation(at, self._tip, bool(reason), moves_start=True))
        self._hand.hover_target(source)
        if reason:
            self._canvas.say(reason)
        else:
            self._hand.hush()

    def release(self, event: QMouseEvent) -> None:
        """Ask for the state below the pointer as the new source."""
        source = _state_at(self._canvas, self._canvas.mapToScene(event.position().toPoint()))
        reason = self._why_not(source)
        self.cancel()
        if not self._begun or source is None:
            return
        if reason:
            self._canvas.say(reason)
        else:
            self._canvas.source_wanted.emit(self._address, source)

    def cancel(self) -> None:
        """Remove the line and the sentence at the pointer."""
        self._canvas.gestures.put("drawn", None)
        self._hand.hover_target(None)
        self._hand.hush()

    def _why_not(self, source: Address | None) -> str:
        """Why the operation cannot start from a state; empty if it can."""
        if source is None:
            return "An operation needs a state to start from. Let go over a state."
        name, former = self._address.operation, self._address.state
        if source.state != former and name in self._sheet.picture.branch.table[source.state]:
            return f"{source.state} has an operation {name} already. Rename one of the two first."
        return ""


def _state_at(canvas: BranchView, at: QPointF) -> Address | None:
    sheet = canvas.sheet
    if sheet is None:
        return None
    state = sheet.state_at(at.x(), at.y(), 3.0)
    return sheet.address_of_state(state) if state >= 0 else None
