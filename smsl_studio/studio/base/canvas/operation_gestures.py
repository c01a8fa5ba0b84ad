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


class _EndDrag:
    """Drags one end of the selected operation to another state."""

    HIDDEN: tuple[str, ...] = ("grip", "tail")
    """The handles that are hidden while the end is dragged."""

    def __init__(
        self, canvas: BranchView, hand: GestureOwner, event: QMouseEvent, edge: int
    ) -> None:
        sheet = canvas.sheet
        assert sheet is not None
        self.canvas, self._hand, self.sheet = canvas, hand, sheet
        self.address = sheet.picture.address(edge)
        self.shape = sheet.geometry.shape(edge)
        self._pressed = event.position().toPoint()
        self._begun = False

    def move(self, event: QMouseEvent) -> None:
        """Draw the line to the pointer. If it cannot end there, say why."""
        here = event.position().toPoint()
        if not self._begun and not is_far(self._pressed, here):
            return
        self._begun = True
        at = self.canvas.mapToScene(here)
        state = _state_at(self.canvas, at)
        reason = self.why_not(state)
        for handle in self.HIDDEN:
            self.canvas.gestures.put(handle, None)
        self.canvas.gestures.put("drawn", self.line(at, bool(reason)))
        self._hand.hover_target(state)
        if reason:
            self.canvas.say(reason)
        else:
            self._hand.hush()

    def release(self, event: QMouseEvent) -> None:
        """Ask for the state below the pointer, or say why the operation cannot end there."""
        state = _state_at(self.canvas, self.canvas.mapToScene(event.position().toPoint()))
        reason = self.why_not(state)
        self.cancel()
        if not self._begun:
            return
        if reason or state is None:
            self.canvas.say(reason)
        else:
            self.ask(state)

    def cancel(self) -> None:
        """Remove the line and the sentence at the pointer."""
        self.canvas.gestures.put("drawn", None)
        self._hand.hover_target(None)
        self._hand.hush()

    def why_not(self, state: Address | None) -> str:
        """Return why the end cannot be at a state. The text is empty if it can."""
        raise NotImplementedError

    def line(self, at: QPointF, refused: bool) -> DrawnOperation:
        """Return the line with its end at the pointer."""
        raise NotImplementedError

    def ask(self, state: Address) -> None:
        """Ask for the operation to end at this state."""
        raise NotImplementedError


class Retarget(_EndDrag):
    """Drags the arrowhead of the selected operation to another state."""

    HIDDEN = ("grip",)

    def why_not(self, state: Address | None) -> str:
        """Return that a target is needed, if there is no state."""
        return "" if state is not None else "An operation needs a target. Let go over a state."

    def line(self, at: QPointF, refused: bool) -> DrawnOperation:
        """Return the line from its former start to the pointer."""
        return DrawnOperation(QPointF(*self.shape.at(0.0)), at, refused=refused)

    def ask(self, state: Address) -> None:
        """Ask for the state as the new target."""
        self.canvas.retarget_wanted.emit(self.address, state)


class MoveSource(_EndDrag):
    """Drags the beginning of the selected operation to another state."""

    def why_not(self, state: Address | None) -> str:
        """Return that a state is needed, or that it has an operation of this name."""
        if state is None:
            return "An operation needs a state to start from. Let go over a state."
        name, former = self.address.operation, self.address.state
        if state.state != former and name in self.sheet.picture.branch.table[state.state]:
            return f"{state.state} has an operation {name} already. Rename one of the two first."
        return ""

    def line(self, at: QPointF, refused: bool) -> DrawnOperation:
        """Return the line from the pointer to its former tip."""
        return DrawnOperation(at, QPointF(*self.shape.tip), refused, moves_start=True)

    def ask(self, state: Address) -> None:
        """Ask for the state as the new source."""
        self.canvas.source_wanted.emit(self.address, state)


def _state_at(canvas: BranchView, at: QPointF) -> Address | None:
    sheet = canvas.sheet
    if sheet is None:
        return None
    state = sheet.state_at(at.x(), at.y(), 3.0)
    return sheet.address_of_state(state) if state >= 0 else None
