"""ConnectTool: draws an operation by clicks on its source and on its target."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QMouseEvent

from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.gestures import GestureOwner, is_far
from smsl_studio.studio.base.canvas.operation_gestures import Connect

FIRST = "Click the state where the operation starts."
SECOND = "Click the target state, or empty canvas for a new one."


class ConnectTool:
    """A gesture of several clicks: a state, then a state or empty canvas. A drag does both.

    It goes on after a release, until ``done``. Enter takes the selected state in place of a click.
    """

    def __init__(self, canvas: BranchView, hand: GestureOwner, source: int = -1) -> None:
        """``source`` is the number of the state where the operation starts, -1 if it is open."""
        self._canvas, self._hand = canvas, hand
        self._line: Connect | None = None
        self._source, self._pressed = -1, QPoint()
        self.done = False
        canvas.gestures.put("handle", None)
        if source >= 0:
            self._begin(source)
            canvas.say(SECOND)
        else:
            chosen = canvas.marks.selection
            one = len(chosen) == 1 and chosen[0].state and not chosen[0].operation
            canvas.say(f"{FIRST} Enter: {chosen[0].state}." if one else FIRST)

    def press(self, event: QMouseEvent) -> None:
        """Take the state below the pointer as source, or end the operation there."""
        if event.button() is not Qt.MouseButton.LeftButton:
            self.cancel()
        elif self._line is not None:
            self.done = True
            self._line.release(event)
        else:
            state = self._state_at(event)
            if state < 0:
                self._canvas.say(FIRST)
                return
            self._begin(state)
            self._pressed = event.position().toPoint()

    def move(self, event: QMouseEvent) -> None:
        """Highlight the state that would be the source, or draw the line to the pointer."""
        if self._line is not None:
            self._line.move(event)
            return
        sheet, state = self._canvas.sheet, self._state_at(event)
        found = sheet.address_of_state(state) if sheet is not None and state >= 0 else None
        self._hand.hover_target(found)

    def release(self, event: QMouseEvent) -> None:
        """End a drag that began at the source; after a click go on to the target."""
        if self._line is None or self.done:
            return
        here = event.position().toPoint()
        if is_far(self._pressed, here) and self._state_at(event) != self._source:
            self.done = True
            self._line.release(event)
        else:
            self._canvas.say(SECOND)

    def take_selected(self) -> bool:
        """Take the selected state as source, or as target if there is a source.

        False if there is not one such state.
        """
        sheet, chosen = self._canvas.sheet, self._canvas.marks.selection
        state = sheet.picture.node(chosen[0]) if sheet is not None and len(chosen) == 1 else -1
        middle = self._canvas.rect_of(chosen[0]) if state >= 0 else None
        if sheet is None or middle is None:
            return False
        if self._line is None:
            self._begin(state)
            self._canvas.say(f"{SECOND} Or select it, and press Enter.")
        else:
            self.cancel()
            source = sheet.address_of_state(self._source)
            self._canvas.connect_wanted.emit(source, chosen[0], middle.bottomRight())
        return True

    def cancel(self) -> None:
        """Leave the tool; nothing is drawn."""
        self.done = True
        self._hand.hover_target(None)
        self._hand.hush()
        if self._line is not None:
            self._line.cancel()

    def _begin(self, state: int) -> None:
        self._source = state
        self._line = Connect(self._canvas, self._hand, None, state)

    def _state_at(self, event: QMouseEvent) -> int:
        at, sheet = self._canvas.mapToScene(event.position().toPoint()), self._canvas.sheet
        return sheet.state_at(at.x(), at.y()) if sheet is not None else -1
