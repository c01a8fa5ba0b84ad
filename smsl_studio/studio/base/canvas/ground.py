"""Ground: the background of a canvas. It is everything without a highlight, and the grid."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter

from smsl_studio.studio.base.canvas.background import EdgePainter, FarNodePainter
from smsl_studio.studio.base.canvas.drawn_painter import DrawnPainter
from smsl_studio.studio.base.canvas.lit_layer import LitLayer
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.theme import Tokens

DOT_STEP, DOT = 16.0, 1.5


class Ground:
    """The painters of the background, which Qt keeps until a part of it is invalidated."""

    def __init__(self, over: LitLayer) -> None:
        """``over`` is the layer above, whose labels can hide names of this one."""
        self.edges, self.far_nodes, self.drawn = EdgePainter(over), FarNodePainter(), DrawnPainter()

    def look_at(
        self,
        sheet: Sheet,
        view: tuple[float, float, float, float],
        near: frozenset[int],
        whole: bool,
    ) -> bool:
        """Note the visible part of the scene, and the states in it that have an item.

        ``whole`` is true if all states in view have one. Returns whether everything must be painted
        anew.
        """
        other = self.edges.look_at(sheet, view)
        return self.far_nodes.look_at(sheet, view, near, whole) or other

    def paint(
        self, painter: QPainter, area: QRectF, tokens: Tokens, zoom: float, sheet: Sheet | None
    ) -> None:
        """Paint an area: the dots of the grid, groups, edges, notes, and nodes without an item.

        The grid has a dot every 16 scene units, doubled or halved until its step is 11 to 23
        pixels.
        """
        painter.fillRect(area, tokens.canvas)
        step = DOT_STEP
        while step * zoom < 11.0:
            step *= 2.0
        while step * zoom > 23.0:
            step /= 2.0
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        batch.draw_grid(painter, area, step, DOT / zoom, tokens.dot)
        if sheet is None:
            return
        self.drawn.paint_groups(painter, sheet, area)
        if len(sheet.picture):
            self.edges.paint(painter, sheet, area)
        self.drawn.paint_titles(painter, sheet, area)
        self.edges.paint_names(painter, sheet, area)
        self.drawn.paint_notes(painter, sheet, area)
        if len(sheet.picture):
            self.far_nodes.paint(painter, sheet, area)
