"""Glide: states move to their new places in a short movement, so that a person can follow them.

Only the picture moves. The sheet has the new places at once, so a click finds what will be there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from PySide6.QtCore import QEasingCurve, QObject, QVariantAnimation
from PySide6.QtGui import QPainter, QPen

from smsl_studio.picture.levels import Level
from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.calm import is_calm
from smsl_studio.studio.base.canvas.camera import DURATION
from smsl_studio.studio.base.canvas.node_item import NodePool
from smsl_studio.studio.base.canvas.sheet import Position, Sheet
from smsl_studio.studio.base.paint import batch

MOST = 250
"""With more states in the picture nobody can follow them, so they jump."""


class Glide(QObject):
    """The movement of one stage. While it runs, straight lines stand for operations."""

    def __init__(self, pool: NodePool, frame: Callable[[], object], parent: QObject) -> None:
        """``frame`` is called when the picture has moved, and once when it has arrived."""
        super().__init__(parent)
        self._pool, self._frame = pool, frame
        self._sheet: Sheet | None = None
        self._from: Floats = np.zeros((0, 2))
        self._animation = QVariantAnimation(self)
        self._animation.setDuration(DURATION)
        self._animation.setEasingCurve(QEasingCurve.Type.OutCubic)
        self._animation.setStartValue(0.0)
        self._animation.setEndValue(1.0)
        self._animation.valueChanged.connect(lambda _: self._move())
        self._animation.finished.connect(self.end)

    @property
    def running(self) -> bool:
        """Whether states are on their way."""
        return self._sheet is not None

    def begin(self, sheet: Sheet, before: Mapping[str, Position]) -> None:
        """Let the states of a sheet come from other places (scene points)."""
        self.end()
        few = 0 < len(sheet.at) <= MOST and sheet.level >= Level.COMPACT and not is_calm()
        start = np.array([before.get(name, (np.nan, np.nan)) for name in sheet.picture.names])
        if few and not np.isnan(start).any() and not np.array_equal(start, sheet.at):
            self._sheet, self._from = sheet, start
            self._animation.start()

    def end(self) -> None:
        """Show the states at their new places."""
        self._animation.stop()
        if self._sheet is not None:
            self._sheet = None
            self._frame()

    def places(self) -> Floats:
        """Where the states are shown now, (n, 2) (scene points)."""
        assert self._sheet is not None
        share = float(self._animation.currentValue())
        found: Floats = self._from + (self._sheet.at - self._from) * share
        return found

    def hold(self) -> None:
        """Put the items of the pool where the states are shown now."""
        if self._sheet is not None:
            at = self.places()
            for state, item in self._pool.used.items():
                item.setPos(float(at[state, 0]), float(at[state, 1]))

    def paint_lines(self, painter: QPainter) -> None:
        """Paint a straight line for each two states that operations join (scene units)."""
        sheet = self._sheet
        if sheet is not None:
            at, pairs = self.places(), np.array(sheet.picture.pairs(), dtype=np.intp).reshape(-1, 2)
            pen = QPen(sheet.ink.tokens.dim, 1.5)
            pen.setCosmetic(True)
            painter.setPen(pen)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            batch.draw_lines(painter, np.hstack([at[pairs[:, 0]], at[pairs[:, 1]]]))

    def _move(self) -> None:
        if self._sheet is not None:
            self.hold()
            self._frame()
