"""MovedStage: a stage whose states and lines can be moved without a new sheet."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from PySide6.QtCore import QRectF, Signal

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.studio.base.canvas.changed_area import PaintedParts
from smsl_studio.studio.base.canvas.drawn_painter import MARGIN
from smsl_studio.studio.base.canvas.lit_labels import LitLabel
from smsl_studio.studio.base.canvas.sheet import Position
from smsl_studio.studio.base.canvas.stage import Stage


class _OnScreen(NamedTuple):
    """What the screen shows before lines are routed again, as far as it is known."""

    parts: PaintedParts | None
    labels: Mapping[int, LitLabel]


class MovedStage(Stage):
    """The scene of a canvas during a drag and after it."""

    states_dragged = Signal()
    """States stand elsewhere for as long as the drag lasts. What floats over the drawing keeps its
    place until ``picture_changed`` tells that they were dropped."""

    def drag_states(self, places: Mapping[int, Position]) -> None:
        """Show states at other places (scene points) during a drag."""
        sheet = self._sheet
        if sheet is None:
            return
        before = self._dirty(list(places)).united(sheet.drawn.around(list(places)))
        edges = sheet.move(places)
        sheet.geometry.prepare(edges)
        for state in places:
            item = self.pool.used.get(state)
            if item is not None:
                item.show_state(sheet, state)
        after = self._dirty(list(places), edges).united(sheet.drawn.around(list(places)))
        pad = MARGIN * sheet.unit
        self._repaint_dragged(before.united(after).adjusted(-pad, -pad, pad, pad))
        self.states_dragged.emit()

    def redraw_edge(self, edge: int, layout: EdgeLayout) -> None:
        """Show the line of an edge in another way during a drag."""
        sheet = self.sheet
        if sheet is None:
            return
        labels, before = self.lit_layer.shown(), self._dirty([], [edge])
        sheet.redraw(edge, layout)
        self._repaint_dragged(before.united(self._dirty([], [edge])))
        self.update_lit(labels)

    def settle(self) -> None:
        """Route and label again, after states were moved."""
        self._settle(self._on_screen())

    def stand(self, positions: Mapping[str, Position]) -> None:
        """Put all states and lines where they belong, after a move or its undo."""
        before = self._on_screen()
        if self._sheet is not None:
            self._sheet.stand(positions)
            self._settle(before)

    def _on_screen(self) -> _OnScreen:
        return _OnScreen(self._painting.parts(self._sheet, self._sides), self.lit_layer.shown())

    def _settle(self, before: _OnScreen) -> None:
        """Route and label again, and paint what looks different."""
        sheet = self._sheet
        if sheet is None:
            return
        sheet.settle()
        changed = self._painting.change(before.parts, sheet, self._sides)
        self.cover()
        self.refresh_pool()
        self.pool.refresh(sheet, changed.kept)
        self._repaint(changed.rect)
        self.update_lit(before.labels)
        self.picture_changed.emit()

    def _repaint_dragged(self, area: QRectF) -> None:
        """Repaint a part of the scene in which a drag has changed the drawing."""
        self._painting.drag(area)
        self._repaint(area)
