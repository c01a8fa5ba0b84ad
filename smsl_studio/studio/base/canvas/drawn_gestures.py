"""The gestures of notes and groups: a press on one selects it, a drag moves it."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.canvas.gestures import GRID, Gesture


def press_drawn(canvas: BranchView, event: QMouseEvent, key: DrawnKey) -> Gesture:
    """Select the note or group that was pressed, and begin to drag it."""
    canvas.drawn_wanted.emit(key)
    return DragNote(canvas, event, key) if key.kind == "note" else DragGroup(canvas, event, key)


class _Drag:
    """How far the pointer has moved, once it is a drag and no click."""

    def __init__(self, canvas: BranchView, event: QMouseEvent) -> None:
        self.canvas, self._start = canvas, event.position().toPoint()
        self.begun = False

    def step(self, event: QMouseEvent) -> QPointF | None:
        """The way from the press in scene units; None while it is a click."""
        here = event.position().toPoint()
        far = (here - self._start).manhattanLength() >= QApplication.startDragDistance() // 2 + 1
        self.begun = self.begun or far
        if not self.begun:
            return None
        return self.canvas.mapToScene(here) - self.canvas.mapToScene(self._start)


class DragNote:
    """Moves a note. Its corner snaps to the grid, except with Alt."""

    def __init__(self, canvas: BranchView, event: QMouseEvent, key: DrawnKey) -> None:
        assert canvas.sheet is not None
        self._drag, self._canvas, self._key = _Drag(canvas, event), canvas, key
        self._corner: tuple[float, float] = tuple(
            canvas.sheet.drawn.note_rects[canvas.sheet.drawn.number(key), :2].tolist()
        )
        self._to = self._corner

    def move(self, event: QMouseEvent) -> None:
        """Show the note where the pointer takes it."""
        step = self._drag.step(event)
        if step is None:
            return
        x, y = self._corner[0] + step.x(), self._corner[1] + step.y()
        if not event.modifiers() & Qt.KeyboardModifier.AltModifier:
            x, y = round(x / GRID) * GRID, round(y / GRID) * GRID
        self._to = x, y
        self._canvas.drag_note(self._key, x, y)

    def release(self, event: QMouseEvent) -> None:
        """Ask for the new place after a drag."""
        self.cancel()
        if self._drag.begun and self._to != self._corner:
            self._canvas.note_moved.emit(self._key.key, QPointF(*self._to))

    def cancel(self) -> None:
        """Show the note where it was."""
        self._canvas.drop_note(self._key)


class DragGroup:
    """Moves the states of a group, in steps of the grid, except with Alt."""

    def __init__(self, canvas: BranchView, event: QMouseEvent, key: DrawnKey) -> None:
        sheet = canvas.sheet
        assert sheet is not None
        self._drag, self._canvas, self._sheet = _Drag(canvas, event), canvas, sheet
        states = sheet.drawn.parts.members[sheet.drawn.number(key)].tolist()
        self._places = {i: (float(sheet.at[i, 0]), float(sheet.at[i, 1])) for i in states}

    def move(self, event: QMouseEvent) -> None:
        """Show the states where the pointer takes them."""
        step = self._drag.step(event)
        if step is None:
            return
        dx, dy = step.x(), step.y()
        if not event.modifiers() & Qt.KeyboardModifier.AltModifier:
            dx, dy = round(dx / GRID) * GRID, round(dy / GRID) * GRID
        self._canvas.drag_states({i: (x + dx, y + dy) for i, (x, y) in self._places.items()})

    def release(self, event: QMouseEvent) -> None:
        """Ask for the new places after a drag."""
        if not self._drag.begun:
            return
        names, at = self._sheet.picture.names, self._sheet.at
        places = {names[i]: (float(at[i, 0]), float(at[i, 1])) for i in self._places}
        self._canvas.settle()
        if places != {names[i]: place for i, place in self._places.items()}:
            self._canvas.moved.emit(places, {})

    def cancel(self) -> None:
        """Put the states back where they were."""
        if self._drag.begun:
            self._canvas.drag_states(self._places)
            self._canvas.settle()
