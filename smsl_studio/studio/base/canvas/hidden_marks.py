"""Names without room on their lines: leaders to those beside them, and marks for the others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter

from smsl_studio.picture import labels
from smsl_studio.picture.hidden_names import RADIUS, hidden_names
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.ink import pen


def paint_leaders(painter: QPainter, sheet: Sheet, names: Mapping[int, labels.Rect]) -> None:
    """Paint a dotted line to each name that stands away from its line (mark pixels)."""
    unit = sheet.unit
    painter.setPen(pen(sheet.ink.tokens.edge, 0.8, (2.0, 2.0)))
    for edge, rect in names.items():
        if isinstance(rect, labels.AsideRect):
            foot, end = labels.leader(sheet.geometry.shape(edge), rect)
            painter.drawLine(
                QPointF(foot[0] / unit, foot[1] / unit), QPointF(end[0] / unit, end[1] / unit)
            )


def paint_hidden_names(painter: QPainter, sheet: Sheet, edges: Iterable[int]) -> None:
    """Paint the marks in place of the names of these edges that have no room (mark pixels)."""
    ink, unit = sheet.ink, sheet.unit
    for names in hidden_names(sheet.geometry, edges):
        x, y = names.at[0] / unit, names.at[1] / unit
        painter.setPen(pen(ink.tokens.edge, 1.0))
        painter.setBrush(ink.tokens.canvas)
        painter.drawEllipse(QPointF(x, y), RADIUS, RADIUS)
        ink.count.draw(painter, x, y, names.words, ink.tokens.tx2)


def hidden_tip(sheet: Sheet, edge: int) -> str:
    """How many names have no room between the states of this edge, and which; empty if its own is
    shown.
    """
    operations = sheet.picture.operations
    hidden = [operations[e] for names in hidden_names(sheet.geometry, [edge]) for e in names.edges]
    if len(hidden) < 2:
        return "There is no room for this name" if hidden else ""
    return f"There is no room for {len(hidden)} names: {', '.join(hidden)}"
