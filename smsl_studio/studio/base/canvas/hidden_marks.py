"""Names without room on their lines: leaders to those beside them, and marks for the others."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QPainter

from smsl_studio.picture import labels
from smsl_studio.picture.hidden_names import HiddenMarks
from smsl_studio.picture.shape import EdgeShape
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.ink import pen

THIN = 1.05
"""The width of a leader (pixels of a mark). Qt draws thinner lines otherwise where only a part is
repainted."""
DASH = 1.6
"""The length of the dashes of a leader, and of the gaps between them (pixels of a mark)."""


class NameMarks:
    """Paints leaders and marks. They are computed again only after a change of the drawing."""

    def __init__(self) -> None:
        self._marks: HiddenMarks | None = None
        self._leaders: dict[tuple[EdgeShape, labels.Rect, float], tuple[QLineF, ...]] = {}
        self._older: dict[tuple[EdgeShape, labels.Rect, float], tuple[QLineF, ...]] = {}
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
        painter.setPen(pen(sheet.ink.tokens.edge, THIN))
        painter.drawLines([dash for line in lines for dash in line])
        foot = pen(sheet.ink.tokens.edge, 2.0 * labels.FOOT)
        foot.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(foot)
        painter.drawPoints([line[0].p1() for line in lines])

    def paint_hidden(self, painter: QPainter, sheet: Sheet, edges: Iterable[int]) -> None:
        """Paint the marks in place of the names of these edges that have no room (mark pixels)."""
        ink, unit = sheet.ink, sheet.unit
        for names in self._look_at(sheet).of(edges):
            if not names.radius:
                continue
            x, y = names.at[0] / unit, names.at[1] / unit
            painter.setPen(pen(ink.tokens.edge, 1.0))
            painter.setBrush(ink.tokens.canvas)
            painter.drawEllipse(QPointF(x, y), names.radius, names.radius)
            if names.large:
                ink.count.draw(painter, x, y, names.words, ink.tokens.tx2)

    def _look_at(self, sheet: Sheet) -> HiddenMarks:
        if self._marks is not sheet.labels.hidden:
            self._marks = sheet.labels.hidden
            self._older, self._leaders = self._leaders, {}
        return self._marks

    def _leader(self, sheet: Sheet, edge: int, rect: labels.Rect) -> tuple[QLineF, ...]:
        """The dashes of a leader. Qt would begin a dashed line anew where a part is repainted."""
        shape, unit = sheet.geometry.shape(edge), sheet.unit
        key = shape, rect, unit
        found = self._leaders.get(key) or self._older.get(key)
        if found is None:
            (ax, ay), (bx, by) = labels.leader(shape, rect)
            line = QLineF(ax / unit, ay / unit, bx / unit, by / unit)
            whole, dash = max(line.length(), DASH), DASH
            starts = [dash * at for at in range(0, math.ceil(whole / dash), 2)]
            found = tuple(
                QLineF(line.pointAt(at / whole), line.pointAt(min((at + dash) / whole, 1.0)))
                for at in starts
            )
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
