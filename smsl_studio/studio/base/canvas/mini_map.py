"""The mini-map: all states and a frame around the visible part. A press moves the view there."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QEnterEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QPixmap

from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.canvas.stage import Stage
from smsl_studio.studio.base.overlays.card import Card
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN
from smsl_studio.studio.base.theme import Tokens

MARGIN = 8.0
MANY, MANY_LINES = 400, 2000


FAINT = 0.5
"""How strongly the map is painted where it lies on states and the pointer is elsewhere."""


class MiniMap(Card):
    """A small map at the bottom right of the canvas.

    Where it lies on states it has no ground and is pale, until the pointer is on it.
    """

    def __init__(self, canvas: Stage, tokens: Tokens) -> None:
        super().__init__(canvas, tokens)
        self._canvas = canvas
        self._covers = self._held = False
        self._painted: tuple[tuple[object, ...], QPixmap] | None = None
        """The painted states, with all that their picture depends on."""
        self.setAccessibleName("Map of the State Branch")

    @property
    def faint(self) -> bool:
        """Whether the drawing shows through."""
        return self._covers and not self._held

    def show_over(self, states: bool) -> None:
        """Tell whether it lies on states."""
        if states != self._covers:
            self._covers = states
            self.update()

    def enterEvent(self, event: QEnterEvent) -> None:
        """Be seen whole while the pointer is on it."""
        super().enterEvent(event)
        self._held = True
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Let the drawing show through again."""
        super().leaveEvent(event)
        self._held = False
        self.update()

    def sizeHint(self) -> QSize:
        """148 by 92 pixels."""
        return QSize(148, 92)

    def _frame(self) -> tuple[float, QPointF] | None:
        """Pixels per scene unit, and the scene point in the middle of the map.

        None without states.
        """
        sheet = self._canvas.sheet
        if sheet is None or not len(sheet.at):
            return None
        low, high = sheet.at.min(axis=0), sheet.at.max(axis=0)
        view = self._view()
        left, top = min(low[0], view.left()), min(low[1], view.top())
        right, bottom = max(high[0], view.right()), max(high[1], view.bottom())
        width, height = max(right - left, 1.0), max(bottom - top, 1.0)
        free = self.width() - 2 * MARGIN, self.height() - 2 * MARGIN
        scale = min(free[0] / width, free[1] / height)
        return float(scale), QPointF((left + right) / 2, (top + bottom) / 2)

    def _view(self) -> QRectF:
        canvas = self._canvas
        return canvas.mapToScene(canvas.viewport().rect()).boundingRect()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint all states in one batch, and a frame around the visible part."""
        if not self.faint:
            super().paintEvent(event)
        frame, sheet = self._frame(), self._canvas.sheet
        if frame is None or sheet is None:
            return
        scale, middle = frame
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setOpacity(FAINT if self.faint else 1.0)
        painter.drawPixmap(0, 0, self._states(sheet, scale, middle))
        view = self._view()
        painter.setPen(QPen(self.tokens.acc, 1.5))
        painter.setBrush(NO_BRUSH)
        centre = QPointF(self.width() / 2, self.height() / 2)
        corner = (view.topLeft() - middle) * scale + centre
        painter.drawRoundedRect(
            QRectF(corner.x(), corner.y(), view.width() * scale, view.height() * scale), 2, 2
        )
        painter.end()

    def _states(self, sheet: Sheet, scale: float, middle: QPointF) -> QPixmap:
        """The states and lines of the map. They are painted anew only if they look different, and
        not for each step of a moving view."""
        lit = self._lit(sheet, len(sheet.at))
        key = (sheet.picture, sheet.at.tobytes(), sheet.halves().tobytes(), lit, scale,
               middle, self.tokens, self.size(), self.devicePixelRatioF())  # fmt: skip
        if self._painted is None or self._painted[0] != key:
            self._painted = key, self._paint_states(sheet, scale, middle, lit)
        return self._painted[1]

    def _paint_states(
        self, sheet: Sheet, scale: float, middle: QPointF, lit: dict[str, list[int]]
    ) -> QPixmap:
        ratio = self.devicePixelRatioF()
        pixmap = QPixmap(self.size() * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        centre = np.array([self.width() / 2, self.height() / 2])
        at = (sheet.at - (middle.x(), middle.y())) * scale + centre
        size = np.maximum(sheet.halves() * 2 * scale, (3.0, 2.0))
        if len(at) > MANY:
            size = np.full_like(at, 1.5)
        source, target = sheet.picture.source, sheet.picture.target
        if len(source) <= MANY_LINES:
            keep = target >= 0
            painter.setPen(QPen(self.tokens.line2, 1.0))
            batch.draw_lines(painter, np.hstack([at[source[keep]], at[target[keep]]]))
        painter.setPen(NO_PEN)
        painter.setBrush(self.tokens.slate)
        batch.draw_rects(painter, np.hstack([at - size / 2, size]))
        for colour, states in lit.items():
            painter.setBrush(getattr(self.tokens, colour))
            batch.draw_rects(painter, np.hstack([at[states] - size[states] / 2, size[states]]))
        painter.end()
        return pixmap

    @staticmethod
    def _lit(sheet: Sheet, count: int) -> dict[str, list[int]]:
        """The highlighted states by the name of their colour: a state with a finding has that of
        the finding, unless it is selected or active."""
        found: dict[str, list[int]] = {}
        for state in sheet.looks.lit_states:
            look = sheet.node_look(state) if state < count else None
            if look is not None:
                finding = "" if look.selected or look.active else look.finding
                colour = {"E": "bad", "W": "risk"}.get(finding, "tx3" if finding else "acc")
                found.setdefault(colour, []).append(state)
        return found

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Move the view to the point under the pointer."""
        self._go(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the view along while the pointer is dragged."""
        self._go(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Take the release, so that the canvas below does not get it."""
        event.accept()

    def _go(self, event: QMouseEvent) -> None:
        frame = self._frame()
        if frame is None:
            return
        scale, middle = frame
        off = event.position() - QPointF(self.width() / 2, self.height() / 2)
        camera = self._canvas.camera
        camera.keep("")
        camera.go(middle + off / scale, camera.zoom, smooth=False)
        self.update()
