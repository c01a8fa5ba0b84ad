"""Gestures on the line of an operation: a drag moves a piece, a bend or the label."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QMouseEvent

from smsl_studio.blueprint.edge_layout import ASIDE, MOST_BENDS, EdgeLayout
from smsl_studio.picture.bends import GAP, clear_of, rank_of
from smsl_studio.picture.guides import Guide, snapped
from smsl_studio.picture.shape import NodeBox, Point
from smsl_studio.studio.base.canvas import right_angles
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.gestures import GRID, SNAP, centres_in_view, is_far
from smsl_studio.studio.base.canvas.handles import tail_of
from smsl_studio.studio.base.canvas.line_marks import LineMarks

ON_LINE = 7.0
"""How near its line a dragged label has to come to lie on it (pixels)."""


class _OnLine:
    """A press on the line of an operation. A click does nothing, a drag draws the line anew."""

    def __init__(self, canvas: BranchView, event: QMouseEvent, edge: int) -> None:
        sheet = canvas.sheet
        assert sheet is not None
        self._canvas, self._sheet, self._edge = canvas, sheet, edge
        self._pressed = event.position().toPoint()
        self._start = canvas.mapToScene(self._pressed)
        self._before = self._after = sheet.lines.get(edge, EdgeLayout())
        self._shape = sheet.geometry.shape(edge)
        self._begun = False

    def _step(self, event: QMouseEvent) -> QPointF | None:
        """How far the pointer went since the press (scene units); None if it is no drag yet."""
        here = event.position().toPoint()
        if not self._begun and not is_far(self._pressed, here):
            return None
        self._begun = True
        return self._canvas.mapToScene(here) - self._start

    def _show(self, layout: EdgeLayout, marks: LineMarks) -> None:
        self._after = layout
        self._canvas.redraw_edge(self._edge, layout)
        tip = QPointF(*self._sheet.geometry.shape(self._edge).tip)
        self._canvas.gestures.put("grip", tip)
        self._canvas.gestures.put("tail", tail_of(self._sheet, self._edge))
        self._canvas.gestures.put("line", marks)

    def release(self, event: QMouseEvent) -> None:
        """Ask for the line as it is drawn now."""
        if self._after == self._before:
            self.cancel()
            return
        self._canvas.gestures.put("guides", ())
        address = self._sheet.picture.address(self._edge)
        self._canvas.line_wanted.emit(address, self._after, False)

    def cancel(self) -> None:
        """Draw the line as it was."""
        self._canvas.gestures.put("guides", ())
        if self._begun:
            handles = tuple(QPointF(*at) for at in self._before.bends)
            self._show(self._before, LineMarks(handles))
            self._canvas.settle()


class DragBend(_OnLine):
    """Moves a bend, or adds one where the line was pressed."""

    def __init__(
        self, canvas: BranchView, event: QMouseEvent, edge: int, bend: int | None = None
    ) -> None:
        """Without ``bend`` a new one is added once the pointer moves."""
        super().__init__(canvas, event, edge)
        bends = self._before.bends
        at = self._start.x(), self._start.y()
        if bend is None:
            bend = rank_of(self._shape, bends, at)
            self._points = [*bends[:bend], at, *bends[bend:]]
        else:
            self._points = list(bends)
        self._bend, self._from = bend, self._points[bend]
        others = centres_in_view(canvas, self._sheet, [])
        neighbours = [p for rank, p in enumerate(self._points) if rank != bend]
        self._others = np.vstack([others, *np.array(neighbours).reshape(-1, 1, 2)])

    def move(self, event: QMouseEvent) -> None:
        """Lead the line through the pointer. The bend snaps like a state, except with Alt."""
        step = self._step(event)
        if step is None:
            return
        if len(self._points) > MOST_BENDS:
            self._canvas.say(f"A line has at most {MOST_BENDS} bends.")
            return
        at = self._from[0] + step.x(), self._from[1] + step.y()
        guides: tuple[Guide, ...] = ()
        if not event.modifiers() & Qt.KeyboardModifier.AltModifier:
            at, guides = self._snapped(at)
        self._points[self._bend] = at
        self._canvas.gestures.put("guides", guides)
        former = tuple(QPointF(*p) for p in self._shape.points.tolist())
        marks = LineMarks(tuple(QPointF(*p) for p in self._points), self._bend, former=former)
        self._show(replace(self._before, bends=tuple(self._points)), marks)

    def _snapped(self, at: Point) -> tuple[Point, tuple[Guide, ...]]:
        """Where the bend snaps to: clear of all nodes, on a line of others' centres or the grid."""
        sheet = self._sheet
        to, guides = snapped(at, self._others, SNAP / self._canvas.zoom, GRID)
        clear = clear_of(to, np.hstack([sheet.at, sheet.halves()]), GAP * sheet.unit)
        return clear, guides if clear == to else ()


class DragPiece(_OnLine):
    """Moves a piece of a line with right angles, or one of its corners, and keeps the angles."""

    def __init__(
        self,
        canvas: BranchView,
        event: QMouseEvent,
        edge: int,
        corners: list[Point],
        rank: int | None = None,
    ) -> None:
        """``rank`` is that of the corner that was pressed; without one a piece moves."""
        super().__init__(canvas, event, edge)
        sheet, picture = self._sheet, self._sheet.picture
        boxes = sheet.geometry.boxes
        source, target = int(picture.source[edge]), int(picture.target[edge])
        self._ends = NodeBox(*boxes[source].tolist()), NodeBox(*boxes[target].tolist())
        self._others = np.delete(boxes, [source, target], axis=0)
        self._corners, self._rank = corners, rank
        self._piece = right_angles.piece_at(corners, (self._start.x(), self._start.y()))

    def move(self, event: QMouseEvent) -> None:
        """Put the piece at the pointer, on the grid and off all states, except with Alt."""
        step = self._step(event)
        if step is None:
            return
        free = bool(event.modifiers() & Qt.KeyboardModifier.AltModifier)
        if self._rank is not None:
            x, y = self._corners[self._rank + 1]
            at = _on_grid(x + step.x(), free), _on_grid(y + step.y(), free)
            bends = right_angles.corner_moved(self._corners, self._rank + 1, at, self._ends)
        else:
            bends = self._moved(step, free)
        if len(bends) > MOST_BENDS:
            self._canvas.say(f"A line has at most {MOST_BENDS} bends.")
            return
        former = tuple(QPointF(*p) for p in self._shape.points.tolist())
        chosen = -1 if self._rank is None else self._rank
        last = self._after
        for layout in (replace(self._before, bends=tuple(bends)), last):
            marks = LineMarks(tuple(QPointF(*p) for p in layout.bends), chosen, former=former)
            self._show(layout, marks)
            # Close to a state a line may have no way with right angles.
            if right_angles.corners_of(self._sheet.geometry.shape(self._edge), self._sheet.unit):
                break

    def _moved(self, step: QPointF, free: bool) -> list[Point]:
        across = 1 - right_angles.axis_of(self._corners, self._piece)
        to = self._corners[self._piece][across] + (step.x(), step.y())[across]
        unit = self._sheet.unit
        if not free:
            to = right_angles.clear_value(
                self._corners, self._piece, _on_grid(to, free), self._others, unit
            )
        return right_angles.moved(self._corners, self._piece, to, self._ends, unit)


def _on_grid(value: float, free: bool) -> float:
    return value if free else round(value / GRID) * GRID


class DragLabel(_OnLine):
    """Moves the label of an operation along its line and beside it."""

    def __init__(self, canvas: BranchView, event: QMouseEvent, edge: int, rect: QRectF) -> None:
        super().__init__(canvas, event, edge)
        self._from = rect.center()

    def move(self, event: QMouseEvent) -> None:
        """Put the label at the pointer. Near its line it lies on the line, except with Alt."""
        step = self._step(event)
        if step is None:
            return
        at = self._from + step
        along = self._shape.along(at.x(), at.y())
        x, y = self._shape.at(along)
        away = QPointF(at.x() - x, at.y() - y)
        near = away.manhattanLength() * self._canvas.zoom <= ON_LINE
        if near and not event.modifiers() & Qt.KeyboardModifier.AltModifier:
            away = QPointF(0.0, 0.0)
        dx, dy = (min(max(value, -ASIDE), ASIDE) for value in (away.x(), away.y()))
        share = along / (self._shape.length or 1.0)
        marks = LineMarks(tuple(QPointF(*p) for p in self._before.bends))
        self._show(replace(self._before, label=(share, dx, dy)), marks)
