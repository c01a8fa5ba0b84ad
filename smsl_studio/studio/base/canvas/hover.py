"""Hover: the state or operation under the pointer, with its handle and its tooltip."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import one_line
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.canvas.accessible import edge_tip
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.bundle_card import bundle_at
from smsl_studio.studio.base.canvas.gesture_layer import HANDLE_RADIUS
from smsl_studio.studio.base.canvas.handles import handles, is_near, nearest, tail_of, takes
from smsl_studio.studio.base.canvas.hidden_marks import hidden_tip
from smsl_studio.studio.base.canvas.line_handles import LineHandles
from smsl_studio.studio.base.canvas.overlays import Overlays
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.chips import fact_words
from smsl_studio.studio.base.paint.node_paint import NAME_SIDES, TITLE_SIDES, chip_places
from smsl_studio.studio.base.tips import tip_text

REACH = 15.0
"""A pointer at most this far outside a node counts as on it (pixels). So it can reach the handle.
"""
GRIP = 10.0
"""A press within this distance of its arrowhead takes an operation by its end (pixels)."""
CLEAR = 32.0
"""The smallest distance between the middles of a handle and the grip (pixels)."""


class Hover:
    """Highlights the state or operation under the pointer, and shows its handle and its tooltip."""

    def __init__(self, canvas: BranchView, overlays: Overlays, line: LineHandles) -> None:
        self._canvas, self._overlays, self._line = canvas, overlays, line

    def look(self, at: QPointF) -> None:
        """Find the state or operation at a point of the view (pixels), and show it as hovered."""
        canvas, sheet = self._canvas, self._canvas.sheet
        if sheet is None:
            return
        self._overlays.pad.point(at.toPoint())
        point = canvas.mapToScene(at.toPoint())
        state = sheet.state_at(point.x(), point.y())
        at_end = state < 0 and self._is_at_end(sheet, point)
        if state < 0 and canvas.editing and not at_end:
            state = self._kept_hover(point)
        drawn = canvas.drawn_at(point) if state < 0 else None
        edge = -1 if state >= 0 or drawn is not None else sheet.edge_at(point.x(), point.y())
        self._set_hover(state, edge)
        if state >= 0 and canvas.editing and sheet.level >= Level.COMPACT:
            handle = nearest(sheet, state, point)
            # A handle near the grip or a bend would cover it and take its clicks.
            hidden = is_near(canvas, handle, canvas.gestures.grip, CLEAR)
            hidden = hidden or self._line.bend_at(point) >= 0
            canvas.gestures.put("handle", None if hidden else handle)
        elif canvas.gestures.handle is not None:
            canvas.gestures.put("handle", None)
        taken = self.handle_at(point) is not None
        if taken != canvas.gestures.taken:
            canvas.gestures.put("taken", taken)
        self._tip(state, edge, self.fact_at(state, point) if state >= 0 else -1)
        if drawn is not None:
            canvas.viewport().setToolTip(tip_text(sheet.drawn.tip(drawn)))
        if taken:
            canvas.viewport().setToolTip("Drag to draw an operation from here")
        # At the tail of the selected line no line need be hovered: a state may lie there.
        edge = edge if edge >= 0 else self._line.edge
        if at_end and self._is_at_tip(sheet, edge, point, GRIP):
            canvas.viewport().setToolTip("Drag to let it lead to another state")
        elif at_end and self.is_at_tail(edge, point):
            canvas.viewport().setToolTip("Drag to let it start from another state")
        if self._line.bend_at(point) >= 0:
            canvas.viewport().setToolTip(tip_text("Drag to move, double-click to remove"))

    def _is_at_end(self, sheet: Sheet, point: QPointF) -> bool:
        """Whether the pointer has come along the line of an operation to one of its ends, or to the
        tail of the selected one.

        The handle of the state lies at the same place. It is for a pointer that comes from the
        state.
        """
        edge, chosen = sheet.looks.hovered_edge, self._line.edge
        if chosen >= 0 and self._canvas.editing and self.is_at_tail(chosen, point):
            # Its tail is shown, so it is taken from wherever the pointer comes but from the state.
            return sheet.looks.hovered_state != int(sheet.picture.source[chosen])
        if edge < 0 or not self._canvas.editing or edge != sheet.operation_at(point.x(), point.y()):
            return False
        return self._is_at_tip(sheet, edge, point, REACH) or self.is_at_tail(edge, point, REACH)

    def is_at_tail(self, edge: int, point: QPointF, pixels: float = GRIP) -> bool:
        """Whether a scene point is at the beginning of the line of an operation."""
        sheet = self._canvas.sheet
        return sheet is not None and is_near(self._canvas, point, tail_of(sheet, edge), pixels)

    def _is_at_tip(self, sheet: Sheet, edge: int, point: QPointF, pixels: float) -> bool:
        return is_near(self._canvas, point, QPointF(*sheet.geometry.shape(edge).tip), pixels)

    def handle_at(self, point: QPointF) -> QPointF | None:
        """The handle that a press at a scene point takes; None for none."""
        sheet, handle = self._canvas.sheet, self._canvas.gestures.handle
        if sheet is None or handle is None or sheet.looks.hovered_state < 0:
            return None
        state = sheet.looks.hovered_state
        return handle if takes(self._canvas, sheet, state, handle, point) else None

    def foot(self) -> QPoint | None:
        """The lower edge of the hovered state, in pixels of the view; None without one."""
        sheet = self._canvas.sheet
        if sheet is None or sheet.looks.hovered_state < 0:
            return None
        rect = self._canvas.rect_of(sheet.address_of_state(sheet.looks.hovered_state))
        return self._canvas.mapFromScene(rect).boundingRect().bottomLeft() if rect else None

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
        return near if kept or is_near(self._canvas, point, handle, HANDLE_RADIUS + 2.0) else -1

    def handles(self, state: int) -> dict[str, QPointF]:
        """The handles of a state as scene points, by side."""
        sheet = self._canvas.sheet
        return handles(sheet, state) if sheet is not None else {}

    def clear(self) -> None:
        """Hover nothing: the pointer has left the canvas."""
        self._overlays.pad.point(None)
        self._set_hover(-1, -1)

    def _set_hover(self, state: int, edge: int) -> None:
        canvas, sheet = self._canvas, self._canvas.sheet
        if sheet is None:
            return
        looks = sheet.looks
        before = looks.hovered_state, looks.hovered_edge
        if before == (state, edge):
            return
        labels, lane = canvas.lit_layer.shown(), canvas.lit_layer.lane
        former = lane.rect(sheet)
        looks.hovered_state, looks.hovered_edge = state, edge
        bundle = bundle_at(canvas, edge)
        self._overlays.bundle.hover(bundle)
        canvas.update_lit(labels)
        canvas.update_edges({e for e in (before[1], edge) if 0 <= e < len(sheet.picture.source)})
        canvas.lit_layer.update(former.united(lane.rect(sheet)))
        for node in (before[0], state):
            canvas.update_node(node)
        if state < 0:
            canvas.gestures.put("handle", None)
            canvas.gestures.put("taken", False)
        address = None
        if state >= 0:
            address = sheet.address_of_state(state)
        elif edge >= 0 > bundle:
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
        """Set the tooltip: what the value of a fact means, what is not to be read in a state, or
        the words of an operation.
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
            tip = _state_tip(sheet, state)
        elif edge >= 0 > bundle_at(self._canvas, edge):
            hidden = hidden_tip(sheet, edge) if sheet.level >= Level.COMPACT else ""
            tip = "\n".join(filter(None, (edge_tip(self._canvas, edge), hidden)))
        if self._canvas.viewport().toolTip() != tip:
            self._canvas.viewport().setToolTip(tip_text(tip))

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


def _state_tip(sheet: Sheet, state: int) -> str:
    """The name and the title of a state where they are not written in full, and its description.

    Empty if the node says all of it.
    """
    face, branch = sheet.picture.face(state), sheet.picture.branch
    note = branch.state_note(face.name)
    said = [note.note] if note is not None and note.note else []
    room, ink = float(sheet.full_widths[state]), sheet.ink
    whole = ink.name.width(face.name) <= room - NAME_SIDES
    titled = ink.label.width(one_line(face.title)) <= room - TITLE_SIDES
    if sheet.level is Level.FULL and whole and titled:
        return "\n".join(said)
    return "\n".join([face.name, *([face.title] if face.title else []), *said])
