"""The painting of notes and groups."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QPainter, QPainterPath

from smsl_studio.blueprint.annotations import DrawnNote
from smsl_studio.legible import one_line
from smsl_studio.picture.drawn_parts import (
    ABOVE,
    BY_LINE,
    CORNER,
    FOLD,
    GROUP_RADIUS,
    INSET,
    LINE,
    by_words,
    lines_of,
    nearest_point,
)
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, Ink, pen

READABLE, TOLD = 0.5, 0.15
"""From the first zoom on a note has its words, from the second one strokes in their place."""
LONG = 600.0
"""A line from a note to its state is drawn without dashes if it is longer (scene units)."""


@dataclass(frozen=True)
class NoteLook:
    """How a note is painted: at which zoom, whether it is chosen or found, and its state."""

    zoom: float
    chosen: bool = False
    hung: tuple[float, float] | None = None
    """The centre of the state that it hangs on (scene units)."""


def paint_note(painter: QPainter, rect: QRectF, note: DrawnNote, look: NoteLook, ink: Ink) -> None:
    """Paint a note: a sheet with a folded corner, its lines, its author and its date."""
    tokens = ink.tokens
    if look.hung is not None:
        sides = rect.left(), rect.top(), rect.right(), rect.bottom()
        line_to = QLineF(QPointF(*nearest_point(sides, look.hung)), QPointF(*look.hung))
        # Qt computes every dash, also those far outside the view.
        dashes = (2.0, 3.0) if line_to.length() < LONG else ()
        painter.setPen(pen(tokens.nl, 1.0, dashes))
        painter.drawLine(line_to)
    line = pen(tokens.acc, 2.0 / min(look.zoom, 1.0)) if look.chosen else pen(tokens.nl, 1.0)
    painter.setPen(line)
    painter.setBrush(tokens.surf)
    painter.drawPath(_sheet(rect))
    fold = QPainterPath(QPointF(rect.right() - FOLD, rect.top()))
    fold.lineTo(rect.right() - FOLD, rect.top() + FOLD)
    fold.lineTo(rect.right(), rect.top() + FOLD)
    fold.closeSubpath()
    painter.setBrush(tokens.accs if look.chosen else tokens.sunk)
    painter.drawPath(fold)
    if look.zoom >= READABLE:
        _write(painter, rect, note, ink)
    elif look.zoom >= TOLD:
        painter.setPen(pen(tokens.line2, 2.0))
        for number, line_ in enumerate(lines_of(note)):
            y = rect.top() + ABOVE + LINE * (number + 0.5)
            wide = (rect.width() - 2 * INSET) * min(len(line_) / 24.0, 1.0)
            painter.drawLine(
                QPointF(rect.left() + INSET, y), QPointF(rect.left() + INSET + wide, y)
            )
    painter.setBrush(NO_BRUSH)


def paint_group(painter: QPainter, rect: QRectF, bar: float, chosen: bool, ink: Ink) -> None:
    """Paint the frame of a group (mark pixels), with the bar of its title if it has a height."""
    tokens = ink.tokens
    painter.setPen(pen(tokens.acc, 2.0) if chosen else pen(tokens.line2, 1.2))
    painter.setBrush(tokens.sunk)
    painter.drawRoundedRect(rect, GROUP_RADIUS, GROUP_RADIUS)
    if bar:
        whole, top = QPainterPath(), QPainterPath()
        inner = rect.adjusted(0.6, 0.6, -0.6, -0.6)
        whole.addRoundedRect(inner, GROUP_RADIUS - 0.6, GROUP_RADIUS - 0.6)
        top.addRect(QRectF(inner.left(), inner.top(), inner.width(), bar - 0.6))
        painter.setPen(NO_PEN)
        painter.setBrush(tokens.accs if chosen else tokens.line)
        painter.drawPath(whole.intersected(top))
    painter.setBrush(NO_BRUSH)


def title_place(rect: QRectF, title: str, bar: float, ink: Ink) -> tuple[str, QRectF]:
    """The title of a group as it is written, and the ground below its words (mark pixels).

    Lines pass below this ground. ``rect`` is the frame, ``bar`` the height of the title.
    """
    words = ink.note_title.elided(one_line(title), max(rect.width() - 2 * INSET, 8.0))
    wide = ink.note_title.width(words) + INSET
    return words, QRectF(rect.center().x() - wide / 2, rect.top() + 2.0, wide, bar - 3.0)


def paint_title(
    painter: QPainter, rect: QRectF, title: str, bar: float, chosen: bool, ink: Ink
) -> None:
    """Paint the title of a group on a ground of its own."""
    tokens = ink.tokens
    words, place = title_place(rect, title, bar, ink)
    painter.fillRect(place, tokens.accs if chosen else tokens.line)
    y = rect.top() + bar / 2
    colour = tokens.acc if chosen else tokens.tx2
    ink.note_title.draw(painter, rect.center().x(), y, words, colour)


def _write(painter: QPainter, rect: QRectF, note: DrawnNote, ink: Ink) -> None:
    left, y = rect.left() + INSET, rect.top() + ABOVE + LINE / 2
    for line in lines_of(note):
        ink.note.draw_from(painter, left, y, line, ink.tokens.tx)
        y += LINE
    by = by_words(note.author, note.date)
    if by:
        y = rect.bottom() - ABOVE - BY_LINE + 10.0
        ink.note.draw_from(painter, left, y, by, ink.tokens.tx3)


def _sheet(rect: QRectF) -> QPainterPath:
    left, top, right, bottom = rect.left(), rect.top(), rect.right(), rect.bottom()
    path = QPainterPath(QPointF(left + CORNER, top))
    path.lineTo(right - FOLD, top)
    path.lineTo(right, top + FOLD)
    path.lineTo(right, bottom - CORNER)
    path.quadTo(right, bottom, right - CORNER, bottom)
    path.lineTo(left + CORNER, bottom)
    path.quadTo(left, bottom, left, bottom - CORNER)
    path.lineTo(left, top + CORNER)
    path.quadTo(left, top, left + CORNER, top)
    return path
