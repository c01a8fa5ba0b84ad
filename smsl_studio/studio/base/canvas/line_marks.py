"""The signs on the line of the selected operation: its handles, and its old way during a drag."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter, QPolygonF

from smsl_studio.picture.bends import HANDLE
from smsl_studio.studio.base.paint.ink import NO_BRUSH, Ink, pen

RING = 2.0
"""How far the ring around a chosen label stands off it (pixels)."""


@dataclass(frozen=True)
class LineMarks:
    """The handles of an operation's bends (scene points), and which of them is chosen, -1 for none.

    ``label`` is the label's rectangle if the label is chosen instead. ``former`` is the line as it
    was before the drag, to be seen until the release.
    """

    bends: tuple[QPointF, ...] = ()
    chosen: int = -1
    label: QRectF | None = None
    former: tuple[QPointF, ...] = ()

    def area(self, pixel: float) -> QRectF:
        """The rectangle around all points (scene units). ``pixel`` is the size of a pixel."""
        rect = QPolygonF(self.bends + self.former).boundingRect().adjusted(0.0, 0.0, pixel, pixel)
        if not (self.bends or self.former):
            rect = QRectF()
        return rect.united(self.label) if self.label is not None else rect


def paint_line_marks(painter: QPainter, marks: LineMarks, ink: Ink, pixel: float) -> None:
    """Paint the old way dashed, then the handles: round, and filled if it is chosen."""
    painter.setBrush(NO_BRUSH)
    if marks.former:
        painter.setPen(pen(ink.tokens.edge, 1.5 * pixel, (4.0 * pixel, 3.0 * pixel)))
        painter.drawPolyline(QPolygonF(marks.former))
    accent = pen(ink.tokens.acc, 2.0 * pixel)
    painter.setPen(accent)
    if marks.label is not None:
        off = RING * pixel
        painter.drawRoundedRect(
            marks.label.adjusted(-off, -off, off, off), 4.0 * pixel, 4.0 * pixel
        )
    radius = (HANDLE - 2.0) / 2 * pixel
    for rank, at in enumerate(marks.bends):
        painter.setBrush(ink.tokens.acc if rank == marks.chosen else ink.tokens.surf)
        painter.drawEllipse(at, radius, radius)
