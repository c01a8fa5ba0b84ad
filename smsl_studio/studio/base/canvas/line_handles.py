"""LineHandles: the handles of the selected operation, and the keys that act on a chosen one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import MOST_BENDS, EdgeLayout, LabelPlace
from smsl_studio.legible import plain_text
from smsl_studio.picture.bends import HANDLE
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.drawn_keys import ARROWS
from smsl_studio.studio.base.canvas.gestures import GRID
from smsl_studio.studio.base.canvas.line_gestures import DragBend, DragLabel, DragPiece
from smsl_studio.studio.base.canvas.line_marks import LineMarks
from smsl_studio.studio.base.canvas.right_angles import corners_of
from smsl_studio.studio.base.canvas.sheet import Sheet

LABEL = MOST_BENDS
"""The rank that stands for the label, behind those of all bends."""
GRAB = HANDLE / 2 + 3.0
"""A press within this distance of a bend takes its handle (pixels)."""
Key, Modifier = Qt.Key, Qt.KeyboardModifier
LineGesture = DragBend | DragPiece | DragLabel


class LineHandles:
    """The bends of the one selected operation as handles, and its label after them.

    One of them can be chosen, by a click or a key. Arrows move it then.
    """

    def __init__(self, canvas: BranchView) -> None:
        self._canvas = canvas
        self._of: Address | None = None
        self.chosen = -1
        """The rank of the chosen bend, ``LABEL`` for the label, -1 for none."""
        self._pressed = -1

    @property
    def edge(self) -> int:
        """The number of the selected operation; -1 if none or several elements are selected."""
        sheet, selection = self._canvas.sheet, self._canvas.marks.selection
        if sheet is None or len(selection) != 1 or not selection[0].operation:
            return -1
        return sheet.picture.edge(selection[0])

    @property
    def layout(self) -> EdgeLayout:
        """How the line of the selected operation is drawn by hand."""
        sheet = self._canvas.sheet
        return sheet.lines.get(self.edge, EdgeLayout()) if sheet is not None else EdgeLayout()

    def show(self) -> None:
        """Show the handles as they are now. The choice stays while its operation is selected."""
        edge, sheet = self.edge if self._canvas.editing else -1, self._canvas.sheet
        address = sheet.picture.address(edge) if sheet is not None and edge >= 0 else None
        bends = self.layout.bends if address is not None else ()
        if address != self._of or len(bends) <= self.chosen < LABEL:
            self._of, self.chosen = address, -1
        label = self._label() if self.chosen == LABEL else None
        marks = LineMarks(tuple(QPointF(*at) for at in bends), self.chosen, label)
        self._canvas.gestures.put("line", marks if address is not None else None)

    # Mouse

    def bend_at(self, at: QPointF) -> int:
        """The rank of the bend whose handle is at a scene point; -1 for none."""
        marks = self._canvas.gestures.line
        away = [QPointF.dotProduct(p - at, p - at) for p in marks.bends] if marks else []
        near = (GRAB / self._canvas.zoom) ** 2
        return int(np.argmin(away)) if away and min(away) <= near else -1

    def press(self, event: QMouseEvent, at: QPointF) -> LineGesture | None:
        """The gesture of a press on a handle, or on the label of the selected operation."""
        edge, self._pressed = self.edge, self.bend_at(at)
        if self._pressed >= 0:
            self.choose(self._pressed)
            return self._drag_line(event, edge, self._pressed)
        label = self._label() if edge >= 0 and not _extends(event) else None
        if label is not None and label.contains(at):
            return DragLabel(self._canvas, event, edge, label)
        return None

    def press_line(self, event: QMouseEvent, at: QPointF) -> LineGesture | None:
        """The gesture of a press on the operation that the press has just selected."""
        edge, sheet = self.edge, self._canvas.sheet
        if sheet is None or edge < 0 or _extends(event) or not self._canvas.editing:
            return None
        label = self._label()
        if label is not None and label.contains(at):
            return DragLabel(self._canvas, event, edge, label)
        return self._drag_line(event, edge) if sheet.picture.target[edge] >= 0 else None

    def _drag_line(
        self, event: QMouseEvent, edge: int, bend: int | None = None
    ) -> DragBend | DragPiece:
        """A line with right angles keeps them; any other one is led through the pointer.

        A straight line has no angle yet, also if it is level: it gets one bend.
        """
        sheet = self._canvas.sheet
        assert sheet is not None
        corners = corners_of(sheet.geometry.shape(edge), sheet.unit)
        if corners is None or len(corners) == 2:
            return DragBend(self._canvas, event, edge, bend)
        if bend is not None and len(corners) != len(self.layout.bends) + 2:
            return DragBend(self._canvas, event, edge, bend)
        return DragPiece(self._canvas, event, edge, corners, bend)

    def double_click(self, at: QPointF) -> bool:
        """Remove the bend whose handle took both clicks; whether there is one."""
        rank = self.bend_at(at)
        if not self._canvas.editing or rank < 0 or rank != self._pressed:
            return False
        self._remove(rank)
        return True

    def _label(self) -> QRectF | None:
        """The rectangle of the selected operation's label, as it is shown."""
        shown = self._canvas.lit_layer.shown().get(self.edge)
        if shown is None:
            return None
        left, top, right, bottom = shown.rect
        return QRectF(left, top, right - left, bottom - top)

    # Verbs and keys

    def choose(self, rank: int) -> None:
        """Choose a bend by its rank, the label (``LABEL``), or nothing (-1)."""
        self.chosen = rank
        self.show()
        if self._of is not None and rank >= 0:
            count = len(self.layout.bends)
            what = f"bend {rank + 1} of {count}" if rank < LABEL else "label"
            words = f"{self._of.operation}, {what} chosen. Arrows move it, Del removes it"
            self._canvas.setAccessibleDescription(plain_text(words))

    def choose_next(self) -> None:
        """Choose the next bend; after the last one the label, then the first bend again."""
        if self.edge >= 0:
            ranks = [*range(len(self.layout.bends)), LABEL]
            self.choose(next((rank for rank in ranks if rank > self.chosen), ranks[0]))

    def add_bend(self) -> None:
        """Add a bend in the middle of the longest piece of the line, and choose it."""
        sheet, edge, layout = self._canvas.sheet, self.edge, self.layout
        if sheet is None or edge < 0 or sheet.picture.target[edge] < 0:
            return
        if len(layout.bends) >= MOST_BENDS:
            self._canvas.say(f"A line has at most {MOST_BENDS} bends.")
            return
        shape = sheet.geometry.shape(edge)
        stops = [0.0, *sorted(shape.along(*at) for at in layout.bends), shape.length]
        rank = int(np.diff(stops).argmax())
        x, y = shape.at((stops[rank] + stops[rank + 1]) / 2)
        bends = layout.bends
        self.chosen = rank
        self._want(replace(layout, bends=(*bends[:rank], (x, y), *bends[rank:])))

    def key(self, event: QKeyEvent) -> bool:
        """Act on a key, if one operation is selected; False if it has no use for it."""
        key, shift = Key(event.key()), event.modifiers() == Modifier.ShiftModifier
        modifiers = event.modifiers() & ~(Modifier.KeypadModifier | Modifier.ShiftModifier)
        if self.edge < 0 or modifiers or not self._canvas.editing:
            return False
        if key == Key.Key_B:
            (self.choose_next if shift else self.add_bend)()
        elif self.chosen < 0:
            return False
        elif key in ARROWS:
            dx, dy = ARROWS[key]
            size = 1.0 if shift else GRID
            self._nudge(dx * size, dy * size)
        elif shift:
            return False
        elif key == Key.Key_Escape:
            self.choose(-1)
        elif key == Key.Key_Delete:
            self._remove(self.chosen)
        else:
            return False
        return True

    def _nudge(self, dx: float, dy: float) -> None:
        """Move the chosen bend or label (scene units)."""
        sheet, layout, rank = self._canvas.sheet, self.layout, self.chosen
        assert sheet is not None
        if rank < LABEL:
            bends = list(layout.bends)
            bends[rank] = bends[rank][0] + dx, bends[rank][1] + dy
            layout = replace(layout, bends=tuple(bends))
        else:
            share, x, y = layout.label or self._label_place(sheet)
            layout = replace(layout, label=(share, x + dx, y + dy))
        self._canvas.redraw_edge(self.edge, layout)
        self.show()
        self._want(layout, going_on=True)

    def _label_place(self, sheet: Sheet) -> LabelPlace:
        """The place of a label that nobody has moved yet."""
        shape, label = sheet.geometry.shape(self.edge), self._label()
        if label is None:
            return 0.5, 0.0, 0.0
        middle = label.center()
        along = shape.along(middle.x(), middle.y())
        x, y = shape.at(along)
        return along / (shape.length or 1.0), middle.x() - x, middle.y() - y

    def _remove(self, rank: int) -> None:
        """Remove a bend, or give the label back to the drawing."""
        layout = self.layout
        self.chosen = -1
        if rank < LABEL:
            bends = (*layout.bends[:rank], *layout.bends[rank + 1 :])
            self._want(replace(layout, bends=bends))
        else:
            self._want(replace(layout, label=None))
        self.show()

    def _want(self, layout: EdgeLayout, going_on: bool = False) -> None:
        assert self._canvas.sheet is not None
        address = self._canvas.sheet.picture.address(self.edge)
        self._canvas.line_wanted.emit(address, layout, going_on)


def _extends(event: QMouseEvent) -> bool:
    """Whether a press adds to the selection."""
    return bool(event.modifiers() & (Modifier.ShiftModifier | Modifier.ControlModifier))
