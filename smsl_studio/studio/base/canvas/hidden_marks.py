"""Names without room on their lines: leaders to those beside them, and marks for the others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QPainter

from smsl_studio.picture import labels
from smsl_studio.picture.hidden_names import RADIUS, HiddenMarks
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.ink import pen


class NameMarks:
    """Paints leaders and marks. They are computed again only after a change of the drawing."""

    def __init__(self) -> None:
        self._marks: HiddenMarks | None = None
        self._leaders: dict[tuple[EdgeShape, labels.Rect, float], QLineF] = {}
        self._older: dict[tuple[EdgeShape, labels.Rect, float], QLineF] = {}
        """The leaders before the last change. Lines that did not change are the same objects."""

    def paint(self, painter: QPainter, sheet: Sheet, names: Mapping[int, labels.Rect]) -> None:
        """Paint a dotted line to each name that stands away from its line, from a dot on that line
        on (mark pixels).
        """
        self._look_at(sheet)
        lines = [
            self._leader(sheet, edge, rect)
            for edge, rect in names.items()
            if isinstance(rect, labels.AsideRect)
        ]
        painter.setPen(pen(sheet.ink.tokens.edge, 0.8, (2.0, 2.0)))
        painter.drawLines(lines)
        foot = pen(sheet.ink.tokens.edge, 2.0 * labels.FOOT)
        foot.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(foot)
        painter.drawPoints([line.p1() for line in lines])

    def paint_hidden(self, painter: QPainter, sheet: Sheet, edges: Iterable[int]) -> None:
        """Paint the marks in place of the names of these edges that have no room (mark pixels)."""
        ink, unit = sheet.ink, sheet.unit
        for names in self._look_at(sheet).of(edges):
            x, y = names.at[0] / unit, names.at[1] / unit
            painter.setPen(pen(ink.tokens.edge, 1.0))
            painter.setBrush(ink.tokens.canvas)
            painter.drawEllipse(QPointF(x, y), RADIUS, RADIUS)
            ink.count.draw(painter, x, y, names.words, ink.tokens.tx2)

    def _look_at(self, sheet: Sheet) -> HiddenMarks:
        if self._marks is not sheet.labels.hidden:
            self._marks = sheet.labels.hidden
            self._older, self._leaders = self._leaders, {}
        return self._marks

    def _leader(self, sheet: Sheet, edge: int, rect: labels.Rect) -> QLineF:
        shape, unit = sheet.geometry.shape(edge), sheet.unit
        key = shape, rect, unit
        found = self._leaders.get(key) or self._older.get(key)
        if found is None:
            (ax, ay), (bx, by) = labels.leader(shape, rect)
            found = QLineF(ax / unit, ay / unit, bx / unit, by / unit)
        self._leaders[key] = found
        return found


def hidden_tip(sheet: Sheet, edge: int) -> str:
    """How many names have no room between the states of this edge, and which; empty if its own is
    shown.
    """
    operations = sheet.picture.operations
    hidden = [operations[e] for names in sheet.labels.hidden.of([edge]) for e in names.edges]
    if len(hidden) < 2:
        return "There is no room for this name" if hidden else ""
    return f"There is no room for {len(hidden)} names: {', '.join(hidden)}"
