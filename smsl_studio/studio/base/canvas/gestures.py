"""Gestures: small objects that live from a press of a mouse button to its release."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from PySide6.QtCore import QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.guides import Guide, snapped
from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.membership import Membership
from smsl_studio.studio.base.canvas.sheet import Sheet

GRID = 8.0
SNAP = 5.0
"""How near a dragged state has to come to the line of another one to snap to it (pixels)."""
Modifier = Qt.KeyboardModifier


class Gesture(Protocol):
    """A mouse gesture on the canvas, begun by a press of a button."""

    def move(self, event: QMouseEvent) -> None:
        """The pointer moved while the button is down."""

    def release(self, event: QMouseEvent) -> None:
        """The button was released: carry out the gesture."""

    def cancel(self) -> None:
        """The gesture was cancelled: restore what was there before the press."""


class GestureOwner(Protocol):
    """What a gesture needs from ``Hover``."""

    def fact_at(self, state: int, at: QPointF) -> int:
        """The digit of the fact whose chip is at a scene point; -1 for none."""

    def hover_target(self, address: Address | None) -> None:
        """Highlight the state that would become the target; None removes the highlight."""

    def hush(self) -> None:
        """Hide the sentence at the pointer."""


def is_far(a: QPoint, b: QPoint) -> bool:
    """Whether the pointer moved so far (pixels) that it is a drag and no click."""
    return (a - b).manhattanLength() >= QApplication.startDragDistance() // 2 + 1


class Pan:
    """Moves the picture with the pointer."""

    def __init__(self, canvas: BranchView, event: QMouseEvent) -> None:
        self._canvas, self._last = canvas, event.position()
        canvas.viewport().setCursor(Qt.CursorShape.ClosedHandCursor)

    def move(self, event: QMouseEvent) -> None:
        """Move the picture by as much as the pointer moved."""
        step = event.position() - self._last
        self._last = event.position()
        self._canvas.camera.pan(step.x(), step.y())

    def release(self, event: QMouseEvent) -> None:
        """Restore the usual pointer."""
        self.cancel()

    def cancel(self) -> None:
        """Restore the usual pointer; the picture stays where it is."""
        self._canvas.viewport().unsetCursor()


class Band:
    """Selects the states whose nodes touch a rectangle that the user draws."""

    def __init__(self, canvas: BranchView, event: QMouseEvent) -> None:
        self._canvas = canvas
        self._start = event.position().toPoint()
        self._before = canvas.marks.selection
        self._modifiers = event.modifiers()
        self._begun = False

    def move(self, event: QMouseEvent) -> None:
        """Draw the rectangle and select the states that it touches."""
        here = event.position().toPoint()
        if not self._begun and not is_far(self._start, here):
            return
        self._begun = True
        rect = QRectF(self._canvas.mapToScene(self._start), self._canvas.mapToScene(here))
        self._canvas.gestures.put("band", rect)
        self._canvas.selection_wanted.emit(self._selected(rect.normalized()))

    def release(self, event: QMouseEvent) -> None:
        """Remove the rectangle.

        A click without a drag clears the selection, unless Shift or Ctrl is held.
        """
        self._canvas.gestures.put("band", None)
        kept = self._modifiers & (Modifier.ShiftModifier | Modifier.ControlModifier)
        if not self._begun and not kept:
            self._canvas.selection_wanted.emit(())

    def cancel(self) -> None:
        """Remove the rectangle and restore the former selection."""
        self._canvas.gestures.put("band", None)
        self._canvas.selection_wanted.emit(self._before)

    def _selected(self, rect: QRectF) -> tuple[Address, ...]:
        sheet = self._canvas.sheet
        if sheet is None:
            return ()
        half = sheet.halves()
        at = sheet.at
        inside = (
            (at[:, 0] - half[:, 0] < rect.right())
            & (at[:, 0] + half[:, 0] > rect.left())
            & (at[:, 1] - half[:, 1] < rect.bottom())
            & (at[:, 1] + half[:, 1] > rect.top())
        )
        found = tuple(sheet.address_of_state(int(i)) for i in inside.nonzero()[0])
        if self._modifiers & Modifier.ControlModifier:
            stays = tuple(a for a in self._before if a not in found)
            return stays + tuple(a for a in found if a not in self._before)
        if self._modifiers & Modifier.ShiftModifier:
            return tuple(dict.fromkeys(self._before + found))
        return found


class DragStates:
    """A press on a state: a click selects it, a drag moves it and all selected states."""

    def __init__(
        self, canvas: BranchView, hand: GestureOwner, event: QMouseEvent, state: int
    ) -> None:
        sheet = canvas.sheet
        assert sheet is not None
        self._canvas, self._hand, self._state = canvas, hand, state
        self._start = event.position().toPoint()
        self._begun = False
        address = sheet.address_of_state(state)
        selection = canvas.marks.selection
        self._only = selection_after(canvas.extended(), address, event.modifiers())
        self._late = address in selection and self._only == (address,)
        self._alone = selection == (address,)
        if not self._late:
            canvas.selection_wanted.emit(self._only)
        chosen = canvas.marks.selection if address in canvas.marks.selection else (address,)
        picture = sheet.picture
        states = dict.fromkeys([state, *(i for a in chosen if (i := picture.node(a)) >= 0)])
        self._places = {i: (float(sheet.at[i, 0]), float(sheet.at[i, 1])) for i in states}
        self._others = centres_in_view(canvas, sheet, list(states))
        self._groups = Membership(sheet, list(states))

    def move(self, event: QMouseEvent) -> None:
        """Move the states. The one under the pointer snaps, except with Alt.

        It snaps to centres of other states in view, which guides show, and else to the grid.
        """
        here = event.position().toPoint()
        if not self._canvas.editing or (not self._begun and not is_far(self._start, here)):
            return
        self._begun = True
        self._canvas.gestures.put("handle", None)
        step = self._canvas.mapToScene(here) - self._canvas.mapToScene(self._start)
        x, y = self._places[self._state]
        dx, dy = step.x(), step.y()
        guides: tuple[Guide, ...] = ()
        if not event.modifiers() & Modifier.AltModifier:
            # The other dragged states keep their distance to the one under the pointer.
            reach = SNAP / self._canvas.zoom
            (to_x, to_y), guides = snapped((x + dx, y + dy), self._others, reach, GRID)
            dx, dy = to_x - x, to_y - y
        self._canvas.gestures.put("guides", guides)
        self._canvas.drag_states({i: (px + dx, py + dy) for i, (px, py) in self._places.items()})
        members = self._groups.now()
        self._canvas.show_members(members)
        told = self._groups.words(members)
        if told:
            self._canvas.say(told)
        else:
            self._hand.hush()

    def release(self, event: QMouseEvent) -> None:
        """Emit the new places after a drag; select the state after a click."""
        sheet = self._canvas.sheet
        self._canvas.gestures.put("guides", ())
        if not self._begun or sheet is None:
            if self._late:
                self._canvas.selection_wanted.emit(self._only)
                if self._alone:
                    self._want_fact()
            return
        names = sheet.picture.names
        places = {names[i]: (float(sheet.at[i, 0]), float(sheet.at[i, 1])) for i in self._places}
        before = {names[i]: place for i, place in self._places.items()}
        groups = self._groups.changes(self._groups.now())
        self._drop()
        if places != before:
            self._canvas.moved.emit(places, groups)

    def _want_fact(self) -> None:
        """Emit ``fact_wanted`` for a click on a fact of the state that alone was selected
        before."""
        canvas = self._canvas
        digit = self._hand.fact_at(self._state, canvas.mapToScene(self._start))
        if digit >= 0:
            canvas.fact_wanted.emit(digit)

    def cancel(self) -> None:
        """Put the states back where they were."""
        self._canvas.gestures.put("guides", ())
        if self._begun:
            self._canvas.drag_states(self._places)
            self._drop()

    def _drop(self) -> None:
        """Route all lines again at the present places of the states. The groups have the states of
        the blueprint again.
        """
        self._canvas.show_members(None)
        self._hand.hush()
        self._canvas.settle()


def selection_after(
    selection: tuple[Address, ...], address: Address, modifiers: Qt.KeyboardModifier
) -> tuple[Address, ...]:
    """The selection after a click: Shift adds, Ctrl toggles, otherwise only the clicked element."""
    if modifiers & Modifier.ControlModifier:
        if address in selection:
            return tuple(a for a in selection if a != address)
        return (*selection, address)
    if modifiers & Modifier.ShiftModifier:
        return tuple(dict.fromkeys((*selection, address)))
    return (address,)


def centres_in_view(canvas: BranchView, sheet: Sheet, without: list[int]) -> Floats:
    """The centres of all states in view except these, (n, 2)."""
    seen = canvas.seen
    found = sheet.states_in(seen.left(), seen.top(), seen.right(), seen.bottom())
    return sheet.at[np.setdiff1d(np.array(found, dtype=np.intp), without)].copy()
