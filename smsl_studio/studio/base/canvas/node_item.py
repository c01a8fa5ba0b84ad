"""NodeItem: a graphics item for a near or highlighted node; a pool reuses it for any state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGraphicsItem, QGraphicsObject, QStyleOptionGraphicsItem, QWidget

from smsl_studio.picture.levels import COMPACT_SIZE, FULL_SIZE, Level
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.node_paint import MARGIN, paint_node

NONE_KEPT: Mapping[int, int] = {}


class NodeItem(QGraphicsObject):
    """Shows one state of a sheet.

    The canvas chooses the state; clicks are resolved on the sheet.
    """

    def __init__(self) -> None:
        super().__init__()
        self.sheet: Sheet | None = None
        self.state = -1
        self._rect = QRectF()
        self.setAcceptedMouseButtons(Qt.MouseButton.NoButton)
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemIsSelectable, False)

    def show_state(self, sheet: Sheet, state: int) -> None:
        """Show this state with its present place, size and look."""
        self.sheet, self.state = sheet, state
        width, height = self.size()
        unit = sheet.unit
        half_w, half_h = (width / 2 + MARGIN) * unit, (height / 2 + MARGIN) * unit
        rect = QRectF(-half_w, -half_h, 2 * half_w, 2 * half_h)
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self.setPos(float(sheet.at[state, 0]), float(sheet.at[state, 1]))
        self.setZValue(11.0 if sheet.node_look(state).active else 10.0)
        self.setVisible(True)
        self.update()

    def size(self) -> tuple[float, float]:
        """Width and height of the node in mark pixels."""
        assert self.sheet is not None
        if self.sheet.compact:
            return float(self.sheet.compact_widths[self.state]), COMPACT_SIZE[1]
        return float(self.sheet.full_widths[self.state]), FULL_SIZE[1]

    def boundingRect(self) -> QRectF:
        """The node and the signs around it, in scene units."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Paint the state with its present look."""
        sheet = self.sheet
        if sheet is None or not 0 <= self.state < len(sheet.picture):
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.scale(sheet.unit, sheet.unit)
        face, look = sheet.picture.face(self.state), sheet.node_look(self.state)
        if face.initial and sheet.picture.small and sheet.level >= Level.COMPACT:
            look = replace(look, mark_shift=sheet.geometry.mark_shift / sheet.unit)
        paint_node(painter, face, self.size()[0], sheet.compact, look, sheet.ink)


class NodePool:
    """The node items: those in use by state number, and free ones for later."""

    def __init__(self) -> None:
        self.used: dict[int, NodeItem] = {}
        self._free: list[NodeItem] = []

    def show(self, sheet: Sheet, states: list[int]) -> list[NodeItem]:
        """Show exactly these states; returns new items, which the caller adds to the scene."""
        wanted = dict.fromkeys(states)
        for state in [s for s in self.used if s not in wanted]:
            item = self.used.pop(state)
            item.setVisible(False)
            self._free.append(item)
        fresh: list[NodeItem] = []
        for state in wanted:
            if state not in self.used:
                item = self._free.pop() if self._free else NodeItem()
                if item.scene() is None:
                    fresh.append(item)
                self.used[state] = item
                item.show_state(sheet, state)
        return fresh

    def refresh(self, sheet: Sheet, kept: Mapping[int, int] = NONE_KEPT) -> None:
        """Update size, place and look of all items in use, except of states that look the same."""
        for state, item in self.used.items():
            if state not in kept:
                item.show_state(sheet, state)

    def keep(self, sheet: Sheet | None, kept: Mapping[int, int]) -> None:
        """Keep the items of some states, which look the same on another sheet, and hide the others.

        ``kept`` has the numbers of these states on that sheet, by those before.
        """
        used, self.used = self.used, {}
        for state, item in used.items():
            if state in kept and sheet is not None:
                item.sheet, item.state = sheet, kept[state]
                self.used[item.state] = item
            else:
                item.setVisible(False)
                self._free.append(item)
